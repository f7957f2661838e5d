#include "crampon/step/crack_motion.hpp"

#include <algorithm>

#include "crampon/step/point_fields.hpp"

namespace crampon {

namespace {

/// Vertices without a displacement take that of the nearest vertex along the facets that has one; of several as near, that of which the way starts
/// at the neighbour with the lowest number. Where none has, they stay.
template <int Dim>
void fill_gaps(const std::vector<Facet<Dim>>& facets, std::vector<std::optional<Vec<Dim>>>& moved) {
  const std::size_t count = moved.size();
  std::vector<VertexId> front, next;  // the vertices that the last and the present round have reached: one facet further each time
  for (std::size_t v = 0; v < count; ++v) {
    if (moved[v]) front.push_back(static_cast<VertexId>(v));
  }
  if (front.size() == count) return;
  std::vector<std::vector<VertexId>> beside(count);
  for (const Facet<Dim>& facet : facets) {
    for (const VertexId v : facet) {
      for (const VertexId u : facet) {
        if (u != v) beside[v].push_back(u);
      }
    }
  }
  std::vector<std::size_t> from(count, count);
  for (; !front.empty(); front.swap(next), next.clear()) {
    for (const VertexId u : front) {
      for (const VertexId v : beside[u]) {
        if (moved[v]) continue;
        if (from[v] == count) next.push_back(v);
        from[v] = std::min(from[v], std::size_t{u});
      }
    }
    for (const VertexId v : next) moved[v] = moved[from[v]];
  }
  for (auto& displacement : moved) {
    if (!displacement) displacement = Vec<Dim>{};
  }
}

/// How far surface points are from where their carriers are.
template <int Dim>
std::vector<std::optional<Vec<Dim>>> surface_motion(const State<Dim>& state, const StepWork<Dim>& work,
                                                    const std::vector<Vec<Dim>>& surface, const std::vector<Vec<Dim>>& original,
                                                    const Carriers& carriers, PositionTime time) {
  std::vector<std::optional<Vec<Dim>>> moved(surface.size());
  for (std::size_t v = 0; v < carriers.size(); ++v) {
    if (!carriers[v].empty()) moved[v] = original[v] + carried_displacement(state, work, carriers[v], time) - surface[v];
  }
  return moved;
}

}  // namespace

template <int Dim>
CrackMotion<Dim> carried_motion(const State<Dim>& state, const StepWork<Dim>& work, const Crack<Dim>& crack, PositionTime time) {
  CrackMotion<Dim> m{surface_motion(state, work, crack.upper, crack.original, crack.upper_carriers, time),
                     surface_motion(state, work, crack.lower, crack.original, crack.lower_carriers, time),
                     {}};
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    if (m.upper[v] && m.lower[v]) {
      m.plane.emplace_back((*m.upper[v] + *m.lower[v]) * 0.5);
    } else {
      m.plane.push_back(m.upper[v] ? m.upper[v] : m.lower[v]);
    }
  }
  return m;
}

template <int Dim>
void move_points(CrackMotion<Dim> motion, Crack<Dim>& crack) {
  fill_gaps<Dim>(crack.facets, motion.plane);
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    crack.upper[v] += motion.upper[v] ? *motion.upper[v] : *motion.plane[v];
    crack.lower[v] += motion.lower[v] ? *motion.lower[v] : *motion.plane[v];
    if (!crack.fixed) crack.plane[v] += *motion.plane[v];
  }
}

template <int Dim>
void close_ends(Crack<Dim>& crack) {
  if (!crack.closed) return;
  for (auto* x : {&crack.plane, &crack.upper, &crack.lower}) x->back() = x->front();
}

template <int Dim>
std::vector<CrackOpening> openings_of(const Crack<Dim>& crack) {
  const std::vector<Vec<Dim>> normals = vertex_normals(crack);
  std::vector<CrackOpening> openings;
  openings.reserve(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) openings.push_back(OpeningFrame<Dim>(crack, v, normals[v]).opening);
  return openings;
}

template <int Dim>
void carry_cracks(State<Dim>& state, StepWork<Dim>& work) {
  for (Crack<Dim>& crack : state.cracks.list) {
    move_points(carried_motion(state, work, crack, PositionTime::leading), crack);
    close_ends(crack);
  }
}

template <int Dim>
Crack<Dim> present_crack(const State<Dim>& state, const StepWork<Dim>& work, Crack<Dim> crack) {
  if (state.particles.lead == 0) return crack;
  move_points(carried_motion(state, work, crack, PositionTime::present), crack);
  close_ends(crack);
  return crack;
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                           \
  template std::vector<CrackOpening> openings_of<DIM>(const Crack<DIM>&);                                                  \
  template CrackMotion<DIM> carried_motion<DIM>(const State<DIM>&, const StepWork<DIM>&, const Crack<DIM>&, PositionTime); \
  template void move_points<DIM>(CrackMotion<DIM>, Crack<DIM>&);                                                           \
  template void close_ends<DIM>(Crack<DIM>&);                                                                              \
  template void carry_cracks<DIM>(State<DIM>&, StepWork<DIM>&);                                                            \
  template Crack<DIM> present_crack<DIM>(const State<DIM>&, const StepWork<DIM>&, Crack<DIM>);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
