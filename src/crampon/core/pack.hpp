#pragma once
/// Four doubles side by side: the lanes of the particle loops (over particles for weights and stress, over components for nodal records).

#include <array>
#include <cmath>
#include <cstddef>

#if defined(__FMA__) && defined(__AVX2__)
#include <immintrin.h>
#endif

namespace crampon {

using Pack = double __attribute__((vector_size(32)));
using Pair = double __attribute__((vector_size(16)));
using Index4 = long long __attribute__((vector_size(32)));
inline constexpr int lanes = 4;

/// A vector at a node: (x, y) in 2D, (x, y, z, 0) in 3D.
template <int Dim>
struct NodalVectorOf;
template <>
struct NodalVectorOf<2> {
  using type = Pair;
};
template <>
struct NodalVectorOf<3> {
  using type = Pack;
};
template <int Dim>
using NodalVector = typename NodalVectorOf<Dim>::type;

inline Pack splat(double a) { return Pack{a, a, a, a}; }

/// Lane l of a Pack in memory, in all lanes: by a load. Compilers would shuffle registers, and one port alone shuffles.
inline Pack splat_lane(const Pack& a, int l) {
#if defined(__AVX2__)
  return _mm256_broadcast_sd(reinterpret_cast<const double*>(&a) + l);
#else
  return splat(a[l]);
#endif
}

template <class V>
inline V splat_as(double a) {
  if constexpr (sizeof(V) == sizeof(Pair)) {
    return Pair{a, a};
  } else {
    return Pack{a, a, a, a};
  }
}

// Fused multiply-add is written out so that compilers cannot choose for themselves (the build sets -ffp-contract=off).
#if defined(__FMA__) && defined(__AVX2__)
inline Pack fused(Pack a, Pack b, Pack c) { return _mm256_fmadd_pd(a, b, c); }
inline Pair fused(Pair a, Pair b, Pair c) { return _mm_fmadd_pd(a, b, c); }
#else
inline Pack fused(Pack a, Pack b, Pack c) { return a * b + c; }
inline Pair fused(Pair a, Pair b, Pair c) { return a * b + c; }
#endif

// Compilers make two instructions of a comparison and a choice; these give the same bits, also for zeros and NaN.
#if defined(__AVX2__)
inline Pack lane_min(Pack a, Pack b) { return _mm256_min_pd(a, b); }
inline Pack lane_max(Pack a, Pack b) { return _mm256_max_pd(a, b); }
#else
inline Pack lane_min(Pack a, Pack b) { return a < b ? a : b; }
inline Pack lane_max(Pack a, Pack b) { return a > b ? a : b; }
#endif

inline Pack lane_floor(Pack a) {
#if defined(__AVX2__)
  return _mm256_floor_pd(a);
#else
  return Pack{std::floor(a[0]), std::floor(a[1]), std::floor(a[2]), std::floor(a[3])};
#endif
}

inline Pack lane_sqrt(Pack a) {
#if defined(__AVX2__)
  return _mm256_sqrt_pd(a);
#else
  return Pack{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

inline Pack lane_exp(Pack a) { return Pack{std::exp(a[0]), std::exp(a[1]), std::exp(a[2]), std::exp(a[3])}; }
inline Pack lane_log(Pack a) { return Pack{std::log(a[0]), std::log(a[1]), std::log(a[2]), std::log(a[3])}; }

/// Rows become columns: afterwards row l holds what lane l of each row was.
inline void transpose(Pack& a, Pack& b, Pack& c, Pack& d) {
  const Pack t0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Pack t1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Pack t2 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Pack t3 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(t0, t2, 0, 1, 4, 5);
  b = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
  c = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
  d = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
}

/// {sum of a, sum of b} and {sum of a, sum of b, sum of c, 0} over lanes: 0 + 1 and 2 + 3 first.
inline Pair lane_sums(Pack a, Pack b) {
  const Pack h = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  return __builtin_shufflevector(h, h, 0, 1) + __builtin_shufflevector(h, h, 2, 3);
}
inline Pack lane_sums(Pack a, Pack b, Pack c) {
  const Pack zero = splat(0.);
  const Pack h = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Pack g = __builtin_shufflevector(c, zero, 0, 4, 2, 6) + __builtin_shufflevector(c, zero, 1, 5, 3, 7);
  return __builtin_shufflevector(h, g, 0, 1, 4, 5) + __builtin_shufflevector(h, g, 2, 3, 6, 7);
}

/// The first components of a record as a nodal vector.
template <int Dim>
inline NodalVector<Dim> leading(Pack record) {
  if constexpr (Dim == 2) {
    return __builtin_shufflevector(record, record, 0, 1);
  } else {
    return reinterpret_cast<Pack>(reinterpret_cast<Index4>(record) & Index4{-1, -1, -1, 0});  // one instruction; a shuffle makes four
  }
}

/// A nodal vector as the first components of a record, zero behind them.
template <int Dim>
inline Pack as_record(NodalVector<Dim> v) {
  if constexpr (Dim == 2) {
    return __builtin_shufflevector(v, Pair{0., 0.}, 0, 1, 2, 3);
  } else {
    return v;
  }
}

}  // namespace crampon
