#pragma once
/// Prescribed values in time and space: constants, tables and expressions.

#include <memory>
#include <string>
#include <vector>

#include "crampon/core/vector.hpp"

namespace crampon {

/// A scalar prescribed as a function of time t (s) and position x, y, z (m); value in SI.
/// Copies share nothing that evaluation changes: a copy may be used by another thread.
class ValueFunction {
 public:
  ValueFunction() = default;  ///< zero everywhere
  static ValueFunction constant(double value);
  /// Piecewise linear in time, constant outside the table. times strictly increasing; throws std::invalid_argument otherwise.
  static ValueFunction table(std::vector<double> times, std::vector<double> values);
  /// muParser expression of t, x, y, z and pi, in SI; `scale` multiplies the result (unit of the expression in SI).
  /// Throws std::invalid_argument with the parser's message and position.
  static ValueFunction expression(const std::string& text, double scale = 1);

  double operator()(double t, const Vec<3>& x) const;
  bool depends_on_position() const;
  bool depends_on_time() const;
  /// As a user would write it, in TOML and SI; reading it gives the same bits.
  std::string text() const;

 private:
  struct Expression;
  std::vector<double> times_, values_{0.};
  std::shared_ptr<const Expression> expression_;
};

}  // namespace crampon
