#include "crampon/output/particle_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace crampon {
namespace {

const Field* find(const PointFrame& frame, std::string_view name, int components) {
  for (const Field& field : frame.fields)
    if (field.name == name && field.components == components) return &field;
  return nullptr;
}

// F - I in the plane, by rows; zero when the frame does not tell.
std::array<double, 4> displacement_gradient(const Field* gradient, const Field* strain, std::size_t i) {
  if (gradient) {
    const double* f = &gradient->values[9 * i];
    return {f[0] - 1, f[1], f[3], f[4] - 1};
  }
  if (strain) {
    const double* e = &strain->values[6 * i];
    return {e[0], e[3], e[3], e[1]};
  }
  return {};
}

}  // namespace

std::vector<ParticleShape> particle_shapes(const PointFrame& frame, double magnification) {
  const Field* displacement = find(frame, "displacement", 3);
  const Field* gradient = find(frame, "deformation_gradient", 9);
  const Field* strain = find(frame, "strain", 6);
  if (magnification != 1 && !displacement)
    throw std::invalid_argument("magnified displacements need the field \"displacement\", which these results do not hold");
  const std::size_t n = frame.positions.size() / 3;
  std::vector<ParticleShape> shapes;
  shapes.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    ParticleShape s;
    s.index = i;
    for (std::size_t k = 0; k < 2; ++k) {
      const double u = displacement ? displacement->values[3 * i + k] : 0;
      s.centre[k] = frame.positions[3 * i + k] + (magnification - 1) * u;
    }
    if (!std::isfinite(s.centre[0]) || !std::isfinite(s.centre[1])) continue;
    const bool sized = !frame.particle_size.empty();
    const double half_x = sized ? frame.particle_size[3 * i] / 2 : frame.cell / 16;
    const double half_y = sized ? frame.particle_size[3 * i + 1] / 2 : frame.cell / 16;
    std::array<double, 4> h = displacement_gradient(gradient, strain, i);
    for (double& entry : h) entry = std::isfinite(entry) ? magnification * entry : 0;
    s.a = {half_x * (1 + h[0]), half_x * h[2]};
    s.b = {half_y * h[1], half_y * (1 + h[3])};
    shapes.push_back(s);
  }
  if (frame.dimension == 3)
    std::stable_sort(shapes.begin(), shapes.end(), [&](const ParticleShape& a, const ParticleShape& b) {
      return frame.positions[3 * a.index + 2] < frame.positions[3 * b.index + 2];
    });
  return shapes;
}

}  // namespace crampon
