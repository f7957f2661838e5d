#pragma once
/// Does the line from a particle to a node cross a segment of a crack in the plane? (docs/theory/crossing.md; N03 Task 1)

#include <cstdint>

#include "crampon/core/predicates.hpp"
#include "crampon/crack/facet_test.hpp"

namespace crampon {

template <>
class FacetTest<2> {
 public:
  FacetTest(const CrackMesh<2>& crack, FacetId segment, const Vec<2>& particle)
      : crack_(crack),
        segment_(segment),
        before_(crack.neighbours[segment][0]),
        after_(crack.neighbours[segment][1]),
        particle_(particle),
        a_(crack.vertices[crack.facets[segment][0]]),
        b_(crack.vertices[crack.facets[segment][1]]),
        above_(particle_above(a_, b_, particle)) {
    if (particle == b_ && after_ != no_facet) {
      corner_ = Corner::end;
    } else if (particle == a_ && before_ != no_facet) {
      corner_ = Corner::start;
    }
  }

  bool above() const { return above_; }

  bool crossed_to(const Vec<2>& node) const {
    if (corner_ == Corner::end) return corner_crossed(segment_, after_, node, true);
    if (corner_ == Corner::start) return corner_crossed(before_, segment_, node, false);
    return node_above(a_, b_, node) != above_ && passes_between(node);
  }

  /// A line through a vertex crosses both segments that meet there, whichever counts.
  FacetId other(const Vec<2>& node) const {
    FacetId other = segment_;
    if (before_ != no_facet && orient_sign(particle_, node, a_) == 0) other = before_;
    if (after_ != no_facet && orient_sign(particle_, node, b_) == 0) other = after_;
    return other;
  }

 private:
  enum class Corner : std::uint8_t { none, start, end };

  /// Sign of the perturbed node beside a -> b as "above" or "below"; it is never on the line.
  static bool node_above(const Vec<2>& a, const Vec<2>& b, const Vec<2>& node) { return orient_sign_perturbed(a, b, node) >= 0; }
  static bool particle_above(const Vec<2>& a, const Vec<2>& b, const Vec<2>& particle) { return orient_sign(a, b, particle) >= 0; }

  /// Does the line to the node, which is on the other side of a -> b than the particle, pass between a and b?
  bool passes_between(const Vec<2>& node) const {
    // Tip tie rule, with the node where it is: touching a tip is no crossing.
    if (before_ == no_facet && orient_sign(particle_, node, a_) == 0) return false;
    if (after_ == no_facet && orient_sign(particle_, node, b_) == 0) return false;
    // orient(p, n, v) = -orient(p, v, n); zero, for a particle on the vertex, counts as positive.
    return (orient_sign_perturbed(particle_, a_, node) <= 0) != (orient_sign_perturbed(particle_, b_, node) <= 0);
  }

  /// A particle on the vertex v between u -> v and v -> w is thought moved a little into the corner above the crack. Its line crosses
  /// the crack at v when it leaves into the corner below; the crossing is given to the first of the two segments that has the node
  /// below it and is not excused by the tip rule.
  bool corner_crossed(FacetId before, FacetId after, const Vec<2>& node, bool asked_for_before) const {
    const Vec<2>&u = crack_.vertices[crack_.facets[before][0]], &v = crack_.vertices[crack_.facets[before][1]],
          &w = crack_.vertices[crack_.facets[after][1]];
    const bool below_before = !node_above(u, v, node), below_after = !node_above(v, w, node);
    const bool reflex_below = orient_sign(u, v, w) >= 0;
    if (!(reflex_below ? below_before || below_after : below_before && below_after)) return false;
    const bool tie_before = crack_.neighbours[before][0] == no_facet && orient_sign(v, node, u) == 0;
    const bool tie_after = crack_.neighbours[after][1] == no_facet && orient_sign(v, node, w) == 0;
    const bool to_before = below_before && !tie_before;
    return asked_for_before ? to_before : !to_before && below_after && !tie_after;
  }

  const CrackMesh<2>& crack_;
  FacetId segment_, before_, after_;
  const Vec<2>&particle_, &a_, &b_;
  bool above_;
  Corner corner_ = Corner::none;
};

}  // namespace crampon
