#pragma once
/// Polygon with holes.

#include <string>
#include <vector>

#include "crampon/geometry/region.hpp"

namespace crampon {

using Corners = std::vector<Vec<2>>;  ///< m, in either sense of rotation; the last corner is joined to the first

/// Points inside or on the outer loop and not strictly inside a hole. Points exactly on an edge are found to be on it by exact
/// arithmetic: containment with zero slack is right for every double.
class Polygon final : public Region {
 public:
  /// Loops as find_polygon_faults accepts them; a last corner that repeats the first is dropped.
  explicit Polygon(Corners outer, std::vector<Corners> holes = {});
  double distance(const Vec<3>& x) const override;
  Vec<3> outward(const Vec<3>& x) const override;
  Bounds3 bounds() const override { return bounds_; }
  std::optional<double> measure() const override { return area_; }

 private:
  struct Edge {
    Vec<2> from, to;
    Vec<2> normal;                           // unit, outward
    Vec<2> normal_before{}, normal_after{};  // of the neighbours at from and to
  };
  void add_loop(const Corners& loop, bool hole);
  std::vector<Edge> edges_;
  Bounds3 bounds_;
  double area_ = 0;
};

struct PolygonFault {
  int loop;          ///< -1: outer; else the hole, from 0
  std::string what;  ///< a sentence without the name of the loop
};
/// What keeps these loops from bounding an area: too few corners, corners that repeat, edges that touch or cross, holes outside, nested
/// or touching. Empty when all is well.
std::vector<PolygonFault> find_polygon_faults(const Corners& outer, const std::vector<Corners>& holes);

}  // namespace crampon
