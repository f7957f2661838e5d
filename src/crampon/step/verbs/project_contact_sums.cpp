#include "crampon/step/verbs.hpp"

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/particle_view.hpp"
#include "crampon/step/tile_buffer.hpp"

namespace crampon {

namespace {

/// What one particle adds to the contact sums of a node, before S_ip; the volume's gradient apart.
template <int Dim>
void add_contact_share(const Model<Dim>& model, const IndexVector<Dim>& node, double S, const Vec<Dim>& G, double m_p, double V_p,
                       double c_p, const Vec<Dim>& x_p, const Vec<Dim>& X_p, unsigned mirrored_axes, ContactSums<Dim>& q) {
  Pack now = splat(0.), start = splat(0.);
  now[0] = V_p;
  Vec<Dim> g = G * V_p;
  for (int k = 0; k < Dim; ++k) {
    const double x_i = model.grid.node_coordinate(k, node[k]);
    const bool mirrored = mirrored_axes >> k & 1u;
    const double sign = mirrored ? -m_p : m_p;
    now[1 + k] = sign * (x_p[k] - x_i);
    start[1 + k] = sign * (X_p[k] - x_i);
    if (mirrored) g[k] = -g[k];
  }
  start[Dim == 2 ? 3 : 0] = m_p * c_p;
  q.r[0] = fused(splat(S), now, q.r[0]);
  q.r[1] = fused(splat(S), start, q.r[1]);
  if constexpr (Dim == 2) {
    q.r[0][3] += g[0];
    q.r[1][0] += g[1];
  } else {
    for (int k = 0; k < 3; ++k) q.r[2][k] += g[k];
  }
}

/// The nodes about a block that hold several fields or are near a wall, as its tile sees them.
template <int Dim, class Shape>
class SharedNodes {
  using T = Tile<Dim, Shape>;

 public:
  SharedNodes(const StepWork<Dim>& work, std::size_t b) {
    for (int o = 0; o < neighbour_count<Dim>; ++o) {
      const std::uint32_t c = work.blocks.list[b].neighbours[o];
      if (c == no_block || work.nodes.layers[c].shared.empty()) continue;
      IndexVector<Dim> step = neighbour_step<Dim>(o);
      for (int k = 0; k < Dim; ++k) step[k] = -step[k];
      Overlap<Dim, Shape>(step, whole_tile<Dim, Shape>()).rows([&](int local, int t, int count) {
        for (int i = 0; i < count; ++i) {
          if (work.nodes.layers[c].shared[static_cast<std::size_t>(local + i)] != 0) mark(t + i);
        }
      });
    }
  }

  bool any() const { return any_; }
  bool at(int tile_node) const { return shared_[tile_node]; }
  /// Does a particle of the pack have a pair with such a node?
  bool reached(const Stencil<Dim, Shape>& stencil, const PairTarget* targets) const {
    for (int l = 0; l < lanes; ++l) {
      if (!targets && reaching_[stencil.of.lowest(l)]) return true;
      for (int n = 0; targets && n < T::stencil; ++n) {
        if (shared_[targets[l * T::stencil + n].node]) return true;
      }
    }
    return false;
  }

 private:
  void mark(int node) {
    any_ = shared_[node] = true;
    for (const int step : T::steps) {
      if (node >= step) reaching_[node - step] = true;
    }
  }

  bool any_ = false;
  bool shared_[T::nodes] = {};
  bool reaching_[T::nodes] = {};  ///< as the lowest node of a stencil
};

}  // namespace

template <int Dim, class Shape>
void project_contact_sums(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  using T = Tile<Dim, Shape>;
  BlockLayers<Dim>& layers = work.nodes.layers[b];
  layers.contact_packs.clear();
  if (!work.blocks.list[b].has_particles() || !layers.sums_contact) return;
  const SharedNodes<Dim, Shape> shared(work, b);
  layers.sums_contact = shared.any();
  if (!shared.any()) return;
  ContactSums<Dim>* tiles = cleared_tiles<Dim, Shape>(work, b, work.nodes.contact);
  const Particles<Dim>& particles = state.particles;
  const auto first_node = work.blocks.list[b].first_node();
  const bool volumes = model.contact.detection == ContactDetection::volume || model.contact.several_fields() || model.contact.needs_areas();
  const bool histories = particles.contact.size() > 0;
  for_packs<Dim, Shape>(
      state, work, model, b, [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
        if (!shared.reached(stencil, targets)) return;
        layers.contact_packs.push_back(pack);
        const Material<Dim>& material = model.materials[run.material];
        Pack volume = splat(0.);
        if (volumes) {
          const Pack area_ratio = PackView<Dim>(state, model, run.material, pack).report().area_ratio;
          volume = particles.mass_volume[2 * std::size_t{pack} + 1] * area_ratio / material.thickness;
        }
        for (int l = 0; l < lanes; ++l) {
          const std::size_t p = std::size_t{pack} * lanes + l;
          const double m_p = particles.mass(p);
          if (m_p == 0) continue;
          const Vec<Dim> x_p = particles.position(p), X_p = particles.original[p];
          const auto lowest = unflatten<Dim>(stencil.of.lowest(l), T::side);
          for (int n = 0; n < T::stencil; ++n) {
            const PairTarget t = target_of<Dim, Shape>(stencil, targets, l, n);
            if (!shared.at(t.node)) continue;
            IndexVector<Dim> node = unflatten<Dim>(n, Shape::width);
            Vec<Dim> G;
            for (int k = 0; k < Dim; ++k) {
              node[k] += lowest[k] + first_node[k] - T::offset;
              G[k] = stencil.slope(n, k, l);
            }
            add_contact_share<Dim>(model, node, stencil.weight(n, l), G, m_p, volume[l], histories ? particles.contact[p] : 0., x_p, X_p,
                                   t.mirrored, tiles[t.layer * T::nodes + t.node]);
          }
        }
      });
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void project_contact_sums<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
