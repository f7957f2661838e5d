#pragma once
/// Where the plot areas, axes and colour bar of a picture of snapshots go. For the drawing files of this room only.

#include <array>
#include <string>
#include <vector>

#include "crampon/output/canvas.hpp"
#include "crampon/output/display_scale.hpp"
#include "crampon/output/draw.hpp"

namespace crampon {

/// Text size and the sizes that follow from it, px.
struct TextSizes {
  double text = 17, gap = 8, tick = 6;
};

/// A colour bar's numbers.
struct BarScale {
  double lowest = 0, highest = 1;  ///< SI
  DisplayScale scale;
  std::string label;
};

struct PictureLayout {
  int width = 0, height = 0;
  int columns = 1, rows = 1;
  TextSizes sizes;
  std::vector<Box> plots;
  std::array<double, 4> window{};  ///< x lowest, x highest, y lowest, y highest, m, of every plot
  double scale = 1;                ///< px per m
  DisplayScale length;
  Ticks x_ticks, y_ticks;  ///< in units of `length`
  Box bar;
  Ticks bar_ticks;     ///< in units of the bar's scale
  double title_y = 0;  ///< middle of the title's line; 0: none
};

/// Fits `count` plots of the window into the width of the options; the window grows where a plot would be too small to read.
PictureLayout lay_out_picture(std::size_t count, std::array<double, 4> window, const BarScale& bar, const DrawOptions& options);

}  // namespace crampon
