#pragma once
/// Parallel loops whose results do not depend on the number of threads: an iteration writes only what is its own.

#include <cstddef>
#include <cstdint>

namespace crampon {

/// f(i) for i in [0, n), in any order, on `threads` threads. f must not throw.
template <class F>
void parallel_for(std::size_t n, int threads, F&& f) {
  const auto count = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads) if (threads > 1 && count > 1)
  for (std::int64_t i = 0; i < count; ++i) f(static_cast<std::size_t>(i));
}

}  // namespace crampon
