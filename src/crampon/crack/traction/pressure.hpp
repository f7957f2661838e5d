#pragma once
#include <optional>
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"

namespace crampon {

/// A fluid in the crack that pushes its faces apart: T = -p n, open or closed.
struct PressureTraction {
  ValueFunction pressure;             ///< p(t, x), Pa
  std::optional<double> min_opening;  ///< acts only at larger openings, m

  using Input = PressureTraction;
  static constexpr const char* name = "pressure";
  static constexpr bool acts = true;
  static constexpr bool acts_closed = true;
  static constexpr bool from_outside = true;
  static PressureTraction make(const Input& input) { return input; }
  static std::vector<PressureTraction> examples();
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const;
  double largest_stiffness() const { return 0; }
  PerMode toughness() const;
  static const Declaration<PressureTraction>& declaration();
};

}  // namespace crampon
