#pragma once

#include <vector>

namespace crampon {

/// How fracture parameters are found (docs/theory/fracture.md).
struct FractureModel {
  enum class Mixity { interaction, opening };
  enum class Form { domain, contour };
  static constexpr double least_outer = 3;  ///< cells: about a tip with less room there is no J
  bool on = false;
  double inner = 3, outer = 6;  ///< radii of the domain, cells
  double interval = 0;          ///< between two looks, s
  Mixity mixity = Mixity::interaction;
  Form form = Form::domain;
  std::vector<bool> loaded;  ///< by number of a particle: a load acts on it; empty: none does
};

}  // namespace crampon
