#pragma once
/// The variables that a material law keeps beside stress and deformation, as the law declares them.

#include <string_view>

#include "crampon/state/particles.hpp"

namespace crampon {

/// A variable of a law, which stands in its history. What a law declares can be written, probed, checked and drawn like any other quantity
/// of particles.
struct LawVariable {
  /// dissipated: the energy that the law has taken from the motion since the start, per initial volume, J/m3, one component. It never falls.
  /// The history of the run adds it up as `material_loss`, and the energy balance counts it.
  enum class Kind { state, dissipated };

  std::string_view name;  ///< "plastic_strain"; laws that share a name share the unit and the number of components
  std::string_view unit;
  std::string_view help;
  int at = 0;          ///< the first of its Packs in the history
  int components = 1;  ///< 1; 3: a vector, one Pack an axis; 6: a symmetric tensor, its Packs in the order of the stress
  Kind kind = Kind::state;
  bool common = true;  ///< written unless the input chooses quantities

  /// Packs in the history.
  constexpr int size(int dimension) const {
    return components == 3 ? dimension : components == 6 ? (dimension == 2 ? stress_size<2> : stress_size<3>) : 1;
  }
};

}  // namespace crampon
