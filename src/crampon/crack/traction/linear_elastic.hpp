#pragma once
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"

namespace crampon {

/// Springs that never fail.
struct LinearElasticTraction {
  double normal_stiffness = 0, shear_stiffness = 0;  ///< Pa/m

  using Input = LinearElasticTraction;
  static constexpr const char* name = "linear_elastic";
  static constexpr bool acts = true;
  static constexpr bool acts_closed = false;
  static constexpr bool from_outside = false;
  static LinearElasticTraction make(const Input& input) { return input; }
  static std::vector<LinearElasticTraction> examples();
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const;
  double largest_stiffness() const { return normal_stiffness > shear_stiffness ? normal_stiffness : shear_stiffness; }
  PerMode toughness() const;
  static const Declaration<LinearElasticTraction>& declaration();
};

}  // namespace crampon
