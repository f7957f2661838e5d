#include "crampon/output/draw.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/output/canvas.hpp"
#include "crampon/output/display_scale.hpp"
#include "crampon/output/particle_shapes.hpp"
#include "crampon/output/picture_layout.hpp"

namespace crampon {
namespace {

using Point = std::array<double, 2>;

constexpr Colour ink{0.1, 0.1, 0.12}, outline{0.28, 0.28, 0.3};

// Everything about one snapshot that does not depend on the picture's size.
struct Scene {
  std::vector<ParticleShape> shapes;
  std::vector<double> values;  // per point of the frame
  struct Surfaces {
    std::vector<Point> upper, lower;
  };
  std::vector<Surfaces> cracks;
  double time = 0;
};

std::vector<Point> magnified(const std::vector<double>& at, const CrackFrame& frame, std::size_t from, std::size_t to, double factor) {
  if (factor != 1 && frame.original.size() != at.size())
    throw std::invalid_argument("magnified displacements need the original positions of the cracks, which these results do not hold");
  std::vector<Point> points;
  for (std::size_t v = from; v < to; ++v) {
    Point p{at[3 * v], at[3 * v + 1]};
    for (std::size_t k = 0; k < 2 && factor != 1; ++k) {
      const double start = frame.original[3 * v + k];
      p[k] = start + factor * (p[k] - start);
    }
    points.push_back(p);
  }
  return points;
}

Scene make_scene(const Snapshot& snapshot, const DrawOptions& options, Quantity& quantity) {
  Scene scene;
  scene.shapes = particle_shapes(*snapshot.particles, options.magnification);
  quantity = evaluate_quantity(*snapshot.particles, options.quantity, options.fringe_constant);
  scene.values = std::move(quantity.values);
  scene.time = snapshot.particles->time;
  if (!snapshot.cracks) return scene;
  const CrackFrame& c = *snapshot.cracks;
  for (std::size_t k = 0; k + 1 < c.begin.size(); ++k) {
    const auto from = static_cast<std::size_t>(c.begin[k]), to = static_cast<std::size_t>(c.begin[k + 1]);
    scene.cracks.push_back({magnified(c.upper.empty() ? c.plane : c.upper, c, from, to, options.magnification),
                            magnified(c.lower.empty() ? c.plane : c.lower, c, from, to, options.magnification)});
  }
  return scene;
}

std::array<double, 4> body_window(const std::vector<Scene>& scenes) {
  std::array<double, 4> w{INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (const Scene& scene : scenes) {
    for (const ParticleShape& s : scene.shapes) {
      for (std::size_t k = 0; k < 2; ++k) {
        const double reach = std::abs(s.a[k]) + std::abs(s.b[k]);
        w[2 * k] = std::min(w[2 * k], s.centre[k] - reach);
        w[2 * k + 1] = std::max(w[2 * k + 1], s.centre[k] + reach);
      }
    }
  }
  if (!(w[1] > w[0] && w[3] > w[2])) throw std::invalid_argument("there is nothing to draw: no particle has a position and a size");
  const double margin = 0.03 * std::max(w[1] - w[0], w[3] - w[2]);
  return {w[0] - margin, w[1] + margin, w[2] - margin, w[3] + margin};
}

std::array<double, 2> colour_range(const std::vector<Scene>& scenes, const DrawOptions& options) {
  std::array<double, 2> range{-1, 1};
  if (options.quantity != "fringes") {
    std::vector<double> all;
    for (const Scene& scene : scenes)
      std::copy_if(scene.values.begin(), scene.values.end(), std::back_inserter(all), [](double v) { return std::isfinite(v); });
    if (all.empty()) all.push_back(0);
    std::sort(all.begin(), all.end());
    const auto skipped = static_cast<std::size_t>(std::clamp(options.trimmed, 0., 0.49) * static_cast<double>(all.size()));
    range = {all[skipped], all[all.size() - 1 - skipped]};
  }
  if (options.lowest) range[0] = *options.lowest;
  if (options.highest) range[1] = *options.highest;
  if (options.range == ColourRange::symmetric) {
    const double most = std::max(std::abs(range[0]), std::abs(range[1]));
    range = {-most, most};
  }
  if (range[0] > range[1]) throw std::invalid_argument("the colour range runs backwards");
  if (range[0] == range[1]) {
    const double half = range[0] == 0 ? 1 : 0.5 * std::abs(range[0]);
    range = {range[0] - half, range[1] + half};
  }
  return range;
}

// Fills the parallelogram, grown by some pixels so that neighbours leave no seam.
void fill_shape(cairo_t* c, const ParticleShape& s, const PictureMap::Panel& panel, double grown, double origin_x, double origin_y) {
  const double half_a = std::hypot(s.a[0], s.a[1]) * panel.scale, half_b = std::hypot(s.b[0], s.b[1]) * panel.scale;
  const double fa = half_a > 0 ? panel.scale * (1 + grown / half_a) : 0, fb = half_b > 0 ? panel.scale * (1 + grown / half_b) : 0;
  const Point centre = panel.pixel(s.centre[0], s.centre[1]);
  static constexpr double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& [i, j] : corners)
    cairo_line_to(c, centre[0] - origin_x + i * fa * s.a[0] + j * fb * s.b[0], centre[1] - origin_y - i * fa * s.a[1] - j * fb * s.b[1]);
  cairo_close_path(c);
  cairo_fill(c);
}

// Without antialiasing, where neighbouring edges would show as seams, but at twice the size, so that outlines come out smooth.
void paint_particles(Canvas& canvas, const Scene& scene, const PictureMap& map, const PictureMap::Panel& panel) {
  constexpr int finer = 2;
  Canvas layer(finer * static_cast<int>(panel.width), finer * static_cast<int>(panel.height));
  cairo_t* c = layer.context();
  cairo_scale(c, finer, finer);
  cairo_set_antialias(c, CAIRO_ANTIALIAS_NONE);
  layer.set_colour(outline);
  for (const ParticleShape& s : scene.shapes) fill_shape(c, s, panel, 1.5, panel.left, panel.top);
  for (const ParticleShape& s : scene.shapes) {
    layer.set_colour(map.colour(scene.values[s.index]));
    fill_shape(c, s, panel, 0.3, panel.left, panel.top);
  }
  cairo_surface_flush(layer.surface());
  cairo_t* to = canvas.context();
  cairo_save(to);
  cairo_translate(to, panel.left, panel.top);
  cairo_scale(to, 1. / finer, 1. / finer);
  cairo_set_source_surface(to, layer.surface(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(to), CAIRO_FILTER_GOOD);
  cairo_paint(to);
  cairo_restore(to);
}

void trace(cairo_t* c, const std::vector<Point>& line, const PictureMap::Panel& panel) {
  for (const Point& p : line) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) continue;
    const Point at = panel.pixel(p[0], p[1]);
    cairo_line_to(c, at[0], at[1]);
  }
}

void paint_crack(Canvas& canvas, const Scene::Surfaces& crack, const PictureMap::Panel& panel, double line_width) {
  cairo_t* c = canvas.context();
  // Only where upper lies above lower is there a gap; the upper side is left of the directed path (N03).
  const auto opening = [&](std::size_t v) {
    const std::size_t n = crack.upper.size(), i = std::max<std::size_t>(v, 1) - 1, j = std::min(v + 1, n - 1);
    const double dx = crack.lower[j][0] - crack.lower[i][0], dy = crack.lower[j][1] - crack.lower[i][1];
    return (crack.upper[v][1] - crack.lower[v][1]) * dx - (crack.upper[v][0] - crack.lower[v][0]) * dy;
  };
  canvas.set_colour({1, 1, 1});
  for (std::size_t v = 0; v + 1 < crack.upper.size(); ++v) {
    if (opening(v) <= 0 && opening(v + 1) <= 0) continue;
    cairo_new_sub_path(c);
    trace(c, {crack.upper[v], crack.upper[v + 1], crack.lower[v + 1], crack.lower[v]}, panel);
    cairo_close_path(c);
  }
  cairo_set_fill_rule(c, CAIRO_FILL_RULE_WINDING);
  cairo_fill(c);  // all pieces in one path: no seams between them
  const auto stroke = [&](const Colour& colour, double alpha, double width) {
    cairo_set_source_rgba(c, colour.red, colour.green, colour.blue, alpha);
    cairo_set_line_width(c, width);
    for (const std::vector<Point>* surface : {&crack.upper, &crack.lower}) {
      trace(c, *surface, panel);
      cairo_new_sub_path(c);
    }
    cairo_stroke(c);
  };
  cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(c, CAIRO_LINE_CAP_ROUND);
  stroke({1, 1, 1}, 0.55, 2.2 * line_width);  // keeps a closed crack visible on dark particles
  stroke({0, 0, 0}, 1, line_width);
  cairo_set_line_cap(c, CAIRO_LINE_CAP_BUTT);
}

void paint_axes(Canvas& canvas, const PictureLayout& p, std::size_t index, const PictureMap::Panel& panel) {
  const Box& plot = p.plots[index];
  const double text = p.sizes.text, tick = p.sizes.tick;
  const bool leftmost = index % static_cast<std::size_t>(p.columns) == 0;
  const bool lowest = index + static_cast<std::size_t>(p.columns) >= p.plots.size();
  canvas.set_colour(ink);
  canvas.stroke_box({plot.left - 0.5, plot.top - 0.5, plot.width + 1, plot.height + 1}, 1);
  for (const double t : p.x_ticks.at) {
    const double x = panel.pixel(t * p.length.factor, 0)[0];
    canvas.line(x, plot.bottom(), x, plot.bottom() + tick, 1);
    if (lowest) canvas.text(x, plot.bottom() + tick + 0.1 * text, tick_label(t, p.x_ticks.step), text, AlignX::centre, AlignY::top);
  }
  for (const double t : p.y_ticks.at) {
    const double y = panel.pixel(0, t * p.length.factor)[1];
    canvas.line(plot.left - tick, y, plot.left, y, 1);
    if (leftmost) canvas.text(plot.left - tick - 0.3 * text, y, tick_label(t, p.y_ticks.step), text, AlignX::right, AlignY::middle);
  }
  if (lowest)
    canvas.text(plot.left + plot.width / 2, plot.bottom() + tick + 1.5 * text, label_with_unit("x", p.length.unit), text, AlignX::centre,
                AlignY::top);
  if (leftmost) canvas.text_upwards(p.sizes.gap + 0.75 * text, plot.top + plot.height / 2, label_with_unit("y", p.length.unit), text);
}

void paint_bar(Canvas& canvas, const PictureLayout& p, const BarScale& scale, const PictureMap& map) {
  const Box& bar = p.bar;
  const int rows = static_cast<int>(bar.height);
  for (int row = 0; row < rows; ++row) {
    canvas.set_colour(palette_colour(map.palette, 1 - (row + 0.5) / rows));
    canvas.fill_box({bar.left, bar.top + row, bar.width, 1});
  }
  canvas.set_colour(ink);
  canvas.stroke_box({bar.left - 0.5, bar.top - 0.5, bar.width + 1, bar.height + 1}, 1);
  const double text = p.sizes.text;
  for (const double t : p.bar_ticks.at) {
    const double y = bar.bottom() - bar.height * (t * scale.scale.factor - scale.lowest) / (scale.highest - scale.lowest);
    canvas.line(bar.right(), y, bar.right() + p.sizes.tick, y, 1);
    canvas.text(bar.right() + p.sizes.tick + 0.3 * text, y, tick_label(t, p.bar_ticks.step), text, AlignX::left, AlignY::middle);
  }
  const double fitting = std::min(text, text * bar.height / canvas.text_width(scale.label, text));
  canvas.text_upwards(p.width - p.sizes.gap - 0.75 * text, bar.top + bar.height / 2, scale.label, fitting);
}

std::string spaced(std::string name) {
  if (name == "von_mises") return "von Mises stress";
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void title(Canvas& canvas, double x, double y, double room, const std::string& text, double size) {
  canvas.set_colour(ink);
  canvas.text(x, y, text, std::min(size, size * room / std::max(1., canvas.text_width(text, size))), AlignX::centre, AlignY::middle);
}

}  // namespace

PictureMap draw_panel(const std::vector<Snapshot>& snapshots, const DrawOptions& options, const std::filesystem::path& path) {
  if (snapshots.empty()) throw std::invalid_argument("there is nothing to draw: no snapshot");
  Quantity quantity;
  std::vector<Scene> scenes;
  for (const Snapshot& snapshot : snapshots) scenes.push_back(make_scene(snapshot, options, quantity));
  const std::array<double, 4> window = options.window ? *options.window : body_window(scenes);
  if (!(window[1] > window[0] && window[3] > window[2])) throw std::invalid_argument("the window to draw is empty");

  PictureMap map;
  const std::array<double, 2> range = colour_range(scenes, options);
  map.lowest = range[0];
  map.highest = range[1];
  const Palette of_range = options.range == ColourRange::symmetric ? Palette::diverging : Palette::uniform;
  const Palette usual = options.quantity == "fringes" ? Palette::grey : of_range;
  map.palette = options.palette.value_or(usual);
  BarScale bar{range[0], range[1], display_scale(std::max(std::abs(range[0]), std::abs(range[1])), quantity.unit), ""};
  bar.label = label_with_unit(spaced(quantity.name), bar.scale.unit);

  const PictureLayout p = lay_out_picture(scenes.size(), window, bar, options);
  map.width = p.width;
  map.height = p.height;
  Canvas canvas(p.width, p.height);
  double latest = 0;
  for (const Scene& scene : scenes) latest = std::max(latest, std::abs(scene.time));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Box& plot = p.plots[i];
    const PictureMap::Panel panel{plot.left, plot.top, plot.width, plot.height, p.window[0], p.window[3], p.scale};
    map.panels.push_back(panel);
    cairo_save(canvas.context());
    cairo_rectangle(canvas.context(), plot.left, plot.top, plot.width, plot.height);
    cairo_clip(canvas.context());
    paint_particles(canvas, scenes[i], map, panel);
    for (const Scene::Surfaces& crack : scenes[i].cracks) paint_crack(canvas, crack, panel, std::max(1.5, 0.12 * p.sizes.text));
    cairo_restore(canvas.context());
    paint_axes(canvas, p, i, panel);
    std::string label = "t = " + quantity_text(scenes[i].time, latest, "s");
    if (options.magnification != 1) label += fmt::format(", displacements × {:g}", options.magnification);
    if (scenes.size() > 1)
      label = fmt::format("({})  {}", static_cast<char>('a' + i % 26), label);
    else if (!options.title.empty())
      label = options.title + ",  " + label;
    title(canvas, plot.left + plot.width / 2, plot.top - 0.95 * p.sizes.text, scenes.size() > 1 ? plot.width : p.width - 2 * p.sizes.gap,
          label, 1.1 * p.sizes.text);
  }
  if (p.title_y > 0) title(canvas, p.width / 2., p.title_y, p.width - 2 * p.sizes.gap, options.title, 1.25 * p.sizes.text);
  paint_bar(canvas, p, bar, map);
  canvas.save(path);
  return map;
}

PictureMap draw_frame(const PointFrame& particles, const CrackFrame* cracks, const DrawOptions& options,
                      const std::filesystem::path& path) {
  return draw_panel({{&particles, cracks}}, options, path);
}

}  // namespace crampon
