#include "crampon/step/contact_cloud.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

/// A particle that is seen by less is on the edge of the node's reach (particles aligned with the grid are, to round-off, and round-off would
/// decide): all particles of a cloud count alike in a regression.
constexpr double least_weight = 1e-10;

/// Is a particle known to lie deep in its body, or is it none at all?
template <int Dim>
bool is_deep(const State<Dim>& state, const Model<Dim>& model, std::size_t p) {
  return state.particles.is_padding(p) || model.surface[state.particles.id[p]] == Vec<Dim>{};
}

}  // namespace

template <int Dim>
template <class Shape>
void ContactCloud<Dim>::collect(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block,
                                const std::vector<bool>& wanted, Of of) {
  using T = Tile<Dim, Shape>;
  const Block<Dim>& own = work.blocks.list[block];
  const auto own_first = own.first_node();
  std::vector<std::uint32_t> at_surface;
  for (int o = 0; o < neighbour_count<Dim>; ++o) {
    const std::uint32_t c = own.neighbours[o];
    if (c == no_block || work.nodes.layers[c].contact_packs.empty()) continue;
    const BlockLayers<Dim>& layers = work.nodes.layers[c];
    std::vector<int> layer_here;
    for (const Layer& layer : layers.tile) layer_here.push_back(layer_of<Dim>(work.nodes.layers[block].node, layer));
    const auto first = work.blocks.list[c].first_node();
    if (of == Of::surface) {
      at_surface.clear();
      for (const std::uint32_t pack : layers.contact_packs) {
        bool any = false;
        for (std::size_t p = std::size_t{pack} * lanes; p < std::size_t{pack + 1} * lanes; ++p) any = any || !is_deep(state, model, p);
        if (any) at_surface.push_back(pack);
      }
    }
    for_packs<Dim, Shape>(state, work, model, c, of == Of::all ? layers.contact_packs : at_surface,
                          [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
                            const Material<Dim>& material = model.materials[run.material];
                            Pack F[Dim * Dim];
                            bool has_F = false;
                            for (int l = 0; l < lanes; ++l) {
                              const std::size_t p = std::size_t{pack} * lanes + l;
                              if (state.particles.is_padding(p)) continue;
                              if (of == Of::surface && is_deep(state, model, p)) continue;
                              for (int n = 0; n < T::stencil; ++n) {
                                if (stencil.weight(n, l) < least_weight) continue;
                                const PairTarget t = target_of<Dim, Shape>(stencil, targets, l, n);
                                IndexVector<Dim> node = unflatten<Dim>(t.node, T::side);
                                int local = 0;
                                bool inside = true;
                                for (int k = Dim - 1; k >= 0; --k) {
                                  node[k] += first[k] - T::offset;
                                  const int i = node[k] - own_first[k];
                                  inside = inside && i >= 0 && i < block_side;
                                  local = local * block_side + i;
                                }
                                if (!inside || !wanted[static_cast<std::size_t>(local)]) continue;
                                if (!has_F) {
                                  PackView<Dim>(state, model, run.material, pack).deformation(F);
                                  has_F = true;
                                }
                                CloudPoint<Dim> point;
                                point.layer = layer_here[t.layer];
                                point.particle = static_cast<std::uint32_t>(p);
                                point.mirrored = t.mirrored;
                                point.x = state.particles.position(p);
                                point.S = stencil.weight(n, l);
                                point.m = state.particles.mass(p) * point.S;
                                for (int k = 0; k < Dim; ++k) {
                                  point.half_size[k] = material.half_size[k] * model.grid.cell[k];
                                  for (int d = 0; d < Dim; ++d) point.F[k][d] = F[d * Dim + k][l];
                                }
                                if (!model.surface.empty()) {
                                  const std::uint32_t id = state.particles.id[p];
                                  const std::array<Vec<Dim>, Dim> of_start = since_start<Dim>(model, id, point.F);
                                  for (int k = 0; k < Dim; ++k) point.to_surface += of_start[k] * model.surface[id][k];
                                }
                                for (int k = 0; k < Dim; ++k) {
                                  const double x_i = model.grid.node_coordinate(k, node[k]);
                                  if (t.mirrored >> k & 1u) {
                                    // The mirror stands midway between the node and the one beyond it for which the pair was.
                                    const int beyond =
                                        unflatten<Dim>(stencil.of.lowest(l) + T::steps[n], T::side)[k] + first[k] - T::offset;
                                    point.x[k] = model.grid.node_coordinate(k, beyond) - point.x[k];
                                    point.mirror(k);
                                  } else {
                                    point.x[k] -= x_i;
                                  }
                                }
                                points_[static_cast<std::size_t>(local)].push_back(point);
                              }
                            }
                          });
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                    \
  template void ContactCloud<DIM>::collect<SHAPE>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&, std::size_t, \
                                                  const std::vector<bool>&, Of);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
