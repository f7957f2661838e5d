#pragma once
/// Rigid bodies and walls as pictures show them: by their shape, where they are.

#include <optional>
#include <string>
#include <vector>

#include "crampon/geometry/region.hpp"
#include "crampon/output/frame.hpp"

namespace crampon {

struct RigidShape {
  std::string name;
  int body = -1;                     ///< its number in the field "body"; -1: a wall, which has no particles
  RegionPtr shape;                   ///< as it was at the start
  std::optional<Bounds3> surface{};  ///< a box around its surface at the start; none where it is endless
  RigidPlace place{};                ///< at the time of the picture
};

/// How a shape is seen along z: a finite one by its silhouette, an endless one by its section at `height` (m).
/// Displacements are `magnification` times larger.
class RigidView {
 public:
  RigidView(const RigidShape& rigid, double magnification, double height);

  /// Of a disk of the picture, centre (x, y) and radius r (m): does the shape cover all, none or some of it?
  enum class Cover { none, some, all };
  Cover cover(double x, double y, double r) const;
  /// Highest z of the shape over a point that it covers, m; minus infinity of a section.
  double top(double x, double y) const;
  bool is_section() const { return low_ == high_; }
  /// Box of its surface in the picture, x lowest, x highest, y lowest, y highest, m; none where it is endless.
  std::optional<std::array<double, 4>> bounds() const;
  /// A wall all around a hole.
  bool is_hollow() const { return hollow_; }
  /// False where an endless shape fills the picture or stays out of it because its surface lies in the plane of the picture.
  bool shows_an_edge() const { return shows_an_edge_; }

 private:
  Vec<3> at_start(double x, double y, double z) const;

  const RigidShape& rigid_;
  std::array<double, 9> map_, back_;  // displacements, magnified, as x = centre + map (X - start), and back
  Vec<3> centre_;
  double scale_ = 1;           // of lengths
  double low_ = 0, high_ = 0;  // z of the rays; equal: one section
  bool shows_an_edge_ = true, hollow_ = false;
};

/// Pixels over a part of the plane.
struct Raster {
  int width = 0, height = 0;
  double x0 = 0, y0 = 0, size = 1;  ///< m: left and upper edge, edge of a pixel
  double x(int i) const { return x0 + (i + 0.5) * size; }
  double y(int j) const { return y0 - (j + 0.5) * size; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
  }
};
/// Those whose centres the shape covers, by rows from the top.
std::vector<bool> covered_pixels(const RigidView& view, const Raster& raster);

}  // namespace crampon
