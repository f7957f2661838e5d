#pragma once
/// The last walk over the particles of a block in a step (Tasks 5 and 6), on which they move.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Do particles strain before they move, and do they take accelerations as they do?
enum class Strain { done, now };
enum class Accelerate { done, now };

/// Moves the particles of a block after what is to be done `now`, pack by pack. Particles take up what contact at nodes has gained. Finds the box
/// that they now reach, and their health.
template <int Dim, class Shape>
void finish_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, Strain strain,
                      Accelerate accelerate);

}  // namespace crampon
