#pragma once
/// Quantities as text: "0.1 MPa" to SI, with the dimension checked (udunits2; fractional powers on top of it).

#include <stdexcept>
#include <string>

namespace crampon {

/// A text that is no quantity of the expected dimension, in the three parts of a Diagnostic.
class UnitError : public std::invalid_argument {
 public:
  UnitError(std::string what_, std::string why_, std::string remedy_)
      : std::invalid_argument(what_ + " (" + why_ + "); " + remedy_),
        what(std::move(what_)),
        why(std::move(why_)),
        remedy(std::move(remedy_)) {}
  std::string what, why, remedy;
};

/// "1.5 g/cm3", "30 1/s", "5 deg", "2.5 MPa*sqrt(m)", "2.5 MPa*m^0.5" in the coherent SI unit `si_unit` ("Pa", "1" for a pure
/// number, "any" for whatever dimension the text has). Where the units differ by a power of ten the result is the double
/// nearest to the decimal number, so that "18 mm" and 0.018 are the same bits. Independent of the locale. Throws UnitError.
double parse_quantity(const std::string& text, const std::string& si_unit);

/// Size of `unit` in `si_unit`. Throws UnitError, also for units with an offset such as degC.
double unit_factor(const std::string& unit, const std::string& si_unit);

/// "pressure" for "Pa"; the unit itself when it has no common name.
std::string dimension_name(const std::string& si_unit);

}  // namespace crampon
