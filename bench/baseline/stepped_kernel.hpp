#pragma once
/// The step of the bare kernels, written once for two and three dimensions.

#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "bench/baseline/kernel.hpp"
#include "crampon/core/parallel.hpp"

namespace crampon::bench {

/// Isotropic elasticity with small strain.
struct Elastic {
  static constexpr double E = 100, nu = .33, density = 1.5;  ///< Pa, 1, kg/m3
  double lambda = E * nu / (1 + nu) / (1 - 2 * nu), mu = E / 2 / (1 + nu);
};

class SteppedKernel : public Kernel {
 public:
  SteppedKernel(Scheme scheme, int blocks, int threads) : scheme_(scheme), blocks_(blocks), threads_(threads) {}

  void step() final {
    const double stress_dt = scheme_ == Scheme::usavg ? dt / 2 : dt;  // N03 Eq. 35: half at a time for USAVG
    for_blocks([&](int b) { project_momentum(b); });
    for_blocks([&](int b) { compute_velocities(b, At::start); });
    for_blocks([&](int b) { update_stress_and_project_forces(b, stress_dt); });
    for_blocks([&](int b) { update_momenta(b); });
    if (scheme_ == Scheme::usf) {
      for_blocks([&](int b) { update_particles(b); });
    } else {
      for_blocks([&](int b) { update_velocities_and_project(b); });
      for_blocks([&](int b) { compute_velocities(b, At::end); });
      for_blocks([&](int b) { update_stress_and_positions(b, stress_dt); });
    }
    if (drifted_) throw std::runtime_error("bare kernel: a particle has drifted out of its block");
  }

 protected:
  /// From which momenta of a step nodal velocities are: before forces act, or of the updated particles.
  enum class At { start, end };

  virtual void project_momentum(int b) = 0;
  virtual void compute_velocities(int b, At at) = 0;
  virtual void update_stress_and_project_forces(int b, double stress_dt) = 0;
  virtual void update_momenta(int b) = 0;    ///< v' = v + a dt with a = f/m (N03 Eq. 29)
  virtual void update_particles(int b) = 0;  ///< x += v' dt, v += a dt (N03 Eq. 30)
  /// Velocities alone, and the momenta they give (N03 Eq. 31); positions stay those that all shape functions of a step belong to.
  virtual void update_velocities_and_project(int b) = 0;
  virtual void update_stress_and_positions(int b, double stress_dt) = 0;

  static constexpr double cell = 1;            ///< m
  static constexpr double least_mass = 1e-12;  ///< kg: nodes with less stand still

  /// So small and with so little drift that blocks need no new order in many thousands of steps, m/s. x: position, m.
  static double initial_velocity(double x, int cells) { return .01 * std::sin(2 * 3.14159265358979 * x / cells); }

  Elastic law;
  double dt = .2 * cell / std::sqrt((law.lambda + 2 * law.mu) / law.density);  ///< s
  double inverse_cell = 1 / cell;                                              ///< 1/m
  std::atomic<bool> drifted_ = false;

 private:
  template <class F>
  void for_blocks(F f) {
    parallel_for(static_cast<std::size_t>(blocks_), threads_, [&](std::size_t b) { f(static_cast<int>(b)); });
  }

  Scheme scheme_;
  int blocks_, threads_;
};

/// FNV-1a over the bits of numbers.
class Fingerprint {
 public:
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    value_ = (value_ ^ bits) * 1099511628211u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 1469598103934665603u;
};

}  // namespace crampon::bench
