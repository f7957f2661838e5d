#pragma once
/// What a shape function is along one axis, for everything that needs no values at a particle: how far it reaches, how smooth it is, and what a
/// node sees of the edge of a body (contact/edge_map.hpp).

namespace crampon {

/// The profile is a box of one cell's width folded `cell` times with itself, then with `particle` boxes of the particle's width, then with `ends`
/// pairs of equal weights at the two ends of the particle. Two boxes of a cell are the linear function, three the quadratic B-spline, four the
/// cubic one; two of a cell and one of the particle are uGIMP.
struct ProfileBoxes {
  int cell = 0;
  int particle = 0;
  int ends = 0;

  friend constexpr bool operator==(const ProfileBoxes&, const ProfileBoxes&) = default;
  /// Does the size of the particle not matter?
  constexpr bool of_points() const { return particle == 0 && ends == 0; }
  /// How many derivatives are continuous. Each box after the second makes one more so.
  constexpr int smoothness() const { return cell + particle - 2; }
  /// Cells from a particle to the furthest node that has a weight. half_size: of the particle, cells.
  constexpr double reach(double half_size) const { return reach_of_sums() + (particle + ends) * half_size; }
  /// How far from a node, in cells, material ends that the node sees to the full: functions of points, and of domains that meet without gaps.
  constexpr double reach_of_sums() const { return 0.5 * cell; }
};

}  // namespace crampon
