#include "crampon/step/verbs.hpp"

#include "crampon/material/deformation.hpp"
#include "crampon/step/face_links.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/particle_view.hpp"
#include "crampon/step/stress_pass.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// Deformation gradients of the particles of a pack at the time of their positions.
template <int Dim, class Shape>
class DeformationNow {
 public:
  DeformationNow(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b)
      : state_(state),
        work_(work),
        model_(model),
        block_(b),
        stress_dt_(Shape::has_domains || !updates_stress_first(model) ? 0. : work.now.stress_dt) {
    if (stress_dt_ > 0) velocity_ = gathered<Dim, Shape, &Nodes<Dim>::velocity>(work, b);
  }
  /// F[d * Dim + k]
  void find(std::size_t pack, std::size_t of_material, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, Pack* F) const {
    const Material<Dim>& material = model_.materials[of_material];
    if constexpr (Shape::has_domains) {
      const Particles<Dim>& particles = state_.particles;
      for (int c = 0; c < Dim * Dim; ++c) {
        const double at_start = material.half_size[static_cast<std::size_t>(c % Dim)] * model_.grid.cell[c % Dim];
        F[c] = particles.domain[pack * domain_size<Dim> + static_cast<std::size_t>(c)] * splat(1 / at_start);
      }
      return;
    }
    PackView<Dim>(state_, model_, of_material, pack).deformation(F);
    if (stress_dt_ == 0) return;
    Pack L[Dim * Dim];
    gradient<Dim, Shape>(stencil, targets, work_.nodes.layers[block_].offsets.start.data(), velocity_, L);
    if (material.law->follows_deformation()) {
      take_to_middle<Dim>(L, way_to_middle(model_, stress_dt_));
      advance_deformation<Dim>(L, stress_dt_, F);
    } else {
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) F[i * Dim + j] += (L[i * Dim + j] + L[j * Dim + i]) * splat(0.5 * stress_dt_);
      }
    }
  }

 private:
  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::size_t block_;
  double stress_dt_;
  const NodalVector<Dim>* velocity_ = nullptr;
};

}  // namespace

template <int Dim, class Shape>
void weigh_face_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  if (work.scratch[b].faces.empty()) return;
  const auto first_node = work.blocks.list[b].first_node();
  const Particles<Dim>& particles = state.particles;
  const DeformationNow<Dim, Shape> deformation(state, work, model, b);
  std::size_t known = particles.packs;  // the pack whose deformation is at hand
  Pack F_pack[Dim * Dim], stretch = splat(1.);
  for_slots<Dim, Shape>(
      state, work, model, b, work.scratch[b].faces,
      [&](const FaceParticle& of, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, const Run& run) {
        const std::size_t pack = of.slot / lanes;
        const Material<Dim>& material = model.materials[run.material];
        if (pack != known) {
          known = pack;
          deformation.find(pack, run.material, stencil, targets, F_pack);
          if (model.stress_state == StressState::plane_stress) {
            const PackReport report = PackView<Dim>(state, model, run.material, pack).report();
            stretch = report.volume_ratio / report.area_ratio;  // of the thickness
          }
        }
        auto& F = work.faces.deformation[of.number];
        for (std::size_t c = 0; c < Dim * Dim; ++c) F[c] = F_pack[c][l];
        const Vec<Dim> x_p = particles.position(of.slot);
        for_links(model.faces, of.number, [&](std::uint32_t number, const FaceLink& link, const FaceColumn& column) {
          if (column.surface == of.number && !link.mirrored) {
            state.ledger.face_areas[link.column] = column_of<Dim>(cofactor<Dim>(F), column.axis) * (column.direction * stretch[l]);
          }
          double sum = 0;
          const LinkWeights<Dim, Shape> weights(model.grid, reaching_half_size<Dim, Shape>(material), link, column, F, x_p);
          for_nodes<Dim, Shape>(weights, model.grid, first_node, stencil, l, [&](double w, double, int) { sum += w; });
          work.faces.sum[number] = sum;
        });
      });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void weigh_face_loads<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
