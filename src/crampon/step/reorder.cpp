#include "crampon/step/reorder.hpp"

#include <algorithm>
#include <map>

#include "crampon/core/error.hpp"
#include "crampon/core/parallel.hpp"
#include "crampon/step/boundary.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

/// Where a particle belongs: its block, and its rank there by material, then base node (a pack's particles are to share theirs), then id.
struct Place {
  std::int64_t block;
  std::uint64_t rank;
};
constexpr std::int64_t no_place = -1;  ///< block of padding
constexpr int rank_bits_of_node = 9, rank_bits_of_id = 32;

std::uint32_t material_of(const Place& place) { return static_cast<std::uint32_t>(place.rank >> (rank_bits_of_node + rank_bits_of_id)); }

template <int Dim, class Shape>
Place place_of(const Particles<Dim>& particles, const Grid<Dim>& grid, std::size_t slot, std::uint32_t material) {
  static_assert(block_nodes<Dim> <= 1 << rank_bits_of_node);
  if (particles.is_padding(slot)) return {no_place, 0};
  const Vec<Dim> x = particles.position(slot);
  IndexVector<Dim> block{};
  std::uint64_t node = 0;
  for (int k = Dim - 1; k >= 0; --k) {
    const int cell = static_cast<int>(std::floor((x[k] - grid.origin[k]) * grid.inverse_cell[k] + Shape::bin_shift));
    block[k] = Grid<Dim>::block_of(cell);
    node = node * block_side + static_cast<std::uint64_t>(cell - Grid<Dim>::first_node(block[k]));
  }
  return {grid.block_number(block), (std::uint64_t{material} << rank_bits_of_node | node) << rank_bits_of_id | particles.id[slot]};
}

/// Where everything goes.
struct Order {
  std::vector<std::int64_t> occupied;  ///< numbers of the blocks with particles, ascending
  std::vector<std::size_t> first_run;  ///< [occupied + 1]
  std::vector<Run> runs;
  std::vector<std::uint32_t> source;  ///< [particle in its new order]: slot where it stands now
  std::vector<std::size_t> first;     ///< [run + 1]: of source

  std::size_t packs() const { return runs.empty() ? 0 : runs.back().end_pack; }
};

/// Slots by block: counted, then dealt out. Sets occupied and source; inside a block slots stay in their order. Returns where each block begins.
std::vector<std::size_t> deal_to_blocks(const std::vector<Place>& places, Order& order) {
  std::map<std::int64_t, std::size_t> of_block;  // how many; then where the next one goes
  const auto for_each = [&](auto f) {
    std::int64_t block = no_place;
    std::size_t* entry = nullptr;
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (places[p].block == no_place) continue;
      if (!entry || places[p].block != block) entry = &of_block[block = places[p].block];  // neighbours mostly stand in the same
      f(static_cast<std::uint32_t>(p), *entry);
    }
  };
  for_each([](std::uint32_t, std::size_t& count) { ++count; });
  std::vector<std::size_t> begin;
  std::size_t total = 0;
  for (auto& [block, count] : of_block) {
    order.occupied.push_back(block);
    begin.push_back(total);
    total += std::exchange(count, total);
  }
  begin.push_back(total);
  order.source.resize(total);
  for_each([&](std::uint32_t p, std::size_t& next) { order.source[next++] = p; });
  return begin;
}

template <int Dim, class Shape>
Order find_order(const State<Dim>& state, const Model<Dim>& model) {
  std::vector<Place> places(state.particles.size());
  parallel_for(state.order.runs.size(), model.threads, [&](std::size_t r) {
    const Run& run = state.order.runs[r];
    for (std::size_t p = run.first_pack * lanes; p < run.end_pack * lanes; ++p) {
      places[p] = place_of<Dim, Shape>(state.particles, model.grid, p, run.material);
    }
  });
  Order order;
  const std::vector<std::size_t> begin = deal_to_blocks(places, order);
  const auto at = order.source.begin();
  parallel_for(order.occupied.size(), model.threads, [&](std::size_t b) {
    const auto before = [&](std::uint32_t p, std::uint32_t q) { return places[p].rank < places[q].rank; };
    const auto first = at + static_cast<std::ptrdiff_t>(begin[b]), end = at + static_cast<std::ptrdiff_t>(begin[b + 1]);
    if (!std::is_sorted(first, end, before)) std::sort(first, end, before);
  });
  std::uint32_t pack = 0;
  for (std::size_t b = 0; b < order.occupied.size(); ++b) {
    order.first_run.push_back(order.runs.size());
    for (std::size_t i = begin[b]; i < begin[b + 1];) {
      const std::uint32_t material = material_of(places[order.source[i]]);
      const auto end = std::partition_point(at + static_cast<std::ptrdiff_t>(i), at + static_cast<std::ptrdiff_t>(begin[b + 1]),
                                            [&](std::uint32_t p) { return material_of(places[p]) == material; });
      order.first.push_back(i);
      const std::size_t count = static_cast<std::size_t>(end - at) - i;
      const auto packs = static_cast<std::uint32_t>((count + lanes - 1) / lanes);
      order.runs.push_back({pack, pack + packs, material});
      pack += packs;
      i += count;
    }
  }
  order.first_run.push_back(order.runs.size());
  order.first.push_back(order.source.size());
  return order;
}

