#pragma once
/// What a step keeps of particles about the tips of cracks, in order to find fracture parameters at its end.

#include <cstdint>
#include <vector>

#include "crampon/crack/tip_domain.hpp"

namespace crampon {

/// A particle about a tip as it was at the start of the step.
struct WatchedParticle {
  std::uint32_t slot = 0, material = 0;
  Vec<2> velocity;     ///< m/s
  Tensor2 gradient{};  ///< u_i,k
};

/// The surroundings of one tip, wide enough for the largest domain and for the material around it.
struct TipWatch {
  std::vector<WatchedParticle> particles;  ///< in the order of slots
};

}  // namespace crampon
