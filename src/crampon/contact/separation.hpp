#pragma once
/// Distance between two materials a and b at a node, and the area by which they face each other there: docs/theory/contact.md,
/// detection and area. The normal n points from a to b; positions along it are taken from the node.

#include <array>
#include <cmath>
#include <limits>

#include "crampon/contact/edge_map.hpp"
#include "crampon/contact/normal.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Gap from the mean positions x.n of the particles of both, weighted by m_p S_ip, m. Negative when they overlap.
double position_gap(double x_a, const EdgeMap& edge_a, double x_b, const EdgeMap& edge_b, const PlaneInCells& plane);

/// Particles as bodies, and what they occupy along n (Nairn, Hammerquist & Smith, CMAME 362 (2020)). Reads bodies whose surface is a
/// staircase of particles as closer than they are, by up to half the diagonal of a particle each.
template <int Dim>
class RegressionGap {
 public:
  explicit RegressionGap(const Vec<Dim>& n) : n_(n) {}

  /// A particle with its middle at x, m; half_edges: of the deformed particle, from its middle to the middles of its faces, m.
  void add(const Vec<Dim>& x, const std::array<Vec<Dim>, Dim>& half_edges, ContactSide side) {
    double half = 0;
    for (const Vec<Dim>& r : half_edges) half += std::fabs(dot(n_, r));
    const double at = dot(n_, x);
    if (side == ContactSide::a) {
      end_of_a_ = std::fmax(end_of_a_, at + half);
    } else {
      begin_of_b_ = std::fmin(begin_of_b_, at - half);
    }
  }

  /// m; negative when they overlap, infinite while a side has no particle.
  double gap() const { return begin_of_b_ - end_of_a_; }
  double end_of_a() const { return end_of_a_; }
  double begin_of_b() const { return begin_of_b_; }

 private:
  Vec<Dim> n_;
  double end_of_a_ = -std::numeric_limits<double>::infinity(), begin_of_b_ = std::numeric_limits<double>::infinity();
};

/// Area of the face between a and b that belongs to the node, m^2 (in 2D, from volumes that are areas: m), from their volumes and the mean
/// positions as in position_gap. Where they touch, edges across an axis and uGIMP give about sqrt(2 min(V_a, V_b) (V_a + V_b))/h
/// (Nairn, CMES 92 (2013) 271); a gap between them does not make the face smaller.
double contact_area(double V_a, double x_a, const EdgeMap& edge_a, double V_b, double x_b, const EdgeMap& edge_b,
                    const PlaneInCells& plane);

}  // namespace crampon
