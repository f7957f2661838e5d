#include "crampon/crack/symmetry_fold.hpp"

#include <cmath>

#include "crampon/core/predicates.hpp"

namespace crampon {

namespace {

/// Where the line particle -> node meets the plane, seen in the projection on (axis k, plane's normal): -1 when at a smaller x[k]
/// than `end`, 0 when exactly there, +1 when at a larger one.
template <int Dim>
int meets_beside(const SymmetryPlane& plane, int k, double end, const Vec<Dim>& particle, const Vec<Dim>& node) {
  const Vec<2> p{particle[k], particle[plane.axis]}, n{node[k], node[plane.axis]};
  // Looking from p to n, which goes down when the body is above, larger x[k] are on the left.
  return -plane.side * orient_sign(p, n, {end, plane.at});
}

}  // namespace

template <int Dim>
bool folds(const SymmetryPlane& plane, const Vec<Dim>& particle, const Vec<Dim>& node) {
  if (!(plane.side * node[plane.axis] < plane.side * plane.at)) return false;
  if (plane.side * particle[plane.axis] < plane.side * plane.at) return false;
  for (int k = 0; k < Dim; ++k) {
    if (k == plane.axis) continue;
    if (std::isfinite(plane.from[k]) && meets_beside(plane, k, plane.from[k], particle, node) < 0) return false;
    if (std::isfinite(plane.to[k]) && meets_beside(plane, k, plane.to[k], particle, node) > 0) return false;
  }
  return true;
}

template <int Dim>
bool on_plane(const SymmetryPlane& plane, const Vec<Dim>& node) {
  if (node[plane.axis] != plane.at) return false;
  for (int k = 0; k < Dim; ++k) {
    if (k == plane.axis) continue;
    if (std::isfinite(plane.from[k]) && node[k] < plane.from[k]) return false;
    if (std::isfinite(plane.to[k]) && node[k] > plane.to[k]) return false;
  }
  return true;
}

template bool folds<2>(const SymmetryPlane&, const Vec<2>&, const Vec<2>&);
template bool folds<3>(const SymmetryPlane&, const Vec<3>&, const Vec<3>&);
template bool on_plane<2>(const SymmetryPlane&, const Vec<2>&);
template bool on_plane<3>(const SymmetryPlane&, const Vec<3>&);

}  // namespace crampon
