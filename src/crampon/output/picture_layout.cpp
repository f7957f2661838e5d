#include "crampon/output/picture_layout.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {
namespace {

constexpr double smallest_plot = 160;  // px; less leaves no room for ticks
constexpr double smallest_bar = 220;   // px, height

std::vector<std::string> labels_of(const Ticks& ticks) {
  std::vector<std::string> labels;
  for (const double t : ticks.at) labels.push_back(tick_label(t, ticks.step));
  return labels;
}

// The number of columns whose picture comes nearest to a screen's shape.
int choose_columns(std::size_t count, double aspect) {
  int best = 1;
  double best_distance = INFINITY;
  for (int columns = 1; columns <= static_cast<int>(count); ++columns) {
    const double rows = std::ceil(static_cast<double>(count) / columns);
    const double distance = std::abs(std::log(columns * aspect / rows / 1.4)) + (columns * rows > static_cast<double>(count) ? 0.3 : 0);
    if (distance < best_distance) {
      best = columns;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace

PictureLayout lay_out_picture(std::size_t count, std::array<double, 4> window, const BarScale& bar, const DrawOptions& options) {
  PictureLayout p;
  p.sizes.text = std::clamp(options.width / 70., 11., 40.);
  p.sizes.gap = 0.5 * p.sizes.text;
  p.sizes.tick = 0.35 * p.sizes.text;
  const double text = p.sizes.text, gap = p.sizes.gap;
  const double wide = window[1] - window[0], high = window[3] - window[2];
  p.columns = options.columns > 0 ? std::min(options.columns, static_cast<int>(count)) : choose_columns(count, wide / high);
  p.rows = (static_cast<int>(count) + p.columns - 1) / p.columns;
  p.length = display_scale(std::max({std::abs(window[0]), std::abs(window[1]), std::abs(window[2]), std::abs(window[3])}), "m");

  const Canvas ruler(1, 1);
  const double between = count > 1 ? 1.4 * text : 0, head = 1.9 * text, bar_width = 1.2 * text;
  const bool own_title = count > 1 && !options.title.empty();
  const double top = gap + (own_title ? 2.2 * text : 0), bottom = p.sizes.tick + 3.2 * text + gap;
  double left = 5 * text, right = 8 * text, plot_width = 0, plot_height = 0;
  // Margins depend on the numbers beside the axes, those on the plots' size; a few rounds settle it.
  for (int round = 0; round < 4; ++round) {
    plot_width = std::max(smallest_plot, (options.width - left - right - (p.columns - 1) * between) / p.columns);
    p.scale = plot_width / wide;
    plot_height = p.scale * high;
    const double tallest = static_cast<double>(options.max_height) / p.rows;
    if (plot_height > tallest) {
      p.scale = tallest / high;
      plot_width = std::max(smallest_plot, p.scale * wide);
      plot_height = tallest;
    }
    plot_height = std::max({plot_height, smallest_plot, smallest_bar / p.rows});
    plot_width = std::floor(plot_width);
    plot_height = std::floor(plot_height);
    const double extra_x = plot_width / p.scale - wide, extra_y = plot_height / p.scale - high;
    p.window = {window[0] - extra_x / 2, window[1] + extra_x / 2, window[2] - extra_y / 2, window[3] + extra_y / 2};
    const double unit = p.length.factor;
    p.x_ticks = round_ticks(p.window[0] / unit, p.window[1] / unit, std::max(2, static_cast<int>(plot_width / (4.5 * text))));
    p.y_ticks = round_ticks(p.window[2] / unit, p.window[3] / unit, std::clamp(static_cast<int>(plot_height / (3 * text)), 2, 12));
    const double bar_height = p.rows * plot_height + (p.rows - 1) * (head + gap);
    p.bar_ticks = round_ticks(bar.lowest / bar.scale.factor, bar.highest / bar.scale.factor,
                              std::clamp(static_cast<int>(bar_height / (3 * text)), 2, 10));
    left = gap + 1.5 * text + gap + widest(ruler, labels_of(p.y_ticks), text) + gap + p.sizes.tick;
    right = 1.2 * text + bar_width + p.sizes.tick + gap + widest(ruler, labels_of(p.bar_ticks), text) + gap + 1.5 * text + gap;
  }
  p.width = static_cast<int>(std::ceil(left + p.columns * plot_width + (p.columns - 1) * between + right));
  p.height = static_cast<int>(std::ceil(top + p.rows * (head + plot_height) + (p.rows - 1) * gap + bottom));
  p.title_y = own_title ? gap + text : 0;
  left = std::floor(left);
  for (std::size_t i = 0; i < count; ++i) {
    const int column = static_cast<int>(i) % p.columns, row = static_cast<int>(i) / p.columns;
    const double y = top + head + row * (plot_height + head + gap);
    p.plots.push_back({std::floor(left + column * (plot_width + between)), std::floor(y), plot_width, plot_height});
  }
  const Box& first = p.plots.front();
  const Box& last = p.plots.back();
  const double plots_right = left + p.columns * plot_width + (p.columns - 1) * between;
  p.bar = {std::floor(plots_right + 1.2 * text), first.top, std::floor(bar_width), last.bottom() - first.top};
  return p;
}

}  // namespace crampon
