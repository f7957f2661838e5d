#pragma once
/// How cracks lie in the material at the start: which of their ends are no tips, and how much of them has material on both sides.

#include <array>
#include <cstdint>
#include <vector>

#include "crampon/geometry/region.hpp"
#include "crampon/run/build_bodies.hpp"
#include "crampon/state/cracks.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// Where there is material that cracks can part: the shapes of bodies, and the undeformed particles of bodies that are lists of them.
class Material2D {
 public:
  Material2D(const Problem& problem, const BuiltBodies<2>& bodies, const Grid<2>& grid);

  /// Edges belong to it, within 1e-9 of a cell.
  bool at(const Vec<2>& x) const;
  double cell() const { return cell_; }            ///< longest side, m
  double reach() const { return reach_ * cell_; }  ///< of lines from particles to nodes beyond an edge, m
  double hair() const { return 1e-6 * cell_; }     ///< m, by which to look beside a crack

 private:
  struct Box {
    Vec<2> low, high;
  };
  std::vector<RegionPtr> shapes_;
  std::vector<Box> particles_;  ///< by low[0]
  double cell_ = 0, reach_ = 0, widest_ = 0;
};

/// An end outside every body, or on the edge of one, is no tip: the crack goes on straight beyond it for all that ask what it cuts, as far
/// as lines from particles to nodes reach, but not into material. How far beyond the start and the end, m; 0: a tip.
std::array<double, 2> extensions(const Crack<2>& crack, const Material2D& material);

/// Ends that lie on mirrors: Crack::mirrored.
std::array<std::uint8_t, 2> mirrored_ends(const Crack<2>& crack, const Model<2>& model);

/// Per vertex: does it have material on both sides, or lie on the edge of such a place?
std::vector<bool> between_material(const Crack<2>& crack, const Material2D& material);

/// Per vertex, its share of the length of crack that has material on both sides, between vertices that bear the law, m: the integral of the
/// function that is 1 at the vertex and 0 at its neighbours.
std::vector<double> areas_between(const Crack<2>& crack, const std::vector<bool>& bears, const Material2D& material);

}  // namespace crampon
