#include "crampon/step/face_loads.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/material/deformation.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/particle_view.hpp"
#include "crampon/step/stress_pass.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// cof F = det F inverse(F)^T: takes area vectors along.
template <int Dim>
std::array<double, Dim * Dim> cofactor(const std::array<double, Dim * Dim>& F) {
  if constexpr (Dim == 2) {
    return {F[3], -F[2], -F[1], F[0]};
  } else {
    std::array<double, 9> C;
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t d1 = (d + 1) % 3, d2 = (d + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        C[d * 3 + k] = F[d1 * 3 + k1] * F[d2 * 3 + k2] - F[d1 * 3 + k2] * F[d2 * 3 + k1];
      }
    }
    return C;
  }
}

template <int Dim>
Vec<Dim> column_of(const std::array<double, Dim * Dim>& F, std::size_t k) {
  Vec<Dim> out;
  for (std::size_t d = 0; d < Dim; ++d) out[d] = F[d * Dim + k];
  return out;
}

/// A link seen on the grid: how much of its stress reaches a node, and the force on it, per unit of traction.
template <int Dim, class Shape>
class LinkWeights {
 public:
  /// half_size: the same for all particles of a column, so that nodes see whole columns.
  LinkWeights(const Grid<Dim>& grid, const HalfSize<Dim>& half_size, const FaceLink& link, const FaceColumn& column,
              const std::array<double, Dim * Dim>& F, const Vec<Dim>& x_p)
      : link_(link) {
    const double outward = link.mirrored ? -column.direction : column.direction;
    flux_ = column_of<Dim>(F, column.axis) * (outward * link.flux);
    if (!link.ends) return;
    normal_ = column_of<Dim>(cofactor<Dim>(F), column.axis) * outward;
    const double area = norm(normal_);  // of the deformed face over that of the undeformed one; det F = area * thickness
    normal_ *= 1 / area;
    const double thickness = dot(normal_, column_of<Dim>(F, column.axis)) * outward;
    below_ = link.depth * thickness + dot(normal_, x_p);
    for (int k = 0; k < Dim; ++k) {
      const double across = std::fabs(normal_[k]) * grid.cell[k];
      reach_ += Shape::reach(half_size[k]) * across;
      ramp_ += across;
    }
  }
  /// Force on a node at x per unit of traction, but for the rest.
  double operator()(const Vec<Dim>& x, double S, const Vec<Dim>& G) const {
    const double whole = dot(flux_, G) + S * link_.source;
    if (!link_.ends) return whole;
    const double depth = below_ - dot(normal_, x);
    return whole * std::clamp((reach_ + ramp_ - depth) / ramp_, 0., 1.);
  }

 private:
  const FaceLink& link_;
  Vec<Dim> flux_, normal_;
  double below_ = 0, reach_ = 0, ramp_ = 0;
};

/// As far as domains may reach.
template <int Dim, class Shape>
HalfSize<Dim> reaching_half_size(const Material<Dim>& material) {
  HalfSize<Dim> half = material.half_size;
  if (Shape::has_domains) half.fill(largest_half_extent);
  return half;
}

/// f(weight, S, n) for all nodes n of a particle's stencil.
template <int Dim, class Shape, class F>
void for_nodes(const LinkWeights<Dim, Shape>& weights, const Grid<Dim>& grid, const IndexVector<Dim>& first_node,
               const Stencil<Dim, Shape>& stencil, int l, F f) {
  using T = Tile<Dim, Shape>;
  const auto lowest = unflatten<Dim>(stencil.of.lowest(l), T::side);
  for (int n = 0; n < T::stencil; ++n) {
    const auto step = unflatten<Dim>(n, Shape::width);
    Vec<Dim> x, G;
    for (int k = 0; k < Dim; ++k) {
      x[k] = grid.node_coordinate(k, lowest[k] + step[k] + first_node[k] - T::offset);
      G[k] = stencil.slope(n, k, l);
    }
    const double S = stencil.weight(n, l);
    f(weights(x, S, G), S, n);
  }
}

/// f(link number, link, column) for what a particle has a part in.
template <int Dim, class F>
void for_links(const LoadedFaces<Dim>& faces, std::uint32_t particle, F f) {
  for (std::uint32_t i = faces.first_of[particle]; i < faces.first_of[particle + 1]; ++i) {
    const FaceLink& link = faces.links[faces.by_particle[i]];
    f(faces.by_particle[i], link, faces.columns[link.column]);
  }
}

}  // namespace

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
    if (stress_dt_ > 0) velocity_ = gathered<Dim, Shape>(work, b, work.nodes.velocity);
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

namespace {

template <int Dim>
Vec<Dim> traction_on(const Load<Dim>& load, const FaceColumn& column, const Vec<Dim>& area_vector, const Vec<Dim>& value) {
  return load.kind == Load<Dim>::Kind::pressure ? area_vector * -value[0] : value * column.share;
}

}  // namespace

template <int Dim>
void find_face_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const std::vector<Vec<Dim>>& load_values = work.prescribed.loads;
  FaceStates<Dim>& s = work.faces;
  for (std::size_t c = 0; c < model.faces.columns.size(); ++c) {
    const FaceColumn& column = model.faces.columns[c];
    double sum = 0;
    int links = 0;
    for (std::uint32_t i = column.first_link; i < column.end_link; ++i) {
      if (!s.present[model.faces.links[i].particle]) continue;
      sum += s.sum[i];
      ++links;
    }
    const bool there = s.present[column.surface];  // what has left the grid takes its face along
    s.rest[c] = there ? (column.area - sum) / links : 0.;
    s.traction[c] =
        there ? traction_on(model.loads[column.load], column, state.ledger.face_areas[c], load_values[column.load]) : Vec<Dim>{};
  }
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
  using T = Tile<Dim, Shape>;
  for_face_forces<Dim, Shape>(
      state, work, model, b,
      [&](std::uint32_t, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, int n, const NodalVector<Dim>& f) {
        const PairTarget* pair = targets ? &targets[l * T::stencil + n] : nullptr;
        tiles[pair ? pair->layer * T::nodes + pair->node : stencil.of.base[l] + T::steps[n]] += flipped(f, pair ? pair->flip : 0u);
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

#define CRAMPON_INSTANTIATE(DIM)                                                          \
  template void start_face_loads<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);    \
  template void find_face_tractions<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&); \
  template std::vector<Vec<DIM>> total_loads<DIM>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, double);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                              \
  template void weigh_face_loads<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);           \
  template void for_face_forces<DIM, SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, std::size_t, \
                                            const FaceForceVisitor<DIM, SHAPE>&);                                    \
  template void project_face_loads<DIM, SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, std::size_t, NodalVector<DIM>*);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
