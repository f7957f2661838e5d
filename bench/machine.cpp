/// What this machine gives: bandwidth of copying and rate of multiply-adds of one core and of all. Prints JSON.

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "crampon/core/pack.hpp"

namespace crampon::bench {
namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Runs f(thread) on so many threads, several times; the shortest time, s.
template <class F>
double shortest(int threads, F f) {
  double least = 1e300;
  for (int round = 0; round < 7; ++round) {
    const double start = seconds();
    std::vector<std::thread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(f, t);
    f(0);
    for (std::thread& t : others) t.join();
    least = std::min(least, seconds() - start);
  }
  return least;
}

/// Bytes per second that cross the memory bus in a copy: each item is read, its place in the target fetched, and written.
double copy_bandwidth(int threads) {
  const std::size_t items = std::size_t{1} << 24;  // 128 MB per array and thread: beyond any cache
  std::vector<std::vector<double>> from, to;
  for (int t = 0; t < threads; ++t) from.emplace_back(items, 1.), to.emplace_back(items, 0.);
  const double time = shortest(threads, [&](int t) {
    const double* a = from[static_cast<std::size_t>(t)].data();
    double* b = to[static_cast<std::size_t>(t)].data();
    for (std::size_t i = 0; i < items; ++i) b[i] = 1.5 * a[i];  // no memcpy, which may write past the caches
  });
  return 3. * 8. * static_cast<double>(items) * threads / time;
}

/// Floating-point operations per second in multiply-adds on registers.
double multiply_add_rate(int threads) {
  constexpr int chains = 10, rounds = 20'000'000;
  std::vector<double> sink(static_cast<std::size_t>(threads) * 8);
  const double time = shortest(threads, [&](int t) {
    Pack x[chains];
    for (int c = 0; c < chains; ++c) x[c] = splat(1 + 1e-3 * c);
    const Pack a = splat(1 - 1e-9), b = splat(1e-9);
    for (int r = 0; r < rounds; ++r) {
      for (Pack& y : x) y = fused(y, a, b);
    }
    Pack sum = splat(0.);
    for (const Pack& y : x) sum += y;
    sink[static_cast<std::size_t>(t) * 8] = sum[0];
  });
  return 2. * lanes * chains * static_cast<double>(rounds) * threads / time;
}

}  // namespace
}  // namespace crampon::bench

int main() {
  const int all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  using namespace crampon::bench;
  fmt::print("{{\"threads\": [1, {}], \"copy_bytes_per_second\": [{:.4g}, {:.4g}], \"flops\": [{:.4g}, {:.4g}]}}\n", all, copy_bandwidth(1),
             copy_bandwidth(all), multiply_add_rate(1), multiply_add_rate(all));
}
