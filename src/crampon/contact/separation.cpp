#include "crampon/contact/separation.hpp"

namespace crampon {

double position_gap(double x_a, const EdgeMap& edge_a, double x_b, const EdgeMap& edge_b, const PlaneInCells& plane) {
  return plane.h * (edge_a.edge_distance(-x_a / plane.h, plane) + edge_b.edge_distance(x_b / plane.h, plane));
}

double contact_area(double V_a, const EdgeMap& edge_a, double V_b, const EdgeMap& edge_b, const PlaneInCells& plane) {
  const double V = V_a + V_b, smaller = std::fmin(V_a, V_b);
  if (!(smaller > 0)) return 0;
  return V * (V_a < V_b ? edge_a : edge_b).area_of(smaller / V, plane) / plane.h;
}

double contact_area(double V_a, double V_b, double end_of_a, double begin_of_b, const EdgeMap& edge, const PlaneInCells& plane) {
  return (V_a + V_b) * edge.area_at((end_of_a + begin_of_b) / (2 * plane.h), plane) / plane.h;
}

}  // namespace crampon
