#pragma once
/// Numbers as people read them: engineering prefixes, round ticks, labels.

#include <string>
#include <vector>

namespace crampon {

/// A value in SI divided by `factor` is the number shown, in `unit` (UTF-8, "kPa", "µs", "×10⁻⁶ m²").
struct DisplayScale {
  double factor = 1;
  std::string unit;
};

/// The scale by which numbers up to largest (an absolute value, SI) read as 1 to 999.
/// Prefixes go to units that start with a linear m, s, N, Pa, J, W, Hz or kg; others, and what lies beyond all prefixes, get a power of ten.
DisplayScale display_scale(double largest, const std::string& unit);

/// A quantity's or a column's name as words: "stress xx", "von Mises stress", "crack length, notch", "K_I, notch end".
std::string spelt_out(std::string name);

/// "name (unit)", or the name alone without a unit.
std::string label_with_unit(const std::string& name, const std::string& unit);

/// Round positions (1, 2 or 5 times a power of ten apart) in [lowest, highest], at most `most` + 1 of them.
struct Ticks {
  double step = 1;
  std::vector<double> at;
};
Ticks round_ticks(double lowest, double highest, int most);

/// A tick's number with the digits its step needs.
std::string tick_label(double value, double step);

/// "1.25 ms": four significant digits, prefix chosen for `largest` so that a set of times shares one.
std::string quantity_text(double value, double largest, const std::string& unit);

}  // namespace crampon
