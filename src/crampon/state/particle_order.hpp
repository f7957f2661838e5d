#pragma once
/// The order of particles. It is part of the state: a particle that has drifted into the next block belongs to its old one until the next
/// re-ordering, and sums over particles follow the order.

#include <cstdint>
#include <vector>

#include "crampon/core/members.hpp"

namespace crampon {

/// Particles of one block and one material: the unit of dispatch. Padded to whole packs.
struct Run {
  std::uint32_t first_pack = 0, end_pack = 0;
  std::uint32_t material = 0;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [first_pack, end_pack, material] = self;
    visit(Member{"first_pack"}, first_pack);
    visit(Member{"end_pack"}, end_pack);
    visit(Member{"material"}, material);
  }
};

/// A block with particles.
struct OccupiedBlock {
  std::int64_t number = 0;  ///< in the grid
  std::uint32_t first_run = 0, end_run = 0;

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [number, first_run, end_run] = self;
    visit(Member{"number"}, number);
    visit(Member{"first_run"}, first_run);
    visit(Member{"end_run"}, end_run);
  }
};

struct ParticleOrder {
  std::vector<Run> runs;              ///< by block
  std::vector<OccupiedBlock> blocks;  ///< ascending; empty before the first re-ordering
  bool must_reorder = true;           ///< before the next step
  std::size_t particle_count = 0;
  std::int64_t step = -1;  ///< the step that began with the last re-ordering

  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [runs, blocks, must_reorder, particle_count, step] = self;
    visit(Member{"runs"}, runs);
    visit(Member{"blocks"}, blocks);
    visit(Member{"must_reorder"}, must_reorder);
    visit(Member{"particle_count"}, particle_count);
    visit(Member{"step"}, step);
  }
};

}  // namespace crampon
