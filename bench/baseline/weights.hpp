#pragma once
/// Factors of shape functions along an axis, four particles at a time.

#include <cstdint>
#include <cstring>

#include "crampon/core/pack.hpp"

namespace crampon::bench {

/// Tile indices of the lowest stencil nodes of a pack, and whether all four particles share one.
struct Base {
  int of[lanes];
  bool same;

  void set(Pack index) {
    using Index = int __attribute__((vector_size(16)));
    const Index i = __builtin_convertvector(index, Index);
    std::uint64_t half[2];  // two comparisons instead of three
    std::memcpy(of, &i, sizeof i);
    std::memcpy(half, &i, sizeof i);
    same = of[0] == of[1] && half[0] == half[1];
  }
};

/// Lane l of a in all lanes, by a load: compilers would rather shuffle registers, and the one port that shuffles is what the loops wait for.
inline Pack broadcast(const Pack& a, int l) {
#if defined(__AVX2__)
  return _mm256_broadcast_sd(reinterpret_cast<const double*>(&a) + l);
#else
  return splat(a[l]);
#endif
}

/// N and dN/dx (1/m) along one axis (N03 Eq. 24). f: distance from the bin's lower end in cells. Linear functions leave dN alone: it is -1/h
/// and 1/h.
template <int Width>
void axis_weights(Pack f, double inverse_cell, Pack* N, Pack* dN) {
  if constexpr (Width == 2) {
    N[0] = 1. - f;
    N[1] = f;
  } else {
    // uGIMP without branches: t is the part of the particle on either side of the middle node, l half its size in cells.
    constexpr double half_size = .25;
    const Pack l = splat(half_size), d = f - .5, zero = splat(0.), scale = splat(1 / (4 * half_size));
    const Pack t = lane_max(-l, lane_min(l, d)), right = l + t, left = l - t;
    N[2] = fused(right * right, scale, lane_max(d - l, zero));
    N[0] = fused(left * left, scale, lane_max(-l - d, zero));
    N[1] = 1. - N[0] - N[2];
    dN[2] = right * splat(inverse_cell / (2 * half_size));
    dN[0] = left * splat(-inverse_cell / (2 * half_size));
    dN[1] = t * splat(-inverse_cell / half_size);
  }
}

}  // namespace crampon::bench
