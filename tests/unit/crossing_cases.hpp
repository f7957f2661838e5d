#pragma once
// Random and degenerate cracks for the tests of crossing.

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/crack/crossing.hpp"

namespace crampon::testing {

using Rng = std::mt19937_64;
using Points = std::vector<Vec<2>>;

inline int pick(Rng& rng, int low, int high) { return std::uniform_int_distribution<int>(low, high)(rng); }
inline double draw(Rng& rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }

inline std::vector<Vec<2>> unit_normals(const Points& v) {
  std::vector<Vec<2>> n;
  for (std::size_t s = 0; s + 1 < v.size(); ++s) {
    const Vec<2> d = v[s + 1] - v[s];
    n.push_back(normalized(Vec<2>{d[1], -d[0]}));
  }
  return n;
}

/// A polyline that owns its points.
struct Polyline {
  Points vertices;
  std::vector<Vec<2>> normals;
  bool closed;
  Polyline(Points v, bool closed_ = false) : vertices(std::move(v)), normals(unit_normals(vertices)), closed(closed_) {}
  CrackPath path() const { return {vertices, normals, closed}; }
};

}  // namespace crampon::testing
