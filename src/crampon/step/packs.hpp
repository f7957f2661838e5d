#pragma once
/// The walk over the particles of a block, pack by pack, with S_ip and G_ip at hand. Every particle loop of the step is one of these.

#include "crampon/shape/separable.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Factors of S_ip and G_ip of a pack; half_size: of its particles at the start.
template <int Dim, class Shape>
[[gnu::always_inline]] inline void compute_factors(const Particles<Dim>& particles, const Grid<Dim>& grid,
                                                   const IndexVector<Dim>& first_node, const HalfSize<Dim>& half_size, std::size_t pack,
                                                   StencilFactors<Dim, Shape>& out) {
  Pack x[Dim];
  particles.pack_positions(pack, x);
  if constexpr (Shape::has_domains) {
    DomainEdges<Dim> edges;
    const Pack* half_edge = &particles.domain[pack * domain_size<Dim>];
    for (int k = 0; k < Dim; ++k) {
      for (int j = 0; j < Dim; ++j) edges.r[k][j] = half_edge[k * Dim + j] * splat(grid.inverse_cell[k]);
    }
    out.compute(x, grid, first_node, edges);
  } else {
    out.compute(x, grid, first_node, half_size);
  }
}

/// The stencils of a block's packs, run by run.
template <int Dim, class Shape>
class BlockStencils {
 public:
  BlockStencils(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b)
      : state_(state),
        work_(work),
        model_(model),
        block_(work.blocks.list[b]),
        layers_(work.nodes.layers[b]),
        first_node_(block_.first_node()),
        first_pack_(state.order.runs[block_.first_run].first_pack) {}

  const Run& enter_run(std::uint32_t r) {
    const Run& run = state_.order.runs[r];
    half_size_ = &model_.materials[run.material].half_size;
    layer_ = layers_.run_layer.empty() ? 0 : layers_.run_layer[r - block_.first_run];
    return run;
  }
  [[gnu::always_inline]] void compute(std::uint32_t pack, StencilFactors<Dim, Shape>& stencil) const {
    compute_factors<Dim, Shape>(state_.particles, model_.grid, first_node_, *half_size_, pack, stencil);
    if (layer_ > 0) stencil.move_to_layer(layer_);
  }
  /// Where the pairs of a pack of the run go, or null: all to their own node in the stencil's layer.
  [[gnu::always_inline]] const PairTarget* targets(std::uint32_t pack) const {
    const std::int32_t index = layers_.targets_of_pack.empty() ? -1 : layers_.targets_of_pack[pack - first_pack_];
    return index < 0 ? nullptr : &layers_.targets[static_cast<std::size_t>(index) * lanes * Stencil<Dim, Shape>::count];
  }

 private:
  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  const Block<Dim>& block_;
  const BlockLayers<Dim>& layers_;
  IndexVector<Dim> first_node_;
  std::uint32_t first_pack_;
  const HalfSize<Dim>* half_size_ = nullptr;
  int layer_ = 0;
};

/// f(run, first pack, end pack, factors) for a few packs of one run at a time. Factors of several packs come first: their chains of dependent
/// operations overlap.
template <int Batch, int Dim, class Shape, class F>
[[gnu::always_inline]] inline void for_batches(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                                               F&& f) {
  const Block<Dim>& block = work.blocks.list[b];
  BlockStencils<Dim, Shape> stencils(state, work, model, b);
  StencilFactors<Dim, Shape> factors[Batch];
  for (std::uint32_t r = block.first_run; r < block.end_run; ++r) {
    const Run& run = stencils.enter_run(r);
    for (std::uint32_t first = run.first_pack; first < run.end_pack; first += Batch) {
      const std::uint32_t end = std::min(first + Batch, run.end_pack);
      for (std::uint32_t k = first; k < end; ++k) stencils.compute(k, factors[k - first]);
      f(stencils, run, first, end, factors);
    }
  }
}

/// f(pack, stencil, targets, run): targets is null for packs whose pairs all go to their own node in the stencil's layer, else
/// [lane][stencil node] says where each pair goes.
template <int Dim, class Shape, class F>
void for_packs(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, F&& f) {
  for_batches<Dim == 2 ? 8 : 1, Dim, Shape>(
      state, work, model, b, [&](const auto& stencils, const Run& run, std::uint32_t first, std::uint32_t end, const auto* factors) {
        for (std::uint32_t k = first; k < end; ++k) f(k, Stencil<Dim, Shape>(factors[k - first]), stencils.targets(k), run);
      });
}

