#pragma once
/// Cracks: vertices without mass, joined by facets (N03 section 2; docs/theory/space.md, cracks in memory).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "crampon/core/members.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/geometry/facet.hpp"
#include "crampon/state/layers.hpp"
#include "crampon/state/traction_history.hpp"

namespace crampon {

/// A particle that carries a point of a crack's surface along (step/crack_carriers.hpp).
struct Carrier {
  std::uint32_t particle = 0;  ///< id
  std::uint8_t flip = 0;       ///< bit k: it is the particle's image in a mirror, and component k of its displacement is reversed
  double weight = 0;           ///< of its displacement in that of the point

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [particle, flip, weight] = self;
    visit(Member{"particle"}, particle);
    visit(Member{"flip"}, flip);
    visit(Member{"weight"}, weight);
  }
};
/// Per vertex. The weights of a point add up to 1; a point without carriers goes with the plane.
using Carriers = std::vector<std::vector<Carrier>>;

/// Tractions on one crack, per vertex; empty without a law.
template <int Dim>
struct CrackTractionState {
  std::vector<double> area;  ///< m2: of the vertex's share of the crack with material on both sides; 0: the law does not act
  std::vector<TractionHistory> history;
  std::vector<Vec<Dim>> force;  ///< on the upper surface in the next step, N
  std::vector<double> stored;   ///< J/m2
  std::vector<bool> between;    ///< there was material on both sides in the last step

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [area, history, force, stored, between] = self;
    visit(Member{"area", "m2"}, area);
    visit(Member{"history"}, history);
    visit(Member{"force", "N"}, force);
    visit(Member{"stored", "J/m2"}, stored);
    visit(Member{"between"}, between);
  }
};

/// What held the faces together at a vertex before a tip grew past it; it fades to nothing (docs/theory/fracture.md, release).
template <int Dim>
struct FadingTraction {
  std::uint32_t vertex = 0;
  Vec<Dim> at_first;            ///< on the upper surface when the tip grew, N
  Vec<Dim> force;               ///< ... in the next step, N
  Vec<Dim> opening;             ///< upper less lower surface, where its work has been counted to, m
  double since = 0, until = 0;  ///< s

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [vertex, at_first, force, opening, since, until] = self;
    visit(Member{"vertex"}, vertex);
    visit(Member{"at_first", "N"}, at_first);
    visit(Member{"force", "N"}, force);
    visit(Member{"opening", "m"}, opening);
    visit(Member{"since", "s"}, since);
    visit(Member{"until", "s"}, until);
  }
};

/// One crack. In 2D the vertices of facet k are k and k + 1 of a directed polyline; "above" is left of it (conventions, words and signs). In 3D
/// facets are triangles that share vertices, all turned the same way.
template <int Dim>
struct Crack {
  std::string name;
  bool fixed = false;              ///< the plane stays where it is
  bool closed = false;             ///< 2D: the last vertex equals the first: no tips
  std::vector<Vec<Dim>> plane;     ///< present vertices, m; none: the crack has not started
  std::vector<Vec<Dim>> upper;     ///< points of the upper surface, m
  std::vector<Vec<Dim>> lower;     ///< points of the lower surface, m
  std::vector<Vec<Dim>> original;  ///< vertices at the start, m
  std::vector<Facet<Dim>> facets;
  Carriers upper_carriers, lower_carriers;  ///< of the surface points
  /// 2D, how far the path goes on beyond its start and its end for those who ask what it cuts, m; 0: the end is a tip (run/crack_ends.hpp).
  std::array<double, 2> extension{};
  /// 2D, bit k of the start and of the end: it lies on a mirror across axis k, behind which the crack goes on as its image.
  std::array<std::uint8_t, 2> mirrored{};
  CrackTractionState<Dim> traction;
  std::vector<FadingTraction<Dim>> fading;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [name, fixed, closed, plane, upper, lower, original, facets, upper_carriers, lower_carriers, extension, mirrored, traction,
           fading] = self;
    visit(Member{"name"}, name);
    visit(Member{"fixed"}, fixed);
    visit(Member{"closed"}, closed);
    visit(Member{"plane", "m"}, plane);
    visit(Member{"upper", "m"}, upper);
    visit(Member{"lower", "m"}, lower);
    visit(Member{"original", "m"}, original);
    visit(Member{"facets"}, facets);
    visit(Member{"upper_carriers"}, upper_carriers);
    visit(Member{"lower_carriers"}, lower_carriers);
    visit(Member{"extension", "m"}, extension);
    visit(Member{"mirrored"}, mirrored);
    visit(Member{"traction"}, traction);
    visit(Member{"fading"}, fading);
  }
};

template <int Dim>
struct Cracks {
  std::vector<Crack<Dim>> list;
  bool empty() const { return list.empty(); }
  std::size_t size() const { return list.size(); }

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [list] = self;
    visit(Member{"list"}, list);
  }
};

}  // namespace crampon
