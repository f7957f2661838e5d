#pragma once
/// Rigid walls known by a formula: where their surface is, and which way is out.

#include <cmath>

#include "crampon/core/vector.hpp"
#include "crampon/state/grid.hpp"

namespace crampon {

/// The surface as a point sees it.
template <int Dim>
struct WallView {
  double distance = 0;  ///< of the point outside the wall, m; negative inside
  Vec<Dim> out;         ///< unit normal out of the wall; zero where there is none (a sphere's centre)
};

/// A half-plane (2D), a half-space, a disk or a ball, or all space around a disk or a ball.
template <int Dim>
struct Wall {
  enum class Kind { half_space, ball, hollow } kind = Kind::half_space;
  Vec<Dim> normal;    ///< half_space: unit, out of the wall
  double radius = 0;  ///< ball, hollow: m

  /// at: a point of the half-space's surface, or the centre of the ball, now.
  WallView<Dim> seen_from(const Vec<Dim>& x, const Vec<Dim>& at) const {
    if (kind == Kind::half_space) return {dot(x - at, normal), normal};
    const double r = norm(x - at);
    const Vec<Dim> out = normalized(x - at);
    return kind == Kind::ball ? WallView<Dim>{r - radius, out} : WallView<Dim>{radius - r, -out};
  }
};

/// Distance from a wall, m, beyond which it holds no node, however it lies in the cells.
template <int Dim>
double wall_reach(const Grid<Dim>& grid) {
  double h = 0;
  for (int k = 0; k < Dim; ++k) h = std::fmax(h, grid.cell[k]);
  return h;
}

}  // namespace crampon
