#include "crampon/picture/paint_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace crampon {
namespace {

using Point = std::array<double, 2>;

constexpr Colour black{0, 0, 0}, white{1, 1, 1};

double line_width(const TextSizes& sizes) { return std::max(1.5, 0.12 * sizes.text); }
double mark_radius(const TextSizes& sizes) { return std::max(3., 0.24 * sizes.text); }

void trace(cairo_t* c, std::span<const Point> line, const PictureMap::Panel& panel) {
  for (const Point& p : line) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) continue;
    const Point at = panel.pixel(p[0], p[1]);
    cairo_line_to(c, at[0], at[1]);
  }
}

void paint_crack(Canvas& canvas, const Scene::Surfaces& crack, const PictureMap::Panel& panel, double width_of_line) {
  cairo_t* c = canvas.context();
  // Only where upper lies above lower is there a gap; the upper side is left of the directed path (N03).
  const auto opening = [&](std::size_t v) {
    const std::size_t n = crack.upper.size(), i = std::max<std::size_t>(v, 1) - 1, j = std::min(v + 1, n - 1);
    const double dx = crack.lower[j][0] - crack.lower[i][0], dy = crack.lower[j][1] - crack.lower[i][1];
    return (crack.upper[v][1] - crack.lower[v][1]) * dx - (crack.upper[v][0] - crack.lower[v][0]) * dy;
  };
  canvas.set_colour(white);
  for (std::size_t v = 0; v + 1 < crack.upper.size(); ++v) {
    if (opening(v) <= 0 && opening(v + 1) <= 0) continue;
    cairo_new_sub_path(c);
    trace(c, std::array{crack.upper[v], crack.upper[v + 1], crack.lower[v + 1], crack.lower[v]}, panel);
    cairo_close_path(c);
  }
  cairo_set_fill_rule(c, CAIRO_FILL_RULE_WINDING);
  cairo_fill(c);  // all pieces in one path: no seams between them
  const auto stroke = [&](std::size_t from, std::size_t to, const Colour& colour, double alpha, double width) {
    if (to <= from) return;
    cairo_set_source_rgba(c, colour.red, colour.green, colour.blue, alpha);
    cairo_set_line_width(c, width);
    for (const std::vector<Point>* surface : {&crack.upper, &crack.lower}) {
      trace(c, std::span(*surface).subspan(from, to + 1 - from), panel);
      cairo_new_sub_path(c);
    }
    cairo_stroke(c);
  };
  cairo_set_line_join(c, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(c, CAIRO_LINE_CAP_ROUND);
  const std::size_t last = crack.upper.size() - 1;
  stroke(0, last, white, 0.55, 2.2 * width_of_line);  // keeps a closed crack visible on dark particles
  stroke(0, crack.first_at_start, grown_colour, 1, width_of_line);
  stroke(crack.last_at_start, last, grown_colour, 1, width_of_line);
  stroke(crack.first_at_start, crack.last_at_start, black, 1, width_of_line);
  cairo_set_line_cap(c, CAIRO_LINE_CAP_BUTT);
}

void paint_mark(Canvas& canvas, const Point& at, const TextSizes& sizes) {
  cairo_t* c = canvas.context();
  cairo_new_sub_path(c);
  cairo_arc(c, at[0], at[1], mark_radius(sizes), 0, 2 * std::numbers::pi);
  canvas.set_colour(white);
  cairo_fill_preserve(c);
  canvas.set_colour(black);
  cairo_set_line_width(c, std::max(1.2, 0.09 * sizes.text));
  cairo_stroke(c);
}

PixelBox box_about(const Point& middle, double width, double height) {
  return {middle[0] - width / 2, middle[1] - height / 2, width, height};
}

/// A place for a label of this size beside a tip that lies in the plot and covers nothing of what is taken: ahead of the tip, else turned from there,
/// else further off.
std::optional<PixelBox> free_place(const Point& tip, const Point& ahead, const Point& size, double beside, const PixelBox& plot,
                                   const std::vector<PixelBox>& taken) {
  constexpr std::array quarters{0., 0.5, -0.5, 1., -1., 1.5, -1.5, 2.};  // of a turn
  for (const double further : {0., 1., 2.}) {
    for (const double quarter : quarters) {
      const double angle = std::atan2(ahead[1], ahead[0]) + 0.5 * std::numbers::pi * quarter;
      const Point e{std::cos(angle), std::sin(angle)};
      // From the middle of a box to its edge along e, and on.
      const double edge = std::min(size[0] / 2 / std::max(1e-9, std::abs(e[0])), size[1] / 2 / std::max(1e-9, std::abs(e[1])));
      const double way = edge + beside + further * size[1];
      const PixelBox box = box_about({tip[0] + e[0] * way, tip[1] + e[1] * way}, size[0], size[1]);
      const bool inside = box.left >= plot.left && box.right() <= plot.right() && box.top >= plot.top && box.bottom() <= plot.bottom();
      if (inside && std::none_of(taken.begin(), taken.end(), [&](const PixelBox& other) { return box.overlaps(other); })) return box;
    }
  }
  return std::nullopt;
}

void paint_tips(Canvas& canvas, const std::vector<Scene::Tip>& tips, const PictureMap::Panel& panel, const TextSizes& sizes,
                const DrawOptions& options) {
  const PixelBox plot{panel.left, panel.top, panel.width, panel.height};
  std::vector<PixelBox> taken;
  std::vector<std::pair<Point, const Scene::Tip*>> shown;
  for (const Scene::Tip& tip : tips) {
    if (!std::isfinite(tip.at[0] + tip.at[1])) continue;
    const Point at = panel.pixel(tip.at[0], tip.at[1]);
    paint_mark(canvas, at, sizes);
    const PixelBox box = box_about(at, 2 * mark_radius(sizes), 2 * mark_radius(sizes));
    taken.push_back(box);
    if (box.overlaps(plot)) shown.emplace_back(at, &tip);
  }
  if (!options.tip_names) return;
  for (const auto& [at, tip] : shown) {
    const std::string name = canvas.shortened(tip->name, sizes.text, 0.5 * plot.width);
    const Point size{canvas.text_width(name, sizes.text) + 0.4 * sizes.text, 1.3 * sizes.text};
    const Point ahead{tip->ahead[0], -tip->ahead[1]};  // pixels count downwards
    if (const auto place = free_place(at, ahead, size, 2 * mark_radius(sizes), plot, taken)) {
      canvas.text_over(place->left + place->width / 2, place->top + place->height / 2, name, sizes.text);
      taken.push_back(*place);
    }
  }
}

}  // namespace

