#pragma once
/// Where a body ends, told from what a node sees of it through its shape function: docs/theory/contact.md, detection and area.

#include <array>
#include <span>
#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// Size of a cell across a plane with unit normal n, m. In units of the cell per axis the plane n.x = d is as far as d/h from the origin,
/// and its unit normal there is n_k cell_k/h.
template <int Dim>
double perpendicular_cell(const Vec<Dim>& cell, const Vec<Dim>& n);

/// How a plane lies in the cells.
struct PlaneInCells {
  double h = 1;                         ///< perpendicular_cell, m
  std::array<double, 3> axis{1, 0, 0};  ///< squares of the components of its normal in units of the cell: their sum is 1
  double oblique = 0;                   ///< 0 with the normal along an axis, 1 midway between two (or more)
};
template <int Dim>
PlaneInCells plane_in_cells(const Vec<Dim>& cell, const Vec<Dim>& n);

/// How particles fill a body up to its edge.
enum class Packing {
  layers,     ///< in rows along it, the outermost half a particle inside: exact for blocks; staircases of particles 2l long read l^2 closer
  continuous  ///< at random: right for staircases, but blocks of particles 2l long read l^2 too far away
};

/// What a node sees of a half-space of particles whose edge is d cells away, the particles being ahead of it. One table for edges
/// across an axis (one for each, where particles are not equally long), one for those midway between two axes. In between their
/// values mix in proportion to the fourth cumulant of the true profile along n, which 1 - sum n_k^4 gives. Immutable.
class EdgeMap {
 public:
  /// Half sizes of particles in cells: one for all axes, or one for each.
  using HalfSizes = std::span<const double>;
  /// boxes: of the shape function.
  EdgeMap(ProfileBoxes boxes, HalfSizes half_sizes, Packing packing = Packing::layers);

  /// Knows no shape function: takes the mean position for the edge, and every area for zero.
  EdgeMap() = default;

  /// The distance d of the edge, in cells, when the mean position of the particles is p cells ahead of the node. d is continuous and
  /// increases with p. Where the node does not see the edge, or sees a single layer of particles, the table ends, and d changes by as much
  /// as p does.
  double edge_distance(double p, const PlaneInCells& plane = {}) const;
  /// The node's part of the area of an edge at distance d, over V_i/h.
  double area_at(double d, const PlaneInCells& plane = {}) const;
  /// The part of a node's volume that particles have whose edge is at distance d.
  double volume_at(double d, const PlaneInCells& plane = {}) const;

 private:
  /// Columns over equal steps of d.
  struct Table {
    double low = -1, step = 2;
    std::vector<double> p{-1, 1};    ///< mean position, increasing
    std::vector<double> rest{0, 1};  ///< what the others have of the node's volume, increasing
    std::vector<double> area{0, 0};  ///< parts of nodes that see both sides add up to 1
    double find(const std::vector<double>& column, double value) const;
    double read(const std::vector<double>& column, double d) const;
  };
  static Table tabulate(ProfileBoxes boxes, std::span<const double> direction, double half_size, Packing packing);
  template <class F>
  double mix(const PlaneInCells& plane, F value) const;

  std::vector<Table> straight_{Table{}};  ///< one, or one for each axis
  Table diagonal_;
};

}  // namespace crampon