/// The same for some packs of the block, ascending.
template <int Dim, class Shape, class F>
void for_packs(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
               const std::vector<std::uint32_t>& packs, F&& f) {
  std::uint32_t r = work.blocks.list[b].first_run;
  BlockStencils<Dim, Shape> stencils(state, work, model, b);
  StencilFactors<Dim, Shape> factors;
  for (const std::uint32_t pack : packs) {
    while (pack >= state.order.runs[r].end_pack) ++r;
    const Run& run = stencils.enter_run(r);
    stencils.compute(pack, factors);
    f(pack, Stencil<Dim, Shape>(factors), stencils.targets(pack), run);
  }
}

/// f(item, stencil, lane, targets, run) for items of a block that name a particle by its slot, ascending.
template <int Dim, class Shape, class Item, class F>
void for_slots(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, const std::vector<Item>& items,
               F&& f) {
  if (items.empty()) return;
  std::uint32_t r = work.blocks.list[b].first_run;
  BlockStencils<Dim, Shape> stencils(state, work, model, b);
  StencilFactors<Dim, Shape> factors;
  for (std::size_t i = 0; i < items.size();) {
    const std::uint32_t pack = items[i].slot / lanes;
    while (pack >= state.order.runs[r].end_pack) ++r;
    const Run& run = stencils.enter_run(r);
    stencils.compute(pack, factors);
    const Stencil<Dim, Shape> stencil(factors);
    for (; i < items.size() && items[i].slot / lanes == pack; ++i) {
      f(items[i], stencil, static_cast<int>(items[i].slot % lanes), stencils.targets(pack), run);
    }
  }
}

/// Signs by which a folded pair exchanges vectors (conventions 29).
template <class V>
inline V flipped(V a, unsigned flip) {
  if (flip == 0) return a;
  V sign = splat_as<V>(1.);
  for (unsigned k = 0; k < sizeof(V) / sizeof(double); ++k) {
    if (flip >> k & 1u) sign[k] = -1.;
  }
  return a * sign;
}

/// What a folded pair puts on the mirror node of {m v, m}: m flip (v - offset).
template <int Dim>
inline Pack folded_momentum(Pack record, const PairTarget& t, const Pack* offsets) {
  return flipped(t.offset == 0 ? record : record - splat(record[Dim]) * offsets[t.offset], t.flip);
}

/// Adds S_ip * record to every node of a pack's stencils; fold(lane, target): the record of a pair with a target of its own.
template <int Dim, class Shape, class Record, class Fold>
inline void scatter_records(const Stencil<Dim, Shape>& s, const PairTarget* targets, Fold fold, const Record* record, Record* tiles) {
  using T = Tile<Dim, Shape>;
  if constexpr (Stencil<Dim, Shape>::separable) {
    if (!targets) {
      const SeparableSums<Shape> sums(s);
      if (s.of.same_base) return sums.scatter(0, lanes, record, tiles);
      for (int l = 0; l < lanes; ++l) sums.scatter(l, l + 1, record, tiles);
      return;
    }
  }
  if (targets) {
    for (int l = 0; l < lanes; ++l) {
      for (int n = 0; n < T::stencil; ++n) {
        const PairTarget t = targets[l * T::stencil + n];
        Record& q = tiles[t.layer * T::nodes + t.node];
        q = fused(splat_as<Record>(s.weight(n, l)), fold(l, t), q);
      }
    }
  } else if (s.of.same_base) {
    Record* lowest = tiles + s.of.base[0];
    for (int n = 0; n < T::stencil; ++n) {
      Record& q = lowest[T::steps[n]];
      Record sum = q;
      for (int l = 0; l < lanes; ++l) sum = fused(splat_as<Record>(s.weight(n, l)), record[l], sum);
      q = sum;
    }
  } else {
    for (int l = 0; l < lanes; ++l) {
      Record* lowest = tiles + s.of.base[l];
      for (int n = 0; n < T::stencil; ++n) {
        lowest[T::steps[n]] = fused(splat_as<Record>(s.weight(n, l)), record[l], lowest[T::steps[n]]);
      }
    }
  }
}

