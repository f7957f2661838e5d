#pragma once
/// The engine's state as plain arrays for writers, pictures and checks.

#include "crampon/output/frame.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// A particle quantity as users meet it.
struct QuantityDescription {
  std::string name, unit;
  int components = 1;   ///< 1, 3 (x, y, z) or 6 (xx, yy, zz, xy, yz, xz)
  bool common = false;  ///< written unless the input chooses
  std::string meaning, formula;
};
std::vector<QuantityDescription> describe_particle_quantities();
std::vector<std::string> particle_quantity_names();
std::vector<std::string> common_quantity_names();

/// Particles in the order of their ids, rounded to `precision`. Throws std::invalid_argument for a quantity that does not exist.
template <int Dim>
PointFrame sample_particles(const State<Dim>& state, const Model<Dim>& model, const std::vector<std::string>& quantities,
                            Precision precision = Precision::full);

template <int Dim>
CrackFrame sample_cracks(const State<Dim>& state, const StepWork<Dim>& work);

/// Every velocity field of every node with mass, as of the last step; nothing before the first.
template <int Dim>
PointFrame sample_nodes(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
