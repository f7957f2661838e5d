#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <map>

#include "crampon/core/parallel.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/lay_out_blocks.hpp"

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
void bring_into_order(Particles<Dim>& particles, const Order& order, int threads) {
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

}  // namespace

template <int Dim, class Shape>
void reorder(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  Order order = find_order<Dim, Shape>(state, model);
  bring_into_order(state.particles, order, model.threads);
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

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void reorder<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
