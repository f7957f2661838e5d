#pragma once
/// Solid shapes: what a body fills and what a region selects.

#include <memory>
#include <optional>

#include "crampon/core/vector.hpp"

namespace crampon {

/// Axis-aligned box, m; in 2D the z range is unused.
struct Bounds3 {
  Vec<3> low, high;
};

/// A closed set of points in the plane (2D: z is ignored) or in space.
class Shape {
 public:
  virtual ~Shape() = default;
  /// Is x (m) in the shape or within `slack` (m) of its boundary from outside? slack is small against the shape.
  virtual bool contains(const Vec<3>& x, double slack = 0) const = 0;
  /// A box around the shape; infinite where the shape is (half-plane).
  virtual Bounds3 bounds() const = 0;
  /// Exact area (2D, m2) or volume (3D, m3), when a closed form is known.
  virtual std::optional<double> measure() const { return std::nullopt; }
};
using ShapePtr = std::shared_ptr<const Shape>;

}  // namespace crampon
