#pragma once
// A solid with a flat crack in it, put together by hand: particles in order, blocks with all their nodes, and the surface points of the crack with
// their carriers. For tests of what moves with cracks, in the plane and in space.

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "crampon/step/assemble.hpp"
#include "crampon/step/linear_fit.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon::testing {

/// x -> A (x - c) + b.
template <int Dim>
struct Affine {
  std::array<Vec<Dim>, Dim> A{};  ///< rows
  Vec<Dim> b, c;

  static Affine random(std::mt19937_64& rng, const Vec<Dim>& c, double slope, double shift) {
    std::uniform_real_distribution<double> of(-1, 1);
    Affine out;
    out.c = c;
    for (int d = 0; d < Dim; ++d) {
      out.b[d] = shift * of(rng);
      for (int k = 0; k < Dim; ++k) out.A[d][k] = slope * of(rng);
    }
    return out;
  }
  Vec<Dim> operator()(const Vec<Dim>& x) const {
    Vec<Dim> out = b;
    for (int d = 0; d < Dim; ++d) out[d] += dot(A[d], x - c);
    return out;
  }
};

template <int Dim>
struct CrackedSolid {
  State<Dim> state;
  StepWork<Dim> work;
  Model<Dim> model;
  Vec<Dim> centre, along, up;  ///< of the crack; along: the direction of the path in the plane
  std::mt19937_64 rng{11};

  /// Two particles per cell and axis, moved a little at random; the crack has `size` facets, in space pairs of them, along each of its sides.
  explicit CrackedSolid(VertexId size = 6) {
    Vec<Dim> cell;
    IndexVector<Dim> cells{};
    for (int k = 0; k < Dim; ++k) cell[k] = 0.5 - 0.1 * k, cells[k] = 12;
    model.grid = Grid<Dim>({}, cell, cells);
    model.materials.resize(1);
    lay_out_blocks();
    place_particles();
    place_crack(size);
  }

