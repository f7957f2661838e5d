#include "crampon/picture/draw.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/picture/canvas.hpp"
#include "crampon/picture/display_scale.hpp"
#include "crampon/picture/layout.hpp"
#include "crampon/picture/paint_bodies.hpp"
#include "crampon/picture/paint_cracks.hpp"
#include "crampon/picture/scene.hpp"

namespace crampon {
namespace {

constexpr Colour ink{0.1, 0.1, 0.12};

// What is drawn of all places: the bodies with a margin.
std::array<double, 4> window_of(const PictureExtent& extent, const DrawOptions& options) {
  std::array<double, 4> w = extent.window;
  if (options.window) {
    w = *options.window;
  } else if (w[1] > w[0] && w[3] > w[2]) {
    const double margin = (extent.walls ? 0.1 : 0.03) * std::max(w[1] - w[0], w[3] - w[2]);
    w = {w[0] - margin, w[1] + margin, w[2] - margin, w[3] + margin};
  } else if (options.grid) {
    w = *options.grid;
  } else {
    throw std::invalid_argument("there is nothing to draw: no particle has a position and a size");
  }
  if (!(w[1] > w[0] && w[3] > w[2])) throw std::invalid_argument("the window to draw is empty");
  return w;
}

// Ends of the colour range and its palette.
void choose_colours(PictureMap& map, const PictureExtent& extent, const DrawOptions& options) {
  std::array<double, 2> range{extent.lowest, extent.highest};
  if (options.quantity == "fringes") range = {-1, 1};
  if (!(range[0] <= range[1])) range = {0, 0};
  if (options.lowest) range[0] = *options.lowest;
  if (options.highest) range[1] = *options.highest;
  if (range[0] > range[1]) throw std::invalid_argument("the colour range runs backwards");
  const double largest = std::max(std::abs(range[0]), std::abs(range[1]));
  constexpr double precision = 4e-7;  // of what frames hold, with some rounding: less is no difference
  const bool both_signs = range[0] < -precision * largest && range[1] > precision * largest;
  const Palette of_range = both_signs || options.range == ColourRange::symmetric ? Palette::diverging : Palette::uniform;
  map.palette = options.palette.value_or(options.quantity == "fringes" ? Palette::grey : of_range);
  const bool given = options.lowest || options.highest;
  if (options.range == ColourRange::symmetric || (map.palette == Palette::diverging && !given)) range = {-largest, largest};
  if (range[1] - range[0] <= precision * largest) {
    const double half = largest == 0 ? 1 : 0.5 * largest, middle = 0.5 * (range[0] + range[1]);
    range = {middle - half, middle + half};
  }
  map.lowest = range[0];
  map.highest = range[1];
}

void paint_axes(Canvas& canvas, const PictureLayout& p, std::size_t index, const PictureMap::Panel& panel) {
  const PixelBox& plot = p.plots[index];
  const double text = p.sizes.text, tick = p.sizes.tick;
  const bool leftmost = index % static_cast<std::size_t>(p.columns) == 0;
  const bool lowest = index + static_cast<std::size_t>(p.columns) >= p.plots.size();
  canvas.set_colour(ink);
  canvas.stroke_box({plot.left - 0.5, plot.top - 0.5, plot.width + 1, plot.height + 1}, 1);
  for (const Axis::Mark& mark : p.x.marks) {
    const double x = panel.pixel(mark.value, 0)[0];
    canvas.line(x, plot.bottom(), x, plot.bottom() + tick, 1);
    if (lowest) canvas.text(x, plot.bottom() + tick + 0.1 * text, mark.label, text, AlignX::centre, AlignY::top);
  }
  for (const Axis::Mark& mark : p.y.marks) {
    const double y = panel.pixel(0, mark.value)[1];
    canvas.line(plot.left - tick, y, plot.left, y, 1);
    if (leftmost) canvas.text(plot.left - tick - 0.3 * text, y, mark.label, text, AlignX::right, AlignY::middle);
  }
  if (lowest)
    canvas.text(plot.left + plot.width / 2, plot.bottom() + tick + 1.5 * text, p.x.title, canvas.fitting_size(p.x.title, text, plot.width),
                AlignX::centre, AlignY::top);
  if (leftmost)
    canvas.text_upwards(p.sizes.gap + 0.75 * text, plot.top + plot.height / 2, p.y.title,
                        canvas.fitting_size(p.y.title, text, plot.height));
}

void paint_bar(Canvas& canvas, const PictureLayout& p, const PictureMap& map) {
  const PixelBox& bar = p.side;
  const int rows = static_cast<int>(bar.height);
  for (int row = 0; row < rows; ++row) {
    canvas.set_colour(map.colour(map.highest - (row + 0.5) / rows * (map.highest - map.lowest)));
    canvas.fill_box({bar.left, bar.top + row, bar.width, 1});
  }
  canvas.set_colour(ink);
  canvas.stroke_box({bar.left - 0.5, bar.top - 0.5, bar.width + 1, bar.height + 1}, 1);
  const double text = p.sizes.text;
  for (const Axis::Mark& mark : p.bar.marks) {
    const double y = bar.bottom() - bar.height * (mark.value - map.lowest) / (map.highest - map.lowest);
    canvas.line(bar.right(), y, bar.right() + p.sizes.tick, y, 1);
    canvas.text(bar.right() + p.sizes.tick + 0.3 * text, y, mark.label, text, AlignX::left, AlignY::middle);
  }
  canvas.text_upwards(p.width - p.sizes.gap - 0.75 * text, bar.top + bar.height / 2, p.bar.title,
                      canvas.fitting_size(p.bar.title, text, bar.height));
}

void paint_legend(Canvas& canvas, const PictureLayout& p, const std::string& name, const Categories& categories) {
  const double text = p.sizes.text, row = p.legend_row, swatch = 1.1 * text;
  canvas.set_colour(ink);
  canvas.text(p.side.left, p.side.top + row / 2, name, text, AlignX::left, AlignY::middle);
  for (std::size_t k = 0; k < p.legend.size(); ++k) {
    const double middle = p.side.top + row * (static_cast<double>(k) + 1.5);
    const PixelBox box{p.side.left, middle - swatch / 2, swatch, swatch};
    if (k + 1 < p.legend.size() || p.legend.size() == categories.entries().size()) {
      canvas.set_colour(categories.entries()[k].colour);
      canvas.fill_box(box);
      if (categories.entries()[k].rigid) hatch(canvas, box, 0.4 * text);
      canvas.set_colour(ink);
      canvas.stroke_box(box, 1);
    }
    canvas.text(box.right() + 0.5 * text, middle, p.legend[k], text, AlignX::left, AlignY::middle);
  }
}

// A line of text that is smaller where there is little room; where it could not be read any more, its beginning is cut short.
void title(Canvas& canvas, double x, double y, double room, const std::string& beginning, const std::string& end, double size) {
  canvas.set_colour(ink);
  std::string text = beginning + end;
  const double least = 0.6 * size;
  if (canvas.text_width(text, least) > room) {
    const std::string cut = canvas.shortened(beginning, least, room - canvas.text_width(end, least));
    text = cut == "…" ? end : cut + end;
  }
  canvas.text(x, y, text, canvas.fitting_size(text, size, room), AlignX::centre, AlignY::middle);
}

}  // namespace

Colour PictureMap::colour(double value) const {
  if (palette == Palette::diverging) return palette_colour(palette, 0.5 + 0.5 * value / std::max(std::abs(lowest), std::abs(highest)));
  return palette_colour(palette, (value - lowest) / (highest - lowest));
}

PictureMap draw_panel(const std::vector<Snapshot>& snapshots, const DrawOptions& options, const std::filesystem::path& path) {
  if (snapshots.empty()) throw std::invalid_argument("there is nothing to draw: no snapshot");
  PointValues quantity;
  std::vector<Scene> scenes;
  for (const Snapshot& snapshot : snapshots) scenes.push_back(make_scene(snapshot, options, quantity));
  PictureExtent extent;
  for (const Scene& scene : scenes) extent.include(extent_of(scene));
  if (options.extent) extent = *options.extent;
  PictureMap map;
  choose_colours(map, extent, options);
  const Categories categories(snapshots, scenes, options);
  const std::string name = spelt_out(quantity.name);
  Side side{{map.lowest, map.highest, name, quantity.unit, {}}, name, {}};
  for (const Categories::Entry& entry : categories.entries()) {
    side.names.push_back(entry.name);
    map.legend.push_back({entry.name, entry.colour});
  }
  const PictureLayout p = lay_out_picture(scenes.size(), window_of(extent, options), side, extent.grown || extent.tips, options);
  map.width = p.width;
  map.height = p.height;
  Canvas canvas(p.width, p.height);
  double latest = 0;
  for (const Scene& scene : scenes) latest = std::max(latest, std::abs(scene.time));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const PixelBox& plot = p.plots[i];
    const PictureMap::Panel panel{plot.left, plot.top, plot.width, plot.height, p.window[0], p.window[3], p.scale};
    map.panels.push_back(panel);
    cairo_save(canvas.context());
    cairo_rectangle(canvas.context(), plot.left, plot.top, plot.width, plot.height);
    cairo_clip(canvas.context());
    paint_bodies(canvas, scenes[i], map, categories, panel);
    paint_cracks(canvas, scenes[i], panel, p.sizes, options);
    cairo_restore(canvas.context());
    paint_axes(canvas, p, i, panel);
    std::string label = "t = " + quantity_text(scenes[i].time, latest, "s");
    if (options.magnification != 1) label += fmt::format(", displacements × {:g}", options.magnification);
    const double middle = plot.left + plot.width / 2, y = plot.top - 1.2 * p.sizes.text;
    if (scenes.size() > 1) {
      title(canvas, middle, y, plot.width, "", fmt::format("({})  {}", static_cast<char>('a' + i % 26), label), 1.1 * p.sizes.text);
    } else {
      const std::string name_of_run = options.title.empty() ? "" : options.title + ",  ";
      title(canvas, middle, y, 2 * std::min(middle, p.width - middle) - 2 * p.sizes.gap, name_of_run, label, 1.1 * p.sizes.text);
    }
  }
  if (p.title_y > 0) title(canvas, p.width / 2., p.title_y, p.width - 2 * p.sizes.gap, options.title, "", 1.25 * p.sizes.text);
  if (p.key_y > 0) paint_key(canvas, p, extent);
  if (categories.empty())
    paint_bar(canvas, p, map);
  else
    paint_legend(canvas, p, name, categories);
  map.texts = canvas.texts();
  canvas.save(path);
  return map;
}

PictureMap draw_frame(const Snapshot& snapshot, const DrawOptions& options, const std::filesystem::path& path) {
  return draw_panel({snapshot}, options, path);
}

}  // namespace crampon
