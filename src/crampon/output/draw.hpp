#pragma once
/// Pictures of particles and cracks (PNG).

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crampon/output/frame.hpp"
#include "crampon/output/palette.hpp"
#include "crampon/output/quantity.hpp"

namespace crampon {

/// How the ends of the colour range are found when they are not given.
enum class ColourRange { fitted, symmetric };

struct DrawOptions {
  std::string quantity = "von_mises";  ///< as evaluate_quantity
  std::optional<Palette> palette{};    ///< default: grey for "fringes", diverging for a symmetric range, else uniform
  ColourRange range = ColourRange::fitted;
  std::optional<double> lowest{}, highest{};       ///< ends of the colour range, SI; default: over all snapshots ("fringes": -1 to 1)
  double trimmed = 0;                              ///< fraction of the values at each end that the fitted range leaves out
  double magnification = 1;                        ///< of displacements; other than 1 needs the field "displacement"
  double fringe_constant = paper_fringe_constant;  ///< k_f of N03 Eq. 23, 1/MPa
  std::optional<std::array<double, 4>> window{};   ///< x lowest, x highest, y lowest, y highest, m; default: the bodies
  std::string title{};
  int columns = 0;        ///< of a panel of several snapshots; 0: the picture's shape decides
  int width = 1200;       ///< px; narrower for tall bodies
  int max_height = 1400;  ///< px of all plot areas above each other
};

/// One moment to draw.
struct Snapshot {
  const PointFrame* particles = nullptr;
  const CrackFrame* cracks = nullptr;  ///< may be null
};

/// Where things lie in the picture, px from its top left corner.
struct PictureMap {
  struct Panel {
    double left = 0, top = 0, width = 0, height = 0;  ///< plot area
    double x_lowest = 0, y_highest = 0;               ///< m, at its left and top edges
    double scale = 1;                                 ///< px per m
    std::array<double, 2> pixel(double x, double y) const { return {left + (x - x_lowest) * scale, top + (y_highest - y) * scale}; }
  };
  int width = 0, height = 0;
  std::vector<Panel> panels;       ///< one per snapshot
  double lowest = 0, highest = 0;  ///< ends of the colour range, SI
  Palette palette = Palette::uniform;
  Colour colour(double value) const { return palette_colour(palette, (value - lowest) / (highest - lowest)); }
};

/// Draws particles as parallelograms (their undeformed size, deformed by the field "deformation_gradient", 9 components by rows, or
/// "strain" when present), the bodies' outline, cracks by their two surfaces with the gap between them in white, a colour bar, axes
/// and the time. Three-dimensional frames are seen along z.
/// Throws std::invalid_argument (unknown quantity, magnification without displacements) and std::runtime_error "path: reason".
PictureMap draw_frame(const PointFrame& particles, const CrackFrame* cracks, const DrawOptions& options, const std::filesystem::path& path);

/// Several snapshots in rows and columns, with one colour range and one window.
PictureMap draw_panel(const std::vector<Snapshot>& snapshots, const DrawOptions& options, const std::filesystem::path& path);

}  // namespace crampon
