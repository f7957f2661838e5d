#include "crampon/contact/separation.hpp"

namespace crampon {

double position_gap(double x_a, const EdgeMap& edge_a, double x_b, const EdgeMap& edge_b, const PlaneInCells& plane) {
  return plane.h * (edge_a.edge_distance(-x_a / plane.h, plane) + edge_b.edge_distance(x_b / plane.h, plane));
}

double contact_area(double V_a, double x_a, const EdgeMap& edge_a, double V_b, double x_b, const EdgeMap& edge_b,
                    const PlaneInCells& plane) {
  if (!(std::fmin(V_a, V_b) > 0)) return 0;
  const double d_a = edge_a.edge_distance(-x_a / plane.h, plane), d_b = edge_b.edge_distance(x_b / plane.h, plane);
  const double seen = edge_a.volume_at(d_a, plane) + edge_b.volume_at(d_b, plane);
  const double part = 0.5 * (edge_a.area_at(d_a, plane) + edge_b.area_at(d_b, plane));
  return seen > 0 ? part * (V_a + V_b) / (seen * plane.h) : 0.;
}

}  // namespace crampon
