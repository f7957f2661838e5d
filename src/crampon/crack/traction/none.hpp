#pragma once
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"

namespace crampon {

/// The faces are free.
struct NoTraction {
  using Input = NoTraction;
  static constexpr const char* name = "none";
  static constexpr bool acts = false;
  static constexpr bool acts_closed = false;
  static constexpr bool from_outside = false;
  static NoTraction make(const Input& input) { return input; }
  static std::vector<NoTraction> examples() { return {NoTraction{}}; }
  Traction respond(const PerMode&, double, const Vec<3>&, TractionHistory&) const { return {}; }
  double largest_stiffness() const { return 0; }
  PerMode toughness() const { return {}; }

  static const Declaration<NoTraction>& declaration() {
    static const auto d = Declaration<NoTraction>(name, "No traction.");
    return d;
  }
};

}  // namespace crampon
