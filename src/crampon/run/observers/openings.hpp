#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/run/observers/observer.hpp"
#include "crampon/step/crack_motion.hpp"

namespace crampon {

/// How far cracks open and slide, over the vertices with material on both sides but for ends; over all when there are none.
template <int Dim>
class Openings final : public Observer<Dim> {
  struct Extremes {
    double low = std::numeric_limits<double>::infinity(), high = -low, slid = 0;  ///< m
  };

 public:
  static const auto& table() {
    static const std::vector<Column<Extremes>> all = {
        {{"opening_min.NAME", "m", "smallest opening of a crack, between its tips", "(x_upper - x_lower) along the normal of the crack"},
         [](const Extremes& e, int) { return e.low; }},
        {{"opening_max.NAME", "m", "largest opening of a crack, between its tips", "(x_upper - x_lower) along the normal of the crack"},
         [](const Extremes& e, int) { return e.high; }},
        {{"sliding_max.NAME", "m", "largest sliding of a crack in either sense, between its tips",
          "size of (x_upper - x_lower) along the crack"},
         [](const Extremes& e, int) { return e.slid; }},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override {
    if constexpr (Dim == 2) {
      for (std::size_t c = 0; c < now.state.cracks.size(); ++c) {
        const Crack<2>& leading = now.state.cracks.list[c];
        cells.add<Dim>(table(), extremes_of(present_crack(now.state, now.work, leading), now.state.observed.cracked[c]), leading.name);
      }
    }
  }

 private:
  static Extremes extremes_of(const Crack<2>& crack, const std::vector<bool>& cracked) {
    const std::size_t n = crack.plane.size();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (n == 0) return {none, none, none};  // it has not started
    const auto counts = [&](std::size_t v) { return cracked[v] && (crack.closed || (v > 0 && v + 1 < n)); };
    bool any = false;
    for (std::size_t v = 0; v < n; ++v) any = any || counts(v);
    const std::vector<CrackOpening> openings = openings_of(crack);
    Extremes e;
    for (std::size_t v = 0; v < n; ++v) {
      if (any && !counts(v)) continue;
      const CrackOpening& o = openings[v];
      e.low = std::fmin(e.low, o.opening);
      e.high = std::fmax(e.high, o.opening);
      e.slid = std::fmax(e.slid, std::fabs(o.sliding));
    }
    return e;
  }
};

}  // namespace crampon
