#include "crampon/step/lay_out_blocks.hpp"

#include <algorithm>

#include "crampon/core/parallel.hpp"
#include "crampon/step/fixed_components.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

/// Blocks with particles and all around them, in the order of their numbers.
template <int Dim>
void build_blocks(Blocks<Dim>& blocks, const Grid<Dim>& grid, const std::vector<OccupiedBlock>& occupied) {
  std::vector<std::int64_t> numbers;
  for (const OccupiedBlock& of : occupied) {
    const auto b = grid.block_coordinates(of.number);
    for (int o = 0; o < neighbour_count<Dim>; ++o) {
      const auto step = unflatten<Dim>(o, 3);
      IndexVector<Dim> c = b;
      bool inside = true;
      for (int k = 0; k < Dim; ++k) {
        c[k] += step[k] - 1;
        inside = inside && c[k] >= 0 && c[k] < grid.blocks[k];
      }
      if (inside) numbers.push_back(grid.block_number(c));
    }
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());

  if (blocks.of_number.empty()) {
    blocks.of_number.assign(static_cast<std::size_t>(grid.block_total()), no_block);
  } else {
    for (const Block<Dim>& b : blocks.list) blocks.of_number[static_cast<std::size_t>(grid.block_number(b.coordinates))] = no_block;
  }
  blocks.list.assign(numbers.size(), {});
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    blocks.list[i].coordinates = grid.block_coordinates(numbers[i]);
    blocks.of_number[static_cast<std::size_t>(numbers[i])] = static_cast<std::uint32_t>(i);
  }
  for (Block<Dim>& b : blocks.list) {
    for (int o = 0; o < neighbour_count<Dim>; ++o) {
      const auto step = unflatten<Dim>(o, 3);
      IndexVector<Dim> c = b.coordinates;
      bool inside = true;
      for (int k = 0; k < Dim; ++k) {
        c[k] += step[k] - 1;
        inside = inside && c[k] >= 0 && c[k] < grid.blocks[k];
      }
      b.neighbours[o] = inside ? blocks.of_number[static_cast<std::size_t>(grid.block_number(c))] : no_block;
    }
  }
  for (const OccupiedBlock& o : occupied) {
    Block<Dim>& b = blocks.list[blocks.of_number[static_cast<std::size_t>(o.number)]];
    b.first_run = o.first_run;
    b.end_run = o.end_run;
  }
}

