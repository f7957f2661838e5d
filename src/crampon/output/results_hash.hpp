#pragma once
/// One number for the state that results end with.

#include <cstdint>

#include "crampon/output/results_folder.hpp"

namespace crampon {

/// Hash (FNV-1a) of the last frame of particles and of cracks, read from disk: positions and all quantities as they were written. Equal for
/// equal numbers, however they are packed. Throws std::runtime_error when there is no frame or one is damaged.
std::uint64_t hash_results(const ResultsFolder& folder);

}  // namespace crampon