/// f(pack, slots its particles come from) for all packs in their new order. The last particle of a run fills up its last pack.
template <class F>
void for_new_packs(const Order& order, int threads, F f) {
  parallel_for(order.runs.size(), threads, [&](std::size_t r) {
    std::size_t i = order.first[r];
    for (std::size_t k = order.runs[r].first_pack; k < order.runs[r].end_pack; ++k) {
      std::size_t from[lanes];
      for (std::size_t& slot : from) {
        slot = order.source[i];
        if (i + 1 < order.first[r + 1]) ++i;
      }
      f(k, from);
    }
  });
}

/// Brings an array with `width` records per particle into the new order. One array after the other: little memory is taken twice.
template <class Record>
void move_records(AlignedArray<Record>& array, std::size_t width, const Order& order, int threads) {
  AlignedArray<Record> moved(order.packs() * lanes * width);
  for_new_packs(order, threads, [&](std::size_t k, const std::size_t(&from)[lanes]) {
    Record* to = &moved[k * lanes * width];
    for (const std::size_t slot : from) to = std::copy_n(&array[slot * width], width, to);
  });
  array = std::move(moved);
}

/// The same for `width` packs per pack of particles.
void move_lanes(AlignedArray<Pack>& array, std::size_t width, const Order& order, int threads) {
  AlignedArray<Pack> moved(order.packs() * width);
  for_new_packs(order, threads, [&](std::size_t k, const std::size_t(&from)[lanes]) {
    for (std::size_t c = 0; c < width; ++c) {
      Pack& to = moved[k * width + c];
      for (std::size_t l = 0; l < lanes; ++l) to[l] = array[from[l] / lanes * width + c][from[l] % lanes];
    }
  });
  array = std::move(moved);
}

template <class Record>
void move_array(AlignedArray<Record>& array, PerParticle layout, const Order& order, int threads) {
  move_records(array, layout.width, order, threads);
}
void move_array(AlignedArray<Pack>& array, PerPack layout, const Order& order, int threads) {
  move_lanes(array, layout.width, order, threads);
}

template <int Dim>
void move_particles(Particles<Dim>& particles, const Order& order, int threads) {
  Particles<Dim>::for_arrays(particles, [&](const Member&, auto& array, auto layout) {
    if (layout.width > 0) move_array(array, layout, order, threads);
  });
  particles.packs = order.packs();
  for (std::size_t r = 0; r < order.runs.size(); ++r) {
    const std::size_t real = order.runs[r].first_pack * lanes + (order.first[r + 1] - order.first[r]);
    for (std::size_t p = real; p < order.runs[r].end_pack * lanes; ++p) {
      particles.id[p] = padding_id;
      for (std::size_t c = 0; c < 2; ++c) particles.mass_volume[p / lanes * 2 + c][p % lanes] = 0.;
    }
  }
}

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
void reorder(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  Order order = find_order<Dim, Shape>(state, model);
  move_particles(state.particles, order, model.threads);
  ParticleOrder& kept = state.order;
  kept.particle_count = order.source.size();
  kept.runs = std::move(order.runs);
  kept.blocks.clear();
  for (std::size_t i = 0; i < order.occupied.size(); ++i) {
    kept.blocks.push_back(
        {order.occupied[i], static_cast<std::uint32_t>(order.first_run[i]), static_cast<std::uint32_t>(order.first_run[i + 1])});
  }
  kept.must_reorder = false;
  kept.step = state.clock.step;
  lay_out_blocks<Dim, Shape>(state, work, model);
}

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
  template void reorder<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);        \
  template void lay_out_blocks<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&); \
  template void find_touched_box<DIM, SHAPE>(StepWork<DIM>&, const Model<DIM>&, std::size_t, Pack, Pack);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
