#pragma once
/// What particles read from nodes (N03 Eq. 30).

#include "crampon/step/packs.hpp"

namespace crampon {

/// {v', a} at a particle: sum S_ip {v'_i, a_i}.
template <int Dim, class Shape>
inline MotionRecord<Dim> interpolate(const Stencil<Dim, Shape>& s, const PairTarget* targets, int l, const MotionRecord<Dim>* motion,
                                     const std::vector<MotionRecord<Dim>>& offsets) {
  MotionRecord<Dim> sum;
  if constexpr (Stencil<Dim, Shape>::separable) {
    if (!targets) {
      const SeparableSums<Shape> sums(s);
      const MotionRecord<Dim>* lowest = motion + s.of.base[l];
      for (int r = 0; r < 2; ++r) sum.r[r] = sums.interpolate(l, [&](int node) { return lowest[node].r[r]; });
      return sum;
    }
  }
  for (Pack& r : sum.r) r = splat(0.);
  for_stencil<Dim, Shape>(s, targets, l, motion, [&](const MotionRecord<Dim>& m, int n, const PairTarget& t) {
    const unsigned flip = Dim == 2 ? t.flip | unsigned{t.flip} << 2 : t.flip;
    const Pack S = splat(s.weight(n, l));
    for (int r = 0; r < motion_packs<Dim>; ++r) {
      const Pack read = targets ? flipped(m.r[r], flip) + offsets[t.offset].r[r] : m.r[r];
      sum.r[r] = fused(S, read, sum.r[r]);
    }
  });
  return sum;
}

}  // namespace crampon
