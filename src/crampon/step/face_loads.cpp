#include "crampon/step/face_loads.hpp"

#include "crampon/step/face_links.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

template <int Dim>
void start_face_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  FaceStates<Dim>& s = work.faces;
  std::array<double, Dim * Dim> identity{};
  for (std::size_t k = 0; k < Dim; ++k) identity[k * Dim + k] = 1;
  s.deformation.assign(model.faces.particles.size(), identity);
  s.present.assign(model.faces.particles.size(), true);
  s.sum.assign(model.faces.links.size(), 0);
  s.traction.assign(model.faces.columns.size(), {});
  s.rest.assign(model.faces.columns.size(), 0);
  std::vector<Vec<Dim>>& areas = state.ledger.face_areas;
  areas.assign(model.faces.columns.size(), {});
  for (std::size_t c = 0; c < model.faces.columns.size(); ++c) areas[c][model.faces.columns[c].axis] = model.faces.columns[c].direction;
}

template <int Dim, class Shape>
void for_face_forces(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                     const FaceForceVisitor<Dim, Shape>& visit) {
  const auto first_node = work.blocks.list[b].first_node();
  for_slots<Dim, Shape>(state, work, model, b, work.scratch[b].faces,
                        [&](const FaceParticle& of, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, const Run& run) {
                          const Vec<Dim> x_p = state.particles.position(of.slot);
                          for_links(model.faces, of.number, [&](std::uint32_t, const FaceLink& link, const FaceColumn& column) {
                            NodalVector<Dim> t = splat_as<NodalVector<Dim>>(0.);
                            for (int k = 0; k < Dim; ++k) t[k] = work.faces.traction[link.column][k];
                            if (link.mirrored) t[column.axis] = -t[column.axis];
                            const double rest = work.faces.rest[link.column];
                            const LinkWeights<Dim, Shape> weights(model.grid, reaching_half_size<Dim, Shape>(model.materials[run.material]),
                                                                  link, column, work.faces.deformation[of.number], x_p);
                            for_nodes<Dim, Shape>(weights, model.grid, first_node, stencil, l, [&](double w, double S, int n) {
                              visit(of.slot, stencil, l, targets, n, splat_as<NodalVector<Dim>>(w + S * rest) * t);
                            });
                          });
                        });
}

template <int Dim, class Shape>
void project_face_loads(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                        NodalVector<Dim>* tiles) {
  for_face_forces<Dim, Shape>(
      state, work, model, b,
      [&](std::uint32_t, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, int n, const NodalVector<Dim>& f) {
        at_target<Dim, Shape>(stencil, targets, l, n, tiles, [&](NodalVector<Dim>& q, unsigned flip) { q += flipped(f, flip); });
      });
}

template <int Dim>
std::vector<Vec<Dim>> total_loads(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, double t) {
  std::vector<Vec<Dim>> total(model.loads.size()), value(model.loads.size());
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    for (int k = 0; k < Dim; ++k) value[l][k] = model.loads[l].value[static_cast<std::size_t>(k)](t, {});
    if (state.ledger.removed == 0) {
      for (const double share : model.loads[l].share) total[l] += value[l] * share;
    }
  }
  if (state.ledger.removed > 0) {
    for (const auto& scratch : work.scratch) {
      for (const LoadedParticle& p : scratch.loaded) total[p.load] += value[p.load] * model.loads[p.load].share[p.entry];
    }
  }
  for (std::size_t c = 0; c < model.faces.columns.size(); ++c) {
    const FaceColumn& column = model.faces.columns[c];
    if (!work.faces.present[column.surface]) continue;
    total[column.load] += traction_on(model.loads[column.load], column, state.ledger.face_areas[c], value[column.load]) * column.area;
  }
  return total;
}

#define CRAMPON_INSTANTIATE(DIM)                                                       \
  template void start_face_loads<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&); \
  template std::vector<Vec<DIM>> total_loads<DIM>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, double);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                              \
  template void for_face_forces<DIM, SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, std::size_t, \
                                            const FaceForceVisitor<DIM, SHAPE>&);                                    \
  template void project_face_loads<DIM, SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, std::size_t, NodalVector<DIM>*);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
