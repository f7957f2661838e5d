#pragma once
/// Faces of two bodies about a node where one fills a corner of the other: docs/theory/contact.md, corners.

#include <array>
#include <span>
#include <vector>

#include "crampon/contact/normal.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// A particle with its outline.
template <int Dim>
struct OutlinedPoint {
  Vec<Dim> x;                            ///< from the node, m
  std::array<Vec<Dim>, Dim> half_edges;  ///< from its middle to the middles of its faces, m
  double weight = 1;                     ///< in the regressions
  ContactSide side = ContactSide::a;
};

/// One of the faces by which two bodies meet.
template <int Dim>
struct CornerFace {
  Vec<Dim> n;                           ///< unit normal, from a to b
  std::vector<std::uint8_t> is_before;  ///< by point: does it lie before this face? All of the body that fills the corner do
};

/// The faces of a corner, at most Dim, in an order that does not change from step to step. Empty where one plane with normal n parts the
/// two about as well. `cell` in m.
template <int Dim>
std::vector<CornerFace<Dim>> find_corner(std::span<const OutlinedPoint<Dim>> points, const Vec<Dim>& n, const Vec<Dim>& cell);

}  // namespace crampon
