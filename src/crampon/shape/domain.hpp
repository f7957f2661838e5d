#pragma once
/// Domains of particles that stretch, shear and turn with the nodes (CPDI; Sadeghirad, Brannon & Burghardt, IJNME 86 (2011) 1435): S_ip is the mean
/// of the linear function of node i over the corners of the domain, G_ip the gradient of what is linear in the domain and has its values at the corners.

#include "crampon/core/pack.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Half edges of the domains of four particles in cells: component k of edge j; lanes over particles.
template <int Dim>
struct DomainEdges {
  Pack r[Dim][Dim];
};

/// Half an extent along an axis of more than this would need a fourth node: it counts as this, in cells.
inline constexpr double largest_half_extent = 0.5;

/// A corner this close to a line of nodes is on it, cells: else the nodes beyond the line would have a mass that is none.
inline constexpr double on_line = 1e-12;
inline Pack snap_to_line(Pack at) { return lane_max(at, -at) < splat(on_line) ? splat(0.) : at; }

/// S_ip and G_ip of parallelograms as sums of products over their corners, in the plane. Nodes are the nearest one and its neighbours.
struct CornerFactors {
  static constexpr int count = 4, width = 3;
  Pack N[count][2][width];  ///< linear functions at a corner
  Pack slope[count][2];     ///< by which the value at a corner enters the gradient, 1/m

  /// d: from the nearest node to the particle, cells.
  template <class InverseCell>
  void compute(const Pack* d, DomainEdges<2> edges, const InverseCell& inverse_cell) {
    const Pack zero = splat(0.);
    auto& r = edges.r;
    for (auto& along : r) {
      const Pack extent = lane_max(along[0], -along[0]) + lane_max(along[1], -along[1]);
      const Pack part = splat(largest_half_extent) / lane_max(extent, splat(largest_half_extent));
      along[0] *= part, along[1] *= part;
    }
    const Pack by_area = 0.25 / (r[0][0] * r[1][1] - r[0][1] * r[1][0]);
    const Pack across[2][2] = {{r[1][1] * by_area, -r[0][1] * by_area}, {-r[1][0] * by_area, r[0][0] * by_area}};  // [edge][axis]
    for (int c = 0; c < count; ++c) {
      const double s[2] = {c % 2 == 0 ? -1. : 1., c / 2 == 0 ? -1. : 1.};
      for (int k = 0; k < 2; ++k) {
        const Pack at = snap_to_line(d[k] + s[0] * r[k][0] + s[1] * r[k][1]);
        N[c][k][0] = lane_max(-at, zero);
        N[c][k][2] = lane_max(at, zero);
        N[c][k][1] = lane_max(1. - N[c][k][0] - N[c][k][2], zero);
        slope[c][k] = (s[0] * across[0][k] + s[1] * across[1][k]) * splat(inverse_cell[k]);
      }
    }
  }
};

/// The same for boxes along the axes, axis by axis, in space. d as above.
inline void box_factors(Pack d, Pack half_extent, double inverse_cell, Pack* N, Pack* dN) {
  const Pack l = lane_min(half_extent, splat(largest_half_extent)), zero = splat(0.);
  const Pack low = snap_to_line(d - l), high = snap_to_line(d + l);
  const Pack low_right = lane_max(low, zero), high_right = lane_max(high, zero);  // linear function of the upper node
  const Pack low_left = lane_max(-low, zero), high_left = lane_max(-high, zero);  // of the lower node
  N[2] = 0.5 * (low_right + high_right);
  N[0] = 0.5 * (low_left + high_left);
  N[1] = 1. - N[0] - N[2];
  const Pack scale = splat(0.5 * inverse_cell) / l;
  dN[2] = (high_right - low_right) * scale;
  dN[0] = (high_left - low_left) * scale;
  dN[1] = -(dN[0] + dN[2]);
}

}  // namespace crampon
