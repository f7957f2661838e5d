#include "crampon/picture/particle_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>

namespace crampon {
namespace {

const DataArray* find(const PointFrame& frame, std::string_view name, int components) {
  for (const DataArray& field : frame.fields)
    if (field.name == name && field.components == components) return &field;
  return nullptr;
}

// F - I in the plane, by rows, from what the frame tells: the field itself, else differences between neighbours on the lattice that
// particles start on, else zero.
class DisplacementGradient {
 public:
  explicit DisplacementGradient(const PointFrame& frame)
      : frame_(frame), gradient_(find(frame, "deformation_gradient", 9)), displacement_(find(frame, "displacement", 3)) {
    if (gradient_ || !displacement_ || frame.particle_size.empty() || frame.dimension != 2) return;
    for (std::size_t i = 0; i < frame.positions.size() / 3; ++i) at_place_[place(i)] = i;
  }

  std::array<double, 4> operator()(std::size_t i) const {
    if (gradient_) {
      std::array<double, 9> f{};
      gradient_->values.copy(9 * i, 9, f.data());
      return {f[0] - 1, f[1], f[3], f[4] - 1};
    }
    std::array<double, 4> h{};
    if (at_place_.empty()) return h;
    for (std::size_t k = 0; k < 2; ++k) {
      // Across a crack the difference is a jump: the smaller one belongs to the body.
      double least = std::numeric_limits<double>::infinity();
      for (const int step : {-1, 1}) {
        auto beside = place(i);
        beside[k] += step;
        const auto found = at_place_.find(beside);
        if (found == at_place_.end()) continue;
        const std::size_t j = found->second;
        const double apart = start(j, k) - start(i, k);
        const std::array<double, 2> slope{(shift(j, 0) - shift(i, 0)) / apart, (shift(j, 1) - shift(i, 1)) / apart};
        const double size = std::hypot(slope[0], slope[1]);
        if (!(size < least)) continue;
        least = size;
        h[k] = slope[0];
        h[2 + k] = slope[1];
      }
    }
    return h;
  }

 private:
  double shift(std::size_t i, std::size_t k) const { return displacement_->values[3 * i + k]; }
  double start(std::size_t i, std::size_t k) const { return frame_.positions[3 * i + k] - shift(i, k); }
  std::array<long long, 2> place(std::size_t i) const {
    std::array<long long, 2> p{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double lattice = start(i, k) / frame_.particle_size[3 * i + k];
      p[k] = std::isfinite(lattice) && std::abs(lattice) < 1e15 ? std::llround(std::floor(lattice + 1e-6)) : 0;
    }
    return p;
  }

  const PointFrame& frame_;
  const DataArray *gradient_, *displacement_;
  std::map<std::array<long long, 2>, std::size_t> at_place_;
};

}  // namespace

std::vector<ParticleShape> particle_shapes(const PointFrame& frame, double magnification) {
  const DataArray* displacement = find(frame, "displacement", 3);
  const DisplacementGradient gradient(frame);
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
    std::array<double, 4> h = gradient(i);
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