/// What refers to blocks or slots: conditions on nodes, loads on particles.
template <int Dim>
void rebuild_references(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const Grid<Dim>& grid = model.grid;
  work.scratch = std::vector<BlockScratch<Dim>>(work.blocks.size());
  for (std::size_t c = 0; c < model.conditions.size(); ++c) {
    const auto& condition = model.conditions[c];
    for (const std::int64_t number : condition.nodes) {
      IndexVector<Dim> block{};
      std::int64_t rest = number;
      int local = 0, stride = 1;
      for (int k = 0; k < Dim; ++k) {
        const std::int64_t width = std::int64_t{grid.blocks[k]} * block_side;
        const int shifted = static_cast<int>(rest % width);
        rest /= width;
        block[k] = shifted / block_side;
        local += shifted % block_side * stride;
        stride *= block_side;
      }
      const std::uint32_t b = work.blocks.of_number[static_cast<std::size_t>(grid.block_number(block))];
      if (b == no_block) continue;
      for (std::size_t q = 0; q < condition.components.size(); ++q) {
        FixedComponent f;
        f.node = static_cast<std::uint16_t>(local);
        f.axis = static_cast<std::uint8_t>(condition.components[q].axis);
        f.condition = static_cast<std::uint16_t>(c);
        f.component = static_cast<std::uint16_t>(q);
        work.scratch[b].fixed.push_back(f);
      }
    }
  }
  for (auto& scratch : work.scratch) sort_by_component(scratch.fixed);

  if (model.loads.empty() && state.cracks.empty()) return;
  auto& [slot_of_id, block_of_pack] = work.places;
  slot_of_id.assign(state.order.particle_count + static_cast<std::size_t>(state.ledger.removed), padding_id);
  block_of_pack.resize(state.particles.packs);
  for (std::size_t p = 0; p < state.particles.size(); ++p) {
    if (!state.particles.is_padding(p)) slot_of_id[state.particles.id[p]] = static_cast<std::uint32_t>(p);
  }
  for (std::size_t b = 0; b < work.blocks.size(); ++b) {
    for (std::uint32_t r = work.blocks.list[b].first_run; r < work.blocks.list[b].end_run; ++r) {
      const Run& run = state.order.runs[r];
      std::fill(block_of_pack.begin() + run.first_pack, block_of_pack.begin() + run.end_pack, static_cast<std::uint32_t>(b));
    }
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    for (std::size_t e = 0; e < model.loads[l].particles.size(); ++e) {
      const std::uint32_t slot = slot_of_id[model.loads[l].particles[e]];
      if (slot == padding_id) continue;  // removed on leaving the grid
      work.scratch[block_of_pack[slot / lanes]].loaded.push_back({slot, static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(e)});
    }
  }
  for (std::size_t n = 0; n < model.faces.particles.size(); ++n) {
    const std::uint32_t slot = slot_of_id[model.faces.particles[n]];
    work.faces.present[n] = slot != padding_id;
    if (slot != padding_id) work.scratch[block_of_pack[slot / lanes]].faces.push_back({slot, static_cast<std::uint32_t>(n)});
  }
  const auto by_slot = [](const auto& a, const auto& b) { return a.slot < b.slot; };
  for (auto& scratch : work.scratch) {
    std::stable_sort(scratch.loaded.begin(), scratch.loaded.end(), by_slot);
    std::sort(scratch.faces.begin(), scratch.faces.end(), by_slot);
  }
}

}  // namespace

template <int Dim, class Shape>
void lay_out_blocks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  build_blocks(work.blocks, model.grid, state.order.blocks);
  rebuild_references(state, work, model);
  work.nodes.layers.assign(work.blocks.size(), {});
  parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) {
    const Block<Dim>& block = work.blocks.list[b];
    if (!block.has_particles()) return;
    Pack low = splat(1e300), high = splat(-1e300);
    for (std::size_t p = state.order.runs[block.first_run].first_pack * lanes; p < state.order.runs[block.end_run - 1].end_pack * lanes;
         ++p) {
      low = lane_min(low, state.particles.motion[p * motion_packs<Dim>]);
      high = lane_max(high, state.particles.motion[p * motion_packs<Dim>]);
    }
    find_touched_box<Dim, Shape>(work, model, b, low, high);
  });
}

template <int Dim, class Shape>
void find_touched_box(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, Pack lowest, Pack highest) {
  using T = Tile<Dim, Shape>;
  Block<Dim>& block = work.blocks.list[b];
  BlockHealth& health = work.scratch[b].health;
  const auto first = block.first_node();
  for (int k = 0; k < Dim; ++k) {
    const auto lower_node = [&](double x) {
      return std::floor((x - model.grid.origin[k]) * model.grid.inverse_cell[k] + Shape::bin_shift) - Shape::below - first[k] + T::offset;
    };
    double low = lower_node(lowest[k]), high = lower_node(highest[k]) + Shape::width;
    if (!(low >= 0 && high <= T::side)) {
      health.left_margin = true;
      low = std::fmin(std::fmax(low, 0), T::side);
      high = std::fmax(std::fmin(high, T::side), 0);
    }
    block.touched.low[k] = static_cast<std::int16_t>(low);
    block.touched.high[k] = static_cast<std::int16_t>(high);
    if (!(lowest[k] >= model.grid.origin[k] && highest[k] <= model.grid.node_coordinate(k, model.grid.cells[k]))) health.left_grid = true;
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                     \
  template void lay_out_blocks<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&); \
  template void find_touched_box<DIM, SHAPE>(StepWork<DIM>&, const Model<DIM>&, std::size_t, Pack, Pack);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
