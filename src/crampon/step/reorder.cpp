#include "crampon/step/reorder.hpp"

#include <algorithm>
#include <cstring>

#include "crampon/core/error.hpp"
#include "crampon/core/parallel.hpp"
#include "crampon/step/boundary.hpp"
#include "crampon/step/instantiate.hpp"

namespace crampon {

namespace {

/// Sort key of a particle. The bin orders particles inside a run by base node.
struct Place {
  std::uint64_t block;
  std::uint32_t material, bin, id, slot;
  friend bool operator<(const Place& a, const Place& b) {
    if (a.block != b.block) return a.block < b.block;
    if (a.material != b.material) return a.material < b.material;
    if (a.bin != b.bin) return a.bin < b.bin;
    return a.id < b.id;
  }
};

template <int Dim, class Shape>
Place place_of(const State<Dim>& state, const Model<Dim>& model, std::size_t slot, std::uint32_t material) {
  const Vec<Dim> x = state.particles.position(slot);
  Place place{};
  IndexVector<Dim> block{};
  int bin = 0;
  for (int k = Dim - 1; k >= 0; --k) {
    const int cell = static_cast<int>(std::floor((x[k] - model.grid.origin[k]) * model.grid.inverse_cell[k] + Shape::bin_shift));
    block[k] = Grid<Dim>::block_of(cell);
    bin = bin * block_side + (cell - Grid<Dim>::first_node(block[k]));
  }
  place.block = static_cast<std::uint64_t>(model.grid.block_number(block));
  place.material = material;
  place.bin = static_cast<std::uint32_t>(bin);
  place.id = state.particles.id[slot];
  place.slot = static_cast<std::uint32_t>(slot);
  return place;
}

/// Every particle's material, from the runs it stood in.
template <int Dim>
std::vector<std::uint32_t> materials_by_slot(const State<Dim>& state) {
  std::vector<std::uint32_t> material(state.particles.size(), 0);
  for (const Run& run : state.blocks.runs) {
    std::fill(material.begin() + run.first_pack * lanes, material.begin() + run.end_pack * lanes, run.material);
  }
  return material;
}

template <int Dim>
void copy_particle(const Particles<Dim>& from, std::size_t a, Particles<Dim>& to, std::size_t b) {
  for (int r = 0; r < motion_packs<Dim>; ++r) to.motion[b * motion_packs<Dim> + r] = from.motion[a * motion_packs<Dim> + r];
  const auto lane = [](auto& array, std::size_t p, int width, int c) -> double& {
    return reinterpret_cast<double*>(&array[p / lanes * width + c])[p % lanes];
  };
  auto& source = const_cast<Particles<Dim>&>(from);
  for (int c = 0; c < 2; ++c) lane(to.mass_volume, b, 2, c) = lane(source.mass_volume, a, 2, c);
  for (int c = 0; c < stress_size<Dim>; ++c) lane(to.stress, b, stress_size<Dim>, c) = lane(source.stress, a, stress_size<Dim>, c);
  for (int c = 0; c < to.history_size; ++c) lane(to.history, b, to.history_size, c) = lane(source.history, a, to.history_size, c);
  to.original[b] = from.original[a];
  if (to.contact.size() > 0) to.contact[b] = from.contact[a];
  to.id[b] = from.id[a];
  to.body[b] = from.body[a];
}

/// Blocks with particles and all around them, in the order of their numbers.
template <int Dim>
void build_blocks(Blocks<Dim>& blocks, const Grid<Dim>& grid, const std::vector<std::uint64_t>& occupied) {
  std::vector<std::int64_t> numbers;
  for (const std::uint64_t n : occupied) {
    const auto b = grid.block_coordinates(static_cast<std::int64_t>(n));
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
}

/// What refers to blocks or slots: conditions on nodes, loads on particles.
template <int Dim>
void rebuild_references(State<Dim>& state, const Model<Dim>& model) {
  const Grid<Dim>& grid = model.grid;
  state.scratch.assign(state.blocks.size(), {});
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
      const std::uint32_t b = state.blocks.of_number[static_cast<std::size_t>(grid.block_number(block))];
      if (b == no_block) continue;
      for (std::size_t q = 0; q < condition.components.size(); ++q) {
        FixedComponent f;
        f.node = static_cast<std::uint16_t>(local);
        f.axis = static_cast<std::uint8_t>(condition.components[q].axis);
        f.condition = static_cast<std::uint16_t>(c);
        f.component = static_cast<std::uint16_t>(q);
        state.scratch[b].fixed.push_back(f);
      }
    }
  }
  for (auto& scratch : state.scratch) sort_by_component(scratch.fixed);