void paint_cracks(Canvas& canvas, const Scene& scene, const PictureMap::Panel& panel, const TextSizes& sizes, const DrawOptions& options) {
  for (const Scene::Surfaces& crack : scene.cracks) paint_crack(canvas, crack, panel, line_width(sizes));
  paint_tips(canvas, scene.tips, panel, sizes, options);
}

void paint_key(Canvas& canvas, const PictureLayout& layout, const PictureExtent& extent) {
  struct Entry {
    const char* text;
    std::optional<Colour> line;  ///< none: the mark of a tip
  };
  std::vector<Entry> entries;
  if (extent.grown) entries = {{"crack", black}, {"grown", grown_colour}};
  if (extent.tips) entries.push_back({"tip", std::nullopt});
  const double room = layout.width - 2 * layout.sizes.gap;
  TextSizes sizes = layout.sizes;
  const auto width_of = [&](const Entry& e) { return (e.line ? 2.4 : 1.) * sizes.text + canvas.text_width(e.text, sizes.text); };
  const auto total = [&] {
    double width = 0;
    for (const Entry& e : entries) width += width_of(e) + (width > 0 ? 1.6 * sizes.text : 0);
    return width;
  };
  sizes.text *= std::min(1., room / std::max(1., total()));
  const PixelBox& first = layout.plots.front();
  const double middle = first.left + 0.5 * (layout.plots[static_cast<std::size_t>(layout.columns) - 1].right() - first.left);
  double x = std::clamp(middle - total() / 2, layout.sizes.gap, layout.sizes.gap + room - total());
  for (const Entry& e : entries) {
    const double sample = (e.line ? 1.9 : 0.5) * sizes.text;
    if (e.line) {
      canvas.set_colour(*e.line);
      canvas.line(x, layout.key_y, x + sample, layout.key_y, 1.5 * line_width(sizes));
    } else {
      paint_mark(canvas, {x + sample / 2, layout.key_y}, sizes);
    }
    canvas.set_colour(black);
    canvas.text(x + sample + 0.5 * sizes.text, layout.key_y, e.text, sizes.text, AlignX::left, AlignY::middle);
    x += width_of(e) + 1.6 * sizes.text;
  }
}

}  // namespace crampon
