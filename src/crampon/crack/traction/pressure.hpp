#pragma once
#include <optional>

#include "crampon/core/declaration.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"

namespace crampon {

/// A fluid in the crack that pushes its faces apart: T = -p n, open or closed.
struct PressureTraction {
  ValueFunction pressure;             ///< p(t, x), Pa
  std::optional<double> min_opening;  ///< acts only at larger openings, m

  static constexpr bool acts_closed = true;
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const;
  double largest_stiffness() const { return 0; }
  PerMode toughness() const;
  static const Declaration<PressureTraction>& declaration();
};

}  // namespace crampon