/// Where the pair of the particle in lane l with node n of its stencil goes.
template <int Dim, class Shape>
inline PairTarget target_of(const Stencil<Dim, Shape>& s, const PairTarget* targets, int l, int n) {
  using T = Tile<Dim, Shape>;
  if (targets) return targets[l * T::stencil + n];
  return {static_cast<std::uint16_t>(s.of.lowest(l) + T::steps[n]), static_cast<std::uint8_t>(s.of.layer), 0};
}

/// Adds to the record of a tile at which the pair of the particle in lane l with node n of its stencil ends, all layers one after another:
/// f(record, components that change sign there).
template <int Dim, class Shape, class Record, class F>
inline void at_target(const Stencil<Dim, Shape>& s, const PairTarget* targets, int l, int n, Record* tiles, F&& f) {
  using T = Tile<Dim, Shape>;
  const PairTarget* pair = targets ? &targets[l * T::stencil + n] : nullptr;
  f(tiles[pair ? pair->layer * T::nodes + pair->node : s.of.base[l] + T::steps[n]], pair ? pair->flip : 0u);
}

/// The same for momenta (N03 Eq. 26: the record is {m v, m}); offsets: of the time that v belongs to.
template <int Dim, class Shape>
inline void scatter(const Stencil<Dim, Shape>& s, const PairTarget* targets, const Pack* offsets, const Pack* record, Pack* tiles) {
  scatter_records<Dim, Shape>(
      s, targets, [&](int l, const PairTarget& t) { return folded_momentum<Dim>(record[l], t, offsets); }, record, tiles);
}

/// f(node value, S_ip or G_ip index n, pair) over the stencil of lane l, in the order of n.
template <int Dim, class Shape, class Value, class F>
inline void for_stencil(const Stencil<Dim, Shape>& s, const PairTarget* targets, int l, const Value* tiles, F&& f) {
  using T = Tile<Dim, Shape>;
  if (targets) {
    for (int n = 0; n < T::stencil; ++n) {
      const PairTarget t = targets[l * T::stencil + n];
      f(tiles[t.layer * T::nodes + t.node], n, t);
    }
  } else {
    const Value* lowest = tiles + s.of.base[l];
    for (int n = 0; n < T::stencil; ++n) f(lowest[T::steps[n]], n, PairTarget{});
  }
}

/// Velocity gradient of four particles, L[d * Dim + k] = sum_i v_i,d G_ip,k (N03 Eq. 36).
template <int Dim, class Shape>
inline void gradient(const Stencil<Dim, Shape>& s, const PairTarget* targets, const Pack* offsets, const NodalVector<Dim>* velocity,
                     Pack* L) {
  using T = Tile<Dim, Shape>;
  if constexpr (Stencil<Dim, Shape>::separable) {
    if (!targets) {
      const SeparableSums<Shape> sums(s);
      const NodalVector<Dim>* lowest = velocity + s.of.base[0];
      if (s.of.same_base) {
        for (int d = 0; d < 3; ++d) sums.gradient([&](int node) { return splat_lane(lowest[node], d); }, L + d * 3);
        return;
      }
      Pack g[lanes][3];
      for (int l = 0; l < lanes; ++l)
        sums.gradient(
            l, [&](int node) { return velocity[s.of.base[l] + node]; }, g[l]);
      for (int k = 0; k < 3; ++k) {
        transpose(g[0][k], g[1][k], g[2][k], g[3][k]);
        for (int d = 0; d < 3; ++d) L[d * 3 + k] = g[d][k];
      }
      return;
    }
  } else if (!targets && s.of.same_base) {
    // Four particles share each node: lanes over particles.
    for (int e = 0; e < Dim * Dim; ++e) L[e] = splat(0.);
    const NodalVector<Dim>* lowest = velocity + s.of.base[0];
    for (int n = 0; n < T::stencil; ++n) {
      for (int d = 0; d < Dim; ++d) {
        const Pack v = splat(lowest[T::steps[n]][d]);
        for (int k = 0; k < Dim; ++k) L[d * Dim + k] = fused(s.weights.G[n][k], v, L[d * Dim + k]);
      }
    }
    return;
  }
  auto* out = reinterpret_cast<double*>(L);
  for (int l = 0; l < lanes; ++l) {
    NodalVector<Dim> column[Dim];
    for (int k = 0; k < Dim; ++k) column[k] = splat_as<NodalVector<Dim>>(0.);
    for_stencil<Dim, Shape>(s, targets, l, velocity, [&](NodalVector<Dim> v_i, int n, const PairTarget& t) {
      const NodalVector<Dim> v = targets ? flipped(v_i, t.flip) + leading<Dim>(offsets[t.offset]) : v_i;
      for (int k = 0; k < Dim; ++k) column[k] = fused(splat_as<NodalVector<Dim>>(s.slope(n, k, l)), v, column[k]);
    });
    for (int d = 0; d < Dim; ++d) {
      for (int k = 0; k < Dim; ++k) out[(d * Dim + k) * lanes + l] = column[k][d];
    }
  }
}

