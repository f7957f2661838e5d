#pragma once
/// Where the plot areas, axes, colour bar and legend of a picture of snapshots go. For the drawing files of this room only.

#include <array>
#include <string>
#include <vector>

#include "crampon/picture/axis.hpp"
#include "crampon/picture/canvas.hpp"
#include "crampon/picture/draw.hpp"

namespace crampon {

/// Text size and the sizes that follow from it, px.
struct TextSizes {
  double text = 17, gap = 8, tick = 6;
};

/// What stands beside the plots: a colour bar, or a legend of categories.
struct Side {
  AxisRange bar;
  std::string title;               ///< of the legend
  std::vector<std::string> names;  ///< of categories; empty: a bar
};

struct PictureLayout {
  int width = 0, height = 0;
  int columns = 1, rows = 1;
  TextSizes sizes;
  std::vector<PixelBox> plots;
  std::array<double, 4> window{};  ///< x lowest, x highest, y lowest, y highest, m, of every plot
  double scale = 1;                ///< px per m
  Axis x, y;
  PixelBox side;  ///< the colour bar, or the legend under its title
  Axis bar;
  std::vector<std::string> legend;  ///< names that have room, shortened; the last may tell how many have none
  double legend_row = 0;            ///< px from one to the next
  double title_y = 0;               ///< middle of the title's line; 0: none
  double key_y = 0;                 ///< likewise of the key under the plots
};

/// Fits `count` plots of the window into the width of the options; the window grows where a plot would be too small to read. has_key: there is a line
/// under the plots that explains cracks and tips.
PictureLayout lay_out_picture(std::size_t count, std::array<double, 4> window, const Side& side, bool has_key, const DrawOptions& options);

}  // namespace crampon
