#pragma once
/// Solid shapes: what a body fills and what a region selects.

#include <memory>
#include <optional>

#include "crampon/core/vector.hpp"

namespace crampon {

/// Axis-aligned box, m; in 2D the z range is unused. Empty when low > high on some axis.
struct Bounds3 {
  Vec<3> low, high;
};

/// A closed set of points in the plane (2D: z is ignored) or in space. In space a plane shape is the infinite prism over it.
class Region {
 public:
  virtual ~Region() = default;
  /// Signed distance from x (m) to the boundary, m: negative inside, positive outside, zero on the boundary. Exact for single shapes; in
  /// combinations never further from zero than the exact one. It changes by no more than the way x moves: searches may skip whole balls.
  virtual double distance(const Vec<3>& x) const = 0;
  /// Gradient of the distance at x (m), a unit vector: the outward normal of the boundary at its point nearest to x, inside, outside and on
  /// it; beyond a convex corner it points from the corner to x. Its z is zero for plane shapes. Where several boundary points are equally
  /// near it is that of one of them, always the same; zero where it has no direction (centre of a disk, axis of a cylinder, a point itself,
  /// everywhere). In combinations it belongs to the part whose distance counts.
  virtual Vec<3> outward(const Vec<3>& x) const = 0;
  /// Is x (m) in the shape or within `slack` (m) of its boundary from outside? slack is small against the shape.
  virtual bool contains(const Vec<3>& x, double slack = 0) const { return distance(x) <= slack; }
  /// A box around the shape; infinite where the shape is (half-plane; z of a plane shape).
  virtual Bounds3 bounds() const = 0;
  /// Exact area (dimension 2, m2) or volume (dimension 3, m3), when a closed form is known.
  virtual std::optional<double> measure() const { return std::nullopt; }
  /// 2: given in the plane; 3: given in space; 0: either (everywhere).
  virtual int dimension() const { return 2; }
};
using RegionPtr = std::shared_ptr<const Region>;

}  // namespace crampon
