#include "crampon/crack/crossing.hpp"

#include <algorithm>

#include "crampon/crack/segment_test.hpp"
#include "crampon/crack/triangle_test.hpp"

namespace crampon {

namespace {

/// Counts a facet that the line to the node crosses.
template <int Dim>
[[gnu::always_inline]] inline void count(const CrackMesh<Dim>& crack, FacetId facet, const FacetTest<Dim>& test, const Vec<Dim>& node,
                                         Crossing<Dim>& crossing) {
  ++(test.above() ? crossing.above : crossing.below);
  const FacetId other = test.other(node);
  if (!crack.normals.empty()) crossing.normal_sum += (crack.normals[facet] + crack.normals[other]) * 0.5;
  if (!crack.original_normals.empty()) crossing.original_sum += (crack.original_normals[facet] + crack.original_normals[other]) * 0.5;
}

template <int Dim>
void add_facet(const CrackMesh<Dim>& crack, FacetId facet, const Vec<Dim>& particle, const Vec<Dim>& node, Crossing<Dim>& crossing) {
  if (FacetBox<Dim>(crack, facet).apart(particle, node)) return;
  const FacetTest<Dim> test(crack, facet, particle);
  if (test.crossed_to(node)) count(crack, facet, test, node, crossing);
}

}  // namespace

template <int Dim>
Crossing<Dim> cross_crack(const CrackMesh<Dim>& crack, std::span<const FacetRef> facets, const Vec<Dim>& particle, const Vec<Dim>& node) {
  Crossing<Dim> crossing;
  for (const FacetRef& at : facets) add_facet(crack, at.facet, particle, node, crossing);
  return crossing;
}

template <int Dim>
Crossing<Dim> cross_crack(const CrackMesh<Dim>& crack, const Vec<Dim>& particle, const Vec<Dim>& node) {
  Crossing<Dim> crossing;
  for (FacetId facet = 0; facet < crack.facets.size(); ++facet) add_facet(crack, facet, particle, node, crossing);
  return crossing;
}

template <int Dim>
void cross_stencil(const CrackMesh<Dim>& crack, std::span<const FacetRef> facets, const Vec<Dim>& particle, std::span<const Vec<Dim>> nodes,
                   std::span<Crossing<Dim>> crossings) {
  std::fill(crossings.begin(), crossings.end(), Crossing<Dim>{});
  if (nodes.empty()) return;
  Vec<Dim> low = particle, high = particle;
  for (const Vec<Dim>& n : nodes) {
    for (int k = 0; k < Dim; ++k) {
      low[k] = n[k] < low[k] ? n[k] : low[k];
      high[k] = n[k] > high[k] ? n[k] : high[k];
    }
  }
  for (const FacetRef& at : facets) {
    const FacetBox<Dim> box(crack, at.facet);
    if (box.apart_from_box(low, high)) continue;
    const FacetTest<Dim> test(crack, at.facet, particle);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!box.apart(particle, nodes[i]) && test.crossed_to(nodes[i])) count(crack, at.facet, test, nodes[i], crossings[i]);
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                                 \
  template Crossing<DIM> cross_crack<DIM>(const CrackMesh<DIM>&, std::span<const FacetRef>, const Vec<DIM>&, const Vec<DIM>&);   \
  template Crossing<DIM> cross_crack<DIM>(const CrackMesh<DIM>&, const Vec<DIM>&, const Vec<DIM>&);                              \
  template void cross_stencil<DIM>(const CrackMesh<DIM>&, std::span<const FacetRef>, const Vec<DIM>&, std::span<const Vec<DIM>>, \
                                   std::span<Crossing<DIM>>);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
