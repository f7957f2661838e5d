#include "crampon/picture/layout.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace crampon {
namespace {

constexpr double smallest_plot = 160;  // px; less leaves no room for ticks
constexpr double smallest_bar = 220;   // px, height

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

// As many names as there is room for under the legend's title.
void list_names(PictureLayout& p, const Side& side, double height, double room, const Canvas& ruler) {
  const double text = p.sizes.text;
  p.legend_row = 1.6 * text;
  const auto most = std::max<std::size_t>(2, static_cast<std::size_t>(height / p.legend_row)) - 1;
  p.legend.clear();
  const bool all = side.names.size() <= most;
  for (std::size_t k = 0; k < (all ? side.names.size() : most - 1); ++k) p.legend.push_back(ruler.shortened(side.names[k], text, room));
  if (!all) p.legend.push_back(fmt::format("{} more", side.names.size() - p.legend.size()));
}

}  // namespace

PictureLayout lay_out_picture(std::size_t count, std::array<double, 4> window, const Side& side, bool has_key, const DrawOptions& options) {
  PictureLayout p;
  p.sizes.text = std::clamp(options.width / 70., 11., 40.);
  p.sizes.gap = 0.5 * p.sizes.text;
  p.sizes.tick = 0.35 * p.sizes.text;
  const double text = p.sizes.text, gap = p.sizes.gap;
  const double wide = window[1] - window[0], high = window[3] - window[2];
  p.columns = options.columns > 0 ? std::min(options.columns, static_cast<int>(count)) : choose_columns(count, wide / high);
  p.rows = (static_cast<int>(count) + p.columns - 1) / p.columns;
  // Both axes show lengths by one prefix.
  const double largest = std::max({std::abs(window[0]), std::abs(window[1]), std::abs(window[2]), std::abs(window[3])});
  const Canvas ruler(1, 1);
  const LabelFont font = label_font(ruler, text);
  const double between = count > 1 ? 1.4 * text : 0, head = 2.2 * text, bar_width = 1.2 * text;
  const bool own_title = count > 1 && !options.title.empty();
  const double top = gap + (own_title ? 2.2 * text : 0), bottom = p.sizes.tick + (has_key ? 4.8 : 3.2) * text + gap;
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
    const double overhang = count > 1 ? between / 2 - 0.3 * text : 1.2 * text;
    p.x = label_axis({p.window[0], p.window[1], "x", "m", largest}, Direction::across, plot_width, overhang, font);
    p.y = label_axis({p.window[2], p.window[3], "y", "m", largest}, Direction::upwards, plot_height, 0.5 * text, font);
    const double side_height = p.rows * plot_height + (p.rows - 1) * (head + gap);
    left = gap + 1.5 * text + gap + p.y.width + gap + p.sizes.tick;
    if (side.names.empty()) {
      p.bar = label_axis(side.bar, Direction::upwards, side_height, 0.5 * text, font);
      right = 1.2 * text + bar_width + p.sizes.tick + gap + p.bar.width + gap + 1.5 * text + gap;
    } else {
      list_names(p, side, side_height, std::max(8 * text, 0.3 * options.width), ruler);
      const double widest_text = std::max(1.6 * text + widest(ruler, p.legend, text), ruler.text_width(side.title, text));
      right = 1.2 * text + widest_text + gap;
    }
  }
  p.width = static_cast<int>(std::ceil(left + p.columns * plot_width + (p.columns - 1) * between + right));
  p.height = static_cast<int>(std::ceil(top + p.rows * (head + plot_height) + (p.rows - 1) * gap + bottom));
  p.title_y = own_title ? gap + text : 0;
  p.key_y = has_key ? p.height - gap - 0.8 * text : 0;
  left = std::floor(left);
  for (std::size_t i = 0; i < count; ++i) {
    const int column = static_cast<int>(i) % p.columns, row = static_cast<int>(i) / p.columns;
    const double y = top + head + row * (plot_height + head + gap);
    p.plots.push_back({std::floor(left + column * (plot_width + between)), std::floor(y), plot_width, plot_height});
  }
  const PixelBox& first = p.plots.front();
  const PixelBox& last = p.plots.back();
  const double plots_right = left + p.columns * plot_width + (p.columns - 1) * between;
  p.side = {std::floor(plots_right + 1.2 * text), first.top, std::floor(bar_width), last.bottom() - first.top};
  return p;
}

}  // namespace crampon
