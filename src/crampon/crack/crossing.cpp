#include "crampon/crack/crossing.hpp"

#include <algorithm>

namespace crampon {

namespace {

bool has_start(TipRule tips) { return (static_cast<int>(tips) & static_cast<int>(TipRule::start)) != 0; }
bool has_end(TipRule tips) { return (static_cast<int>(tips) & static_cast<int>(TipRule::end)) != 0; }

/// Sign of the perturbed node beside a -> b as "above" or "below"; it is never on the line.
bool node_above(const Vec<2>& a, const Vec<2>& b, const Vec<2>& node) { return orient_sign_perturbed(a, b, node) >= 0; }
bool particle_above(const Vec<2>& a, const Vec<2>& b, const Vec<2>& particle) { return orient_sign(a, b, particle) >= 0; }

/// Boxes of the line and the segment without a common point (conventions 22: touching is common).
bool apart(double p, double n, double a, double b) {
  const double low = p < n ? p : n, high = p < n ? n : p;
  return (a < low && b < low) || (a > high && b > high);
}
bool boxes_apart(const Vec<2>& p, const Vec<2>& n, const Vec<2>& a, const Vec<2>& b) {
  return apart(p[0], n[0], a[0], b[0]) || apart(p[1], n[1], a[1], b[1]);
}

/// Does the line p -> n, whose ends are on different sides of a -> b, pass between a and b?
bool passes_between(const Vec<2>& p, const Vec<2>& n, const Vec<2>& a, const Vec<2>& b, TipRule tips) {
  // Tip tie rule, with the node where it is: touching a tip is no crossing.
  if (has_start(tips) && orient_sign(p, n, a) == 0) return false;
  if (has_end(tips) && orient_sign(p, n, b) == 0) return false;
  // orient(p, n, v) = -orient(p, v, n); zero, for a particle on the vertex, counts as positive.
  return (orient_sign_perturbed(p, a, n) <= 0) != (orient_sign_perturbed(p, b, n) <= 0);
}

/// A particle on the vertex v between u -> v and v -> w is thought moved a little into the corner above the path. Its line crosses
/// the path at v when it leaves into the corner below; the crossing is given to the first of the two segments that has the node
/// below it and is not excused by the tip rule.
bool corner_crossed(const CrackPath& crack, std::size_t before, std::size_t after, const Vec<2>& node, bool asked_for_before) {
  const Vec<2>&u = crack.vertices[before], &v = crack.vertices[before + 1], &w = crack.vertices[after + 1];
  const bool below_before = !node_above(u, v, node), below_after = !node_above(v, w, node);
  const bool reflex_below = orient_sign(u, v, w) >= 0;
  if (!(reflex_below ? below_before || below_after : below_before && below_after)) return false;
  const bool tie_before = has_start(crack.tip_rule(before)) && orient_sign(v, node, u) == 0;
  const bool tie_after = has_end(crack.tip_rule(after)) && orient_sign(v, node, w) == 0;
  const bool to_before = below_before && !tie_before;
  return asked_for_before ? to_before : !to_before && below_after && !tie_after;
}

/// One segment of a path against the stencil of one particle.
class SegmentTest {
 public:
  SegmentTest(const CrackPath& crack, std::size_t segment, const Vec<2>& particle)
      : crack_(crack),
        segment_(segment),
        particle_(particle),
        a_(crack.vertices[segment]),
        b_(crack.vertices[segment + 1]),
        tips_(crack.tip_rule(segment)),
        above_(particle_above(a_, b_, particle)) {
    const std::size_t count = crack.segment_count();
    if (particle == b_ && !has_end(tips_)) {
      corner_ = Corner::end;
      neighbour_ = segment + 1 == count ? 0 : segment + 1;
    } else if (particle == a_ && !has_start(tips_)) {
      corner_ = Corner::start;
      neighbour_ = segment == 0 ? count - 1 : segment - 1;
    }
  }

