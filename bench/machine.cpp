/// What this machine gives: bandwidth of copying and rate of multiply-adds of one core and of all. Prints JSON.

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "bench/machine_work.hpp"

namespace crampon::bench {
namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The shortest time that so many threads take for a step each, s.
template <class Work>
double shortest(int threads, int rounds) {
  std::vector<Work> work(static_cast<std::size_t>(threads));
  double least = 1e300;
  for (int round = 0; round < rounds; ++round) {
    const double start = seconds();
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < work.size(); ++t) others.emplace_back([&work, t] { work[t].step(); });
    work[0].step();
    for (std::thread& t : others) t.join();
    least = std::min(least, seconds() - start);
  }
  return least;
}

double copy_bandwidth(int threads) { return Copying::bytes() * threads / shortest<Copying>(threads, 15); }
double multiply_add_rate(int threads) { return MultiplyAdds::operations() * threads / shortest<MultiplyAdds>(threads, 50); }

}  // namespace
}  // namespace crampon::bench

int main() {
  const int all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  using namespace crampon::bench;
  fmt::print("{{\"threads\": [1, {}], \"copy_bytes_per_second\": [{:.4g}, {:.4g}], \"flops\": [{:.4g}, {:.4g}]}}\n", all, copy_bandwidth(1),
             copy_bandwidth(all), multiply_add_rate(1), multiply_add_rate(all));
}
