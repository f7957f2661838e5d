#pragma once
/// A yardstick of speed: an elastic block with nothing but the loops of the step over the engine's data layout. What the engine costs
/// beyond it is the price of its features. It stands on core alone, so that a change of the engine's own loops does not move it.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

#include "crampon/core/pack.hpp"

namespace crampon::bench {

enum class Scheme { usf, usavg };
enum class Stencil { linear, gimp };

/// A bare elastic block without cracks, contact, conditions or re-ordering: what the data layout alone gives.
class Kernel {
 public:
  virtual ~Kernel() = default;
  /// One time step. When a particle has drifted a cell out of its block, the next step begins with the initial state, which is
  /// hundreds of steps later again. Must not throw.
  virtual void step() = 0;
  /// Real particles; padding is not counted.
  virtual std::size_t particles() const = 0;
  virtual double kinetic_energy() const = 0;  ///< J
  /// Of the bits of all positions and velocities: the same for any number of threads.
  virtual std::uint64_t hash() const = 0;
};

/// cells: of 1 m along each side, 4 particles in each; blocks of 8 x 8 cells. Throws std::bad_alloc.
std::unique_ptr<Kernel> make_block2d(int cells, Scheme scheme, Stencil stencil, int threads);
/// The same with 8 particles per cell and blocks of 8 x 8 x 8 cells.
std::unique_ptr<Kernel> make_block3d(int cells, Scheme scheme, Stencil stencil, int threads);

/// What both kernels share.
namespace baseline {

inline constexpr int side = 8;         ///< cells along a block
inline constexpr int margin = 1;       ///< cells that a particle may drift out of its block
inline constexpr double cell = 1;      ///< m
inline constexpr double courant = .2;  ///< time step by the time a wave takes through a cell

/// Isotropic elasticity with small strain; the step is that of plane and of three-dimensional strain.
struct Elastic {
  static constexpr double E = 100, nu = .33, density = 1.5;  ///< Pa, 1, kg/m3
  double lambda = E * nu / (1 + nu) / (1 - 2 * nu), mu = E / 2 / (1 + nu);
  double dt = courant * cell / std::sqrt((lambda + 2 * mu) / density);  ///< s
};

/// Blocks along a side: one more at each end, and room for what reaches beyond the last one.
inline int blocks_along(int cells) { return (cells + 2) / side + 2; }

using Index = int __attribute__((vector_size(16)));

/// Tile indices of the lowest stencil nodes of a pack, and whether all four particles share one.
struct Base {
  alignas(16) int of[lanes];
  bool same;

  void set(Pack index) {
    const Index i = __builtin_convertvector(index, Index);
    std::memcpy(of, &i, sizeof i);
    const Index equal = i == __builtin_shufflevector(i, i, 0, 0, 0, 0);
    std::uint64_t half[2];
    std::memcpy(half, &equal, sizeof half);
    same = (half[0] & half[1]) == ~std::uint64_t{0};
  }
};

/// S and G = dS/dx (1/m) along one axis (N03 Eq. 24). f: distance from the bin's lower end in cells, where bins are cells (two nodes) or
/// cells around a node (three nodes). Linear functions leave G alone: it is -1/h and 1/h.
template <int Width>
inline void axis_weights(Pack f, double half_size, double inverse_cell, Pack* S, Pack* G) {
  if constexpr (Width == 2) {
    S[0] = 1. - f;
    S[1] = f;
  } else {
    // uGIMP without branches: t is the part of the particle on either side of the middle node.
    const Pack l = splat(half_size), d = f - .5, zero = splat(0.), scale = splat(1 / (4 * half_size));
    const Pack t = lane_max(-l, lane_min(l, d)), right = l + t, left = l - t;
    S[2] = fused(right * right, scale, lane_max(d - l, zero));
    S[0] = fused(left * left, scale, lane_max(-l - d, zero));
    S[1] = 1. - S[0] - S[2];
    G[2] = right * splat(inverse_cell / (2 * half_size));
    G[0] = left * splat(-inverse_cell / (2 * half_size));
    G[1] = t * splat(-inverse_cell / half_size);
  }
}

/// Lane l of a in all lanes, by a load: compilers would rather shuffle registers, and the one port that shuffles is what the loops wait for.
inline Pack broadcast(const Pack& a, int l) {
#if defined(__AVX2__)
  return _mm256_broadcast_sd(reinterpret_cast<const double*>(&a) + l);
#else
  return splat(a[l]);
#endif
}

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

}  // namespace baseline

}  // namespace crampon::bench
