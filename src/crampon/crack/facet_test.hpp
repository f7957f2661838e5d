#pragma once
/// Does the line from a particle to a node cross one facet? In the plane crack/segment_test.hpp tells, in space crack/triangle_test.hpp.
///
/// A test is made for one facet and one particle, so that what depends on the particle alone is done once, and is then asked about nodes whose
/// lines come near the facet (FacetBox). It says
///   crossed_to(node)  does the line to the node cross the facet?
///   above()           is the particle above it?
///   other(node)       the facet beyond the part of the outline through which the line to the node goes, or the facet itself when the line
///                     keeps away from the outline. Both of them are crossed then, though only one counts.

#include "crampon/crack/crack_mesh.hpp"

namespace crampon {

template <int Dim>
class FacetTest;

/// The box about a facet, axis by axis.
template <int Dim>
class FacetBox {
 public:
  FacetBox(const CrackMesh<Dim>& crack, FacetId facet) {
    const Facet<Dim>& corners = crack.facets[facet];
    low_ = high_ = crack.vertices[corners[0]];
    for (std::size_t v = 1; v < Dim; ++v) {
      const Vec<Dim>& x = crack.vertices[corners[v]];
      for (int k = 0; k < Dim; ++k) {
        low_[k] = x[k] < low_[k] ? x[k] : low_[k];
        high_[k] = x[k] > high_[k] ? x[k] : high_[k];
      }
    }
  }
  /// Has it no point in common with the box from `low` to `high` (conventions 22: touching is common)?
  bool apart_from_box(const Vec<Dim>& low, const Vec<Dim>& high) const {
    for (int k = 0; k < Dim; ++k) {
      if (high_[k] < low[k] || low_[k] > high[k]) return true;
    }
    return false;
  }
  /// ... with the box about the line from p to n?
  bool apart(const Vec<Dim>& p, const Vec<Dim>& n) const {
    for (int k = 0; k < Dim; ++k) {
      const double low = p[k] < n[k] ? p[k] : n[k], high = p[k] < n[k] ? n[k] : p[k];
      if (high_[k] < low || low_[k] > high) return true;
    }
    return false;
  }

 private:
  Vec<Dim> low_, high_;
};

}  // namespace crampon