  if (model.loads.empty()) return;
  std::vector<std::uint32_t> slot_of_id(state.particle_count + static_cast<std::size_t>(state.removed), padding_id);
  std::vector<std::uint32_t> block_of_pack(state.particles.packs);
  for (std::size_t p = 0; p < state.particles.size(); ++p) {
    if (!state.particles.is_padding(p)) slot_of_id[state.particles.id[p]] = static_cast<std::uint32_t>(p);
  }
  for (std::size_t b = 0; b < state.blocks.size(); ++b) {
    for (std::uint32_t r = state.blocks.list[b].first_run; r < state.blocks.list[b].end_run; ++r) {
      const Run& run = state.blocks.runs[r];
      std::fill(block_of_pack.begin() + run.first_pack, block_of_pack.begin() + run.end_pack, static_cast<std::uint32_t>(b));
    }
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    for (std::size_t e = 0; e < model.loads[l].particles.size(); ++e) {
      const std::uint32_t slot = slot_of_id[model.loads[l].particles[e]];
      if (slot == padding_id) continue;  // removed on leaving the grid
      state.scratch[block_of_pack[slot / lanes]].loaded.push_back({slot, static_cast<std::uint32_t>(l), static_cast<std::uint32_t>(e)});
    }
  }
}

}  // namespace

template <int Dim, class Shape>
void reorder(State<Dim>& state, const Model<Dim>& model) {
  Particles<Dim>& old = state.particles;
  const auto material = materials_by_slot(state);
  std::vector<Place> order;
  order.reserve(old.size());
  for (std::size_t p = 0; p < old.size(); ++p) {
    if (!old.is_padding(p)) order.push_back(place_of<Dim, Shape>(state, model, p, material[p]));
  }
  if (!std::is_sorted(order.begin(), order.end())) std::sort(order.begin(), order.end());

  std::vector<Run> runs;
  std::vector<std::uint64_t> occupied;
  std::vector<std::pair<std::size_t, std::size_t>> spans;  // of `order`, per run
  std::vector<std::size_t> first_run_of;                   // per occupied block
  std::uint32_t pack = 0;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && order[j].block == order[i].block && order[j].material == order[i].material) ++j;
    if (occupied.empty() || occupied.back() != order[i].block) {
      occupied.push_back(order[i].block);
      first_run_of.push_back(runs.size());
    }
    const auto packs = static_cast<std::uint32_t>((j - i + lanes - 1) / lanes);
    runs.push_back({pack, pack + packs, order[i].material});
    spans.emplace_back(i, j);
    pack += packs;
    i = j;
  }
  first_run_of.push_back(runs.size());

  Particles<Dim> fresh;
  fresh.allocate(pack, old.history_size, old.contact.size() > 0);
  parallel_for(runs.size(), model.threads, [&](std::size_t r) {
    std::size_t slot = std::size_t{runs[r].first_pack} * lanes;
    const std::size_t end = std::size_t{runs[r].end_pack} * lanes;
    for (std::size_t i = spans[r].first; i < spans[r].second; ++i) copy_particle(old, order[i].slot, fresh, slot++);
    for (; slot < end; ++slot) {  // padding: a copy of the run's last particle without mass and volume
      copy_particle(fresh, slot - 1, fresh, slot);
      fresh.id[slot] = padding_id;
      for (int c = 0; c < 2; ++c) reinterpret_cast<double*>(&fresh.mass_volume[slot / lanes * 2 + c])[slot % lanes] = 0.;
    }
  });
  old = std::move(fresh);
  state.blocks.runs = std::move(runs);
  build_blocks(state.blocks, model.grid, occupied);
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    Block<Dim>& b = state.blocks.list[state.blocks.of_number[occupied[i]]];
    b.first_run = static_cast<std::uint32_t>(first_run_of[i]);
    b.end_run = static_cast<std::uint32_t>(first_run_of[i + 1]);
  }
  state.particle_count = order.size();
  rebuild_references(state, model);
  state.nodes.layers.assign(state.blocks.size(), {});
  parallel_for(state.blocks.size(), model.threads, [&](std::size_t b) {
    const Block<Dim>& block = state.blocks.list[b];
    if (!block.has_particles()) return;
    Pack low = splat(1e300), high = splat(-1e300);
    for (std::size_t p = state.blocks.runs[block.first_run].first_pack * lanes; p < state.blocks.runs[block.end_run - 1].end_pack * lanes;
         ++p) {
      low = lane_min(low, state.particles.motion[p * motion_packs<Dim>]);
      high = lane_max(high, state.particles.motion[p * motion_packs<Dim>]);
    }
    find_touched_box<Dim, Shape>(state, model, b, low, high);
  });
  state.must_reorder = false;
}

template <int Dim, class Shape>
void find_touched_box(State<Dim>& state, const Model<Dim>& model, std::size_t b, Pack lowest, Pack highest) {
  using T = Tile<Dim, Shape>;
  Block<Dim>& block = state.blocks.list[b];
  BlockHealth& health = state.scratch[b].health;
  const auto first = block.first_node();
  for (int k = 0; k < Dim; ++k) {
    const auto lower_node = [&](double x) {
      return std::floor((x - model.grid.origin[k]) * model.grid.inverse_cell[k] + Shape::bin_shift) - (Shape::width == 3 ? 1 : 0) -
             first[k] + T::offset;
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

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                              \
  template void reorder<DIM, SHAPE>(State<DIM>&, const Model<DIM>&); \
  template void find_touched_box<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t, Pack, Pack);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
