#pragma once
/// The engine's state as plain arrays for writers, pictures and checks.

#include "crampon/output/frame.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Particles in the order of their ids, rounded to `precision`; quantities: names of quantities_of(model), none: the common ones. Throws std::invalid_argument for a quantity that does not exist.
template <int Dim>
PointFrame sample_particles(const State<Dim>& state, const Model<Dim>& model, const std::vector<std::string>& quantities,
                            Precision precision = Precision::full);

/// With those of crack_quantities() that the run has.
template <int Dim>
CrackFrame sample_cracks(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model);

/// Every velocity field of every node with mass, as of the last step; nothing before the first.
template <int Dim>
PointFrame sample_nodes(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
