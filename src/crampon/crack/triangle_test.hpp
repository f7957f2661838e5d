#pragma once
/// Does the line from a particle to a node cross a triangle of a crack in space? The input refuses such cracks, so that no test is ever made.

#include <stdexcept>

#include "crampon/crack/facet_test.hpp"

namespace crampon {

template <>
class FacetTest<3> {
 public:
  FacetTest(const CrackMesh<3>&, FacetId, const Vec<3>&) { throw std::logic_error("nothing tells yet whether a line crosses a triangle"); }

  bool above() const { return true; }
  bool crossed_to(const Vec<3>&) const { return false; }
  FacetId other(const Vec<3>&) const { return no_facet; }
};

}  // namespace crampon
