#pragma once
/// Pictures of particles and cracks (PNG).

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crampon/output/frame.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/output/rigid_shape.hpp"
#include "crampon/picture/box.hpp"
#include "crampon/picture/palette.hpp"

namespace crampon {

/// How the ends of the colour range are found when they are not given. A diverging palette is symmetric about zero in any case.
enum class ColourRange { fitted, symmetric };

/// What pictures have in common when they share it: the part of the plane and the colour range.
struct PictureExtent {
  std::array<double, 4> window{INFINITY, -INFINITY, INFINITY, -INFINITY};  ///< x lowest, x highest, y lowest, y highest, m
  double lowest = INFINITY, highest = -INFINITY;                           ///< values of particles that deform, SI
  bool walls = false;                                                      ///< a margin shows them
  bool tips = false, grown = false;                                        ///< a line under the plots explains tips, growth of cracks
  void include(const PictureExtent& other);
  void include_place(const std::array<double, 4>& box);
};

struct DrawOptions {
  std::string quantity = "von_mises";  ///< as evaluate_quantity
  std::optional<Palette> palette{};    ///< default: grey for "fringes", diverging for values of both signs, else uniform
  ColourRange range = ColourRange::fitted;
  std::optional<double> lowest{}, highest{};       ///< ends of the colour range, SI; default: over all snapshots ("fringes": -1 to 1)
  double magnification = 1;                        ///< of displacements; other than 1 needs the field "displacement"
  double fringe_constant = paper_fringe_constant;  ///< k_f of N03 Eq. 23, 1/MPa
  std::optional<std::array<double, 4>> window{};   ///< x lowest, x highest, y lowest, y highest, m; default: the bodies
  std::optional<std::array<double, 4>> grid{};     ///< likewise: drawn when there is no body
  std::optional<PictureExtent> extent{};           ///< of all pictures of a series; default: of the snapshots
  std::vector<std::string> category_names{};       ///< of the quantity's numbers; default: the numbers, names of bodies for "body"
  bool tip_names = false;                          ///< beside the marks of tips
  std::string title{};
  int columns = 0;        ///< of a panel of several snapshots; 0: the picture's shape decides
  int width = 1200;       ///< px; narrower for tall bodies
  int max_height = 1400;  ///< px of all plot areas above each other
};

/// One moment to draw.
struct Snapshot {
  const PointFrame* particles = nullptr;
  const CrackFrame* cracks = nullptr;  ///< may be null
  std::vector<RigidShape> rigid{};     ///< bodies and walls that are drawn by their shape
  const CrackFrame* start = nullptr;   ///< cracks at the start, to tell what has grown since; may be null
};

/// Of the particles that deform, and of the rigid bodies. Throws as draw_frame.
PictureExtent picture_extent(const Snapshot& snapshot, const DrawOptions& options);

/// Where things lie in the picture, px from its top left corner.
struct PictureMap {
  struct Panel {
    double left = 0, top = 0, width = 0, height = 0;  ///< plot area
    double x_lowest = 0, y_highest = 0;               ///< m, at its left and top edges
    double scale = 1;                                 ///< px per m
    std::array<double, 2> pixel(double x, double y) const { return {left + (x - x_lowest) * scale, top + (y_highest - y) * scale}; }
  };
  struct LegendEntry {
    std::string name;
    Colour colour;
  };
  int width = 0, height = 0;
  std::vector<Panel> panels;       ///< one per snapshot
  double lowest = 0, highest = 0;  ///< ends of the colour range, SI
  Palette palette = Palette::uniform;
  std::vector<LegendEntry> legend;  ///< categories, instead of a colour range
  std::vector<DrawnText> texts;
  /// A diverging palette is pale at zero, whatever the ends.
  Colour colour(double value) const;
};

/// Draws particles as parallelograms (their undeformed size, deformed by the field "deformation_gradient", 9 components by rows, or
/// "strain" when present), an outline about each body, rigid bodies and walls by their shapes, hatched, cracks by their two surfaces
/// with the gap between them in white and what has grown since the start in red, a mark at each tip that lies in a body, a colour bar (a legend for categories: is_category), axes and the time. Three-dimensional frames
/// are seen along z, walls in them by their section half way up.
/// Throws std::invalid_argument (unknown quantity, magnification without displacements, nothing to draw) and std::runtime_error
/// "path: reason".
PictureMap draw_frame(const Snapshot& snapshot, const DrawOptions& options, const std::filesystem::path& path);

/// Several snapshots in rows and columns, with one colour range and one window.
PictureMap draw_panel(const std::vector<Snapshot>& snapshots, const DrawOptions& options, const std::filesystem::path& path);

}  // namespace crampon