/// scatter_force() for four particles that share their nodes: lanes over particles, summed up for each node.
template <int Dim, class Shape>
inline void scatter_shared_force(const Stencil<Dim, Shape>& s, Pack volume, const Pack* stress, NodalVector<Dim>* tiles) {
  using T = Tile<Dim, Shape>;
  Pack t[stress_size<Dim>];  // -V0 tau
  for (int c = 0; c < stress_size<Dim>; ++c) t[c] = -(volume * stress[c]);
  if constexpr (Dim == 2) {
    NodalVector<Dim>* lowest = tiles + s.of.base[0];
    for (int n = 0; n < T::stencil; ++n) {
      const Pack* G = s.weights.G[n];
      lowest[T::steps[n]] += lane_sums(fused(t[0], G[0], t[2] * G[1]), fused(t[2], G[0], t[1] * G[1]));
    }
  } else {
    SeparableSums<Shape>(s).scatter_slopes(t, tiles);
  }
}

/// Adds -V0 tau . G_ip to every node (N03 Eq. 28; f = -m (sigma/rho0) . G for its material).
template <int Dim, class Shape>
inline void scatter_force(const Stencil<Dim, Shape>& s, const PairTarget* targets, Pack volume, const Pack* stress,
                          NodalVector<Dim>* tiles) {
  using T = Tile<Dim, Shape>;
  if (!targets && s.of.same_base) return scatter_shared_force(s, volume, stress, tiles);
  Pack minus_tau[lanes][Dim];  // columns of -V0 tau; what follows a vector is zero in 3D, and not looked at in 2D
  if constexpr (Dim == 2) {
    Pack xx = -(volume * stress[0]), xy = -(volume * stress[2]), yy = -(volume * stress[1]), again = xy;
    transpose(xx, xy, again, yy);
    const Pack row[lanes] = {xx, xy, again, yy};  // {xx, xy, xy, yy} of lane l
    for (int l = 0; l < lanes; ++l) minus_tau[l][0] = row[l], minus_tau[l][1] = __builtin_shufflevector(row[l], row[l], 2, 3, 0, 1);
  } else {
    static constexpr int column[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int k = 0; k < 3; ++k) {
      Pack a = -(volume * stress[column[k][0]]), b = -(volume * stress[column[k][1]]), c = -(volume * stress[column[k][2]]), d = splat(0.);
      transpose(a, b, c, d);
      minus_tau[0][k] = a, minus_tau[1][k] = b, minus_tau[2][k] = c, minus_tau[3][k] = d;
    }
  }
  for (int l = 0; l < lanes; ++l) {
    if constexpr (Stencil<Dim, Shape>::separable) {
      if (!targets) {
        SeparableSums<Shape>(s).scatter_slopes(l, minus_tau[l], tiles);
        continue;
      }
    }
    NodalVector<Dim> t_k[Dim];
    for (int k = 0; k < Dim; ++k) {
      if constexpr (Dim == 2) {
        t_k[k] = leading<Dim>(minus_tau[l][k]);
      } else {
        t_k[k] = minus_tau[l][k];
      }
    }
    for (int n = 0; n < T::stencil; ++n) {
      if (targets) {
        const PairTarget t = targets[l * T::stencil + n];
        NodalVector<Dim> f = t_k[0] * splat_as<NodalVector<Dim>>(s.slope(n, 0, l));
        for (int k = 1; k < Dim; ++k) f = fused(t_k[k], splat_as<NodalVector<Dim>>(s.slope(n, k, l)), f);
        tiles[t.layer * T::nodes + t.node] += flipped(f, t.flip);
      } else {
        NodalVector<Dim>& q = tiles[s.of.base[l] + T::steps[n]];
        NodalVector<Dim> f = q;
        for (int k = 0; k < Dim; ++k) f = fused(t_k[k], splat_as<NodalVector<Dim>>(s.slope(n, k, l)), f);
        q = f;
      }
    }
  }
}

}  // namespace crampon
