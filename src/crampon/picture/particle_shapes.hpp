#pragma once
/// Particles as the parallelograms that pictures show.

#include <array>
#include <vector>

#include "crampon/output/frame.hpp"

namespace crampon {

/// Centre and half edges in the x-y plane, m.
struct ParticleShape {
  std::array<double, 2> centre{}, a{}, b{};
  std::size_t index = 0;  ///< of the point in its frame
};

/// Shapes with displacements magnified, in the order to paint them (back to front along z in 3D); points with NaN coordinates are
/// left out. Without particle sizes: squares of an eighth of a cell. Throws std::invalid_argument for magnification != 1 without the
/// field "displacement".
std::vector<ParticleShape> particle_shapes(const PointFrame& frame, double magnification);

}  // namespace crampon