  Crack<Dim>& crack() { return state.cracks.list.front(); }
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }
  Vec<Dim> node_position(std::size_t block, std::size_t slot) const {
    return model.grid.node_position(work.blocks.list[block].node(static_cast<int>(slot - block * block_nodes<Dim>)));
  }

  /// Displaces all particles; f(X): displacement of what was at X, m.
  template <class F>
  void displace(F f) {
    for (std::size_t p = 0; p < state.particles.size(); ++p) {
      const Vec<Dim> X = state.particles.original[p];
      state.particles.set_motion(p, X + f(X), state.particles.velocity(p));
    }
  }
  /// Nodes with masses at random and the velocity f(x), m/s, or without mass.
  template <class F>
  void set_nodes(F f, bool massive = true) {
    for (std::size_t b = 0; b < work.blocks.size(); ++b) {
      for (std::size_t n = 0; n < block_nodes<Dim>; ++n) {
        const std::size_t slot = b * block_nodes<Dim> + n;
        const double m = massive ? draw(0.5, 2) : 0;
        const Vec<Dim> v = f(node_position(b, slot));
        Pack record = splat(0.);
        for (int k = 0; k < Dim; ++k) record[k] = m * v[k];
        record[Dim] = m;
        work.nodes.momentum[slot] = record;
      }
    }
  }
  void leave_nodes_empty() {
    set_nodes([](const Vec<Dim>&) { return Vec<Dim>{}; }, false);
  }

  bool is_above(const Vec<Dim>& X) const { return dot(X - centre, up) > 0; }

  /// Of the linear fit to particles on one side within a cell and a half.
  std::vector<Carrier> carriers(const Vec<Dim>& x, bool above) const {
    constexpr double reach = 1.5;
    std::vector<Vec<Dim>> y;
    std::vector<double> weights;
    std::vector<Carrier> out;
    for (std::size_t p = 0; p < state.particles.size(); ++p) {
      if (state.particles.is_padding(p) || is_above(state.particles.original[p]) != above) continue;
      Vec<Dim> d = state.particles.original[p] - x;
      double own = state.particles.mass(p);
      bool near = true;
      for (int k = 0; k < Dim; ++k) {
        d[k] *= model.grid.inverse_cell[k];
        near = near && std::fabs(d[k]) < reach;
        own *= (1 - std::fabs(d[k]) / reach) * (1 - std::fabs(d[k]) / reach);
      }
      if (!near) continue;
      y.push_back(d);
      weights.push_back(own);
      out.push_back({state.particles.id[p], 0, 0});
    }
    const LinearFit<Dim> fit(y, weights);
    for (std::size_t i = 0; i < out.size(); ++i) out[i].weight = weights[i];
    return out;
  }
  void choose_carriers() {
    Crack<Dim>& c = crack();
    c.upper_carriers.clear(), c.lower_carriers.clear();
    for (const Vec<Dim>& x : c.plane) {
      c.upper_carriers.push_back(carriers(x, true));
      c.lower_carriers.push_back(carriers(x, false));
    }
  }

 private:
  void lay_out_blocks() {
    Blocks<Dim>& blocks = work.blocks;
    const auto total = static_cast<std::size_t>(model.grid.block_total());
    blocks.list.resize(total);
    blocks.of_number.resize(total);
    std::iota(blocks.of_number.begin(), blocks.of_number.end(), 0u);
    for (std::size_t b = 0; b < total; ++b) {
      blocks.list[b].coordinates = model.grid.block_coordinates(static_cast<std::int64_t>(b));
      for (int o = 0; o < neighbour_count<Dim>; ++o) {
        IndexVector<Dim> there = blocks.list[b].coordinates;
        const IndexVector<Dim> step = neighbour_step<Dim>(o);
        bool is_there = true;
        for (int k = 0; k < Dim; ++k) {
          there[k] += step[k];
          is_there = is_there && there[k] >= 0 && there[k] < model.grid.blocks[k];
        }
        blocks.list[b].neighbours[o] = is_there ? static_cast<std::uint32_t>(model.grid.block_number(there)) : no_block;
      }
    }
    work.nodes.layers.resize(total);
    for (std::size_t b = 0; b < total; ++b) work.nodes.layers[b].node_begin = static_cast<std::uint32_t>(b);
    work.nodes.momentum.nodes.resize_discarding(total * block_nodes<Dim>);
    work.nodes.force.nodes.resize_discarding(total * block_nodes<Dim>);
    work.scratch.resize(total);
  }

  void place_particles() {
    std::map<std::uint32_t, std::vector<Vec<Dim>>> in_block;
    constexpr int low = 4, side = 16;  // half cells
    for (int n = 0; n < power(side, Dim); ++n) {
      Vec<Dim> x;
      IndexVector<Dim> block{};
      const IndexVector<Dim> at = unflatten<Dim>(n, side);
      for (int k = 0; k < Dim; ++k) {
        const double g = 0.5 * (low + at[k]) + 0.25 + draw(-0.1, 0.1);
        x[k] = g * model.grid.cell[k];
        block[k] = Grid<Dim>::block_of(static_cast<int>(std::floor(g)));
      }
      in_block[static_cast<std::uint32_t>(model.grid.block_number(block))].push_back(x);
    }
    Particles<Dim>& particles = state.particles;
    for (const auto& [block, places] : in_block) particles.packs += (places.size() + lanes - 1) / lanes;
    particles.allocate();
    std::uint32_t slot = 0, id = 0;
    for (const auto& [block, places] : in_block) {
      work.blocks.list[block].first_run = static_cast<std::uint32_t>(state.order.runs.size());
      state.order.runs.push_back({slot / lanes, 0, 0});
      for (std::size_t i = 0; i < (places.size() + lanes - 1) / lanes * lanes; ++i, ++slot) {
        const bool real = i < places.size();
        const Vec<Dim>& x = places[real ? i : 0];
        if (slot % lanes == 0) work.places.block_of_pack.push_back(block);
        particles.set_motion(slot, x, {});
        particles.original[slot] = x;
        particles.mass_volume[slot / lanes * 2][slot % lanes] = real ? draw(0.5, 2) : 0;
        particles.mass_volume[slot / lanes * 2 + 1][slot % lanes] = real ? 1 : 0;
        particles.id[slot] = real ? id++ : padding_id;
        particles.body[slot] = 0;
        if (real) work.places.slot_of_id.push_back(slot);
      }
      state.order.runs.back().end_pack = slot / lanes;
      work.blocks.list[block].end_run = static_cast<std::uint32_t>(state.order.runs.size());
    }
    state.order.particle_count = id;
  }

  void place_crack(VertexId size) {
    Crack<Dim>& c = state.cracks.list.emplace_back();
    c.name = "flat";
    for (int k = 0; k < Dim; ++k) centre[k] = 6.03 * model.grid.cell[k];
    const double step = 0.27;
    if constexpr (Dim == 2) {
      along = normalized(Vec<2>{{0.9, 0.35}});
      up = Vec<2>{{-along[1], along[0]}};
      for (VertexId i = 0; i <= size; ++i) c.plane.push_back(centre + along * ((i - 0.5 * size) * step));
      for (VertexId i = 0; i < size; ++i) c.facets.push_back({i, i + 1});
    } else {
      along = normalized(Vec<3>{{0.9, 0.35, 0.2}});
      const Vec<3> aside = normalized(Vec<3>{{-0.35, 0.9, 0}});
      up = Vec<3>{{along[1] * aside[2] - along[2] * aside[1], along[2] * aside[0] - along[0] * aside[2],
                   along[0] * aside[1] - along[1] * aside[0]}};
      for (VertexId j = 0; j <= size; ++j) {
        for (VertexId i = 0; i <= size; ++i)
          c.plane.push_back(centre + along * ((i - 0.5 * size) * step) + aside * ((j - 0.5 * size) * 0.8 * step));
      }
      for (VertexId j = 0; j < size; ++j) {
        for (VertexId i = 0; i < size; ++i) {
          const VertexId a = j * (size + 1) + i, b = a + 1, d = a + size + 1;
          c.facets.push_back({a, b, d + 1});
          c.facets.push_back({d + 1, d, a});
        }
      }
    }
    c.upper = c.lower = c.original = c.plane;
    model.contact.crack_laws.resize(1);
    model.tractions.resize(1);
  }
};

}  // namespace crampon::testing
