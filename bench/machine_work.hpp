#pragma once
/// Work of one core whose time tells what the machine gives: copying memory, and multiplying and adding in registers.

#include <cstddef>
#include <vector>

#include "crampon/core/pack.hpp"

namespace crampon::bench {

class Copying {
 public:
  void step() {
    // no memcpy, which may write past the caches
    for (std::size_t i = 0; i < items; ++i) to_[i] = 1.5 * from_[i];
  }
  /// That cross the memory bus in a step: each item is read, its place in the target fetched, and written.
  static constexpr double bytes() { return 3. * sizeof(double) * items; }

 private:
  static constexpr std::size_t items = std::size_t{1} << 23;  // 64 MB per array: beyond any cache
  std::vector<double> from_ = std::vector<double>(items, 1.), to_ = std::vector<double>(items, 0.);
};

class MultiplyAdds {
 public:
  void step() {
    Pack x[chains];
    for (int c = 0; c < chains; ++c) x[c] = splat(1 + 1e-3 * c);
    const Pack a = splat(1 - 1e-9), b = splat(1e-9);
    for (int r = 0; r < rounds; ++r) {
      for (Pack& y : x) y = fused(y, a, b);
    }
    Pack sum = splat(0.);
    for (const Pack& y : x) sum += y;
    sink_ = sum[0];
  }
  static constexpr double operations() { return 2. * lanes * chains * rounds; }

 private:
  static constexpr int chains = 10, rounds = 2'000'000;  // chains enough to hide how long one operation takes
  volatile double sink_ = 0;                             // so that the work is done
};

}  // namespace crampon::bench
