#pragma once
/// The quantities of particles, a line of a table each. Output, probes, expectations, pictures and the reference page follow from it.

#include <functional>
#include <string>
#include <vector>

#include "crampon/step/particle_view.hpp"

namespace crampon {

/// A quantity of particles as users meet it.
struct ParticleQuantity {
  std::string name, unit;
  int components = 1;   ///< 1, 3 (x, y, z) or 6 (xx, yy, zz, xy, yz, xz)
  bool common = false;  ///< written unless the input chooses
  std::string help, formula;
  std::function<void(const ParticleView&, double*)> get;  ///< all components
};

/// Those that particles of every material have.
const std::vector<ParticleQuantity>& general_quantities();
/// Adds one from outside the table, before the first problem is built. Throws std::logic_error where the name is taken.
void add_quantity(ParticleQuantity quantity);

/// The variables that laws declare, each name once in the order of the laws. Particles of other laws hold NaN, which ParaView and pictures show
/// in a colour of its own and leave out of the range: zero would say that they have the variable. Throws std::logic_error where a name stands for different things.
std::vector<ParticleQuantity> quantities_of_laws(const std::vector<const MaterialLaw*>& laws);

/// All that particles of a model have.
template <int Dim>
std::vector<ParticleQuantity> quantities_of(const Model<Dim>& model) {
  std::vector<const MaterialLaw*> laws;
  for (const Material<Dim>& material : model.materials) laws.push_back(material.law.get());
  std::vector<ParticleQuantity> all = general_quantities();
  for (ParticleQuantity& q : quantities_of_laws(laws)) all.push_back(std::move(q));
  return all;
}

template <int Dim>
std::vector<std::string> quantity_names_of(const Model<Dim>& model) {
  std::vector<std::string> names;
  for (const ParticleQuantity& q : quantities_of(model)) names.push_back(q.name);
  return names;
}

}  // namespace crampon