  bool crossed_to(const Vec<2>& node) const {
    if (corner_ == Corner::end) return corner_crossed(crack_, segment_, neighbour_, node, true);
    if (corner_ == Corner::start) return corner_crossed(crack_, neighbour_, segment_, node, false);
    if (boxes_apart(particle_, node, a_, b_)) return false;
    return node_above(a_, b_, node) != above_ && passes_between(particle_, node, a_, b_, tips_);
  }
  /// A line through a vertex crosses both segments that meet there, whichever counts.
  void add_to(Crossing& crossing, const Vec<2>& node) const {
    ++(above_ ? crossing.above : crossing.below);
    std::size_t other = segment_;
    const std::size_t count = crack_.segment_count();
    if (!has_start(tips_) && orient_sign(particle_, node, a_) == 0) other = segment_ == 0 ? count - 1 : segment_ - 1;
    if (!has_end(tips_) && orient_sign(particle_, node, b_) == 0) other = segment_ + 1 == count ? 0 : segment_ + 1;
    if (!crack_.normals.empty()) crossing.normal_sum += (crack_.normals[segment_] + crack_.normals[other]) * 0.5;
    if (!crack_.original_normals.empty())
      crossing.original_sum += (crack_.original_normals[segment_] + crack_.original_normals[other]) * 0.5;
  }

 private:
  enum class Corner : std::uint8_t { none, start, end };
  const CrackPath& crack_;
  std::size_t segment_, neighbour_ = 0;
  const Vec<2>&particle_, &a_, &b_;
  TipRule tips_;
  bool above_;
  Corner corner_ = Corner::none;
};

void add_segment(const CrackPath& crack, std::size_t s, const Vec<2>& particle, const Vec<2>& node, Crossing& crossing) {
  if (boxes_apart(particle, node, crack.vertices[s], crack.vertices[s + 1])) return;
  const SegmentTest test(crack, s, particle);
  if (test.crossed_to(node)) test.add_to(crossing, node);
}

}  // namespace

bool segment_crossed(const Vec<2>& particle, const Vec<2>& node, const Vec<2>& a, const Vec<2>& b, TipRule tips) {
  if (boxes_apart(particle, node, a, b)) return false;
  return node_above(a, b, node) != particle_above(a, b, particle) && passes_between(particle, node, a, b, tips);
}

Crossing cross_path(const CrackPath& crack, std::span<const FacetRef> facets, const Vec<2>& particle, const Vec<2>& node) {
  Crossing crossing;
  for (const FacetRef& facet : facets) add_segment(crack, facet.segment, particle, node, crossing);
  return crossing;
}

Crossing cross_path(const CrackPath& crack, const Vec<2>& particle, const Vec<2>& node) {
  Crossing crossing;
  for (std::size_t s = 0; s < crack.segment_count(); ++s) add_segment(crack, s, particle, node, crossing);
  return crossing;
}

void cross_stencil(const CrackPath& crack, std::span<const FacetRef> facets, const Vec<2>& particle, std::span<const Vec<2>> nodes,
                   std::span<Crossing> crossings) {
  std::fill(crossings.begin(), crossings.end(), Crossing{});
  if (nodes.empty()) return;
  Vec<2> low = particle, high = particle;
  for (const Vec<2>& n : nodes) {
    for (int k = 0; k < 2; ++k) {
      low[k] = n[k] < low[k] ? n[k] : low[k];
      high[k] = n[k] > high[k] ? n[k] : high[k];
    }
  }
  for (const FacetRef& facet : facets) {
    const std::size_t s = facet.segment;
    if (boxes_apart(low, high, crack.vertices[s], crack.vertices[s + 1])) continue;
    const SegmentTest test(crack, s, particle);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (test.crossed_to(nodes[i])) test.add_to(crossings[i], nodes[i]);
    }
  }
}

}  // namespace crampon
