#include "crampon/core/units.hpp"

#include <array>
#include <charconv>
#include <clocale>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <udunits2.h>

namespace crampon {
namespace {

struct Dimension {
  const char* unit;
  const char* name;
  const char* example;
};
// Coherent SI units with the name that error messages use. The first convertible one decides for "any".
constexpr Dimension dimensions[] = {
    {"1", "a pure number", "1"},
    {"m", "a length", "mm"},
    {"s", "a time", "ms"},
    {"kg", "a mass", "g"},
    {"m/s", "a velocity", "m/s"},
    {"m/s2", "an acceleration", "m/s2"},
    {"N", "a force", "N"},
    {"Pa", "a pressure", "MPa"},
    {"kg/m3", "a density", "kg/m3"},
    {"1/s", "a rate", "1/s"},
    {"rad", "an angle", "deg"},
    {"rad/s", "an angular velocity", "rad/s"},
    {"J", "an energy", "J"},
    {"kg m/s", "a momentum", "kg m/s"},
    {"J/m2", "an energy per area", "J/m2"},
    {"m2", "an area", "mm2"},
    {"m3", "a volume", "mm3"},
    {"Pa*m^0.5", "a toughness", "MPa*sqrt(m)"},
    {"Pa*s", "a viscosity", "Pa s"},
    {"W", "a power", "W"},
    {"Pa/m", "a stiffness per area", "MPa/mm"},
    {"kg m2/s", "an angular momentum", "kg m2/s"},
    {"K", "a temperature", "K"},
};

const Dimension* find_dimension(const std::string& unit) {
  for (const Dimension& d : dimensions)
    if (unit == d.unit) return &d;
  return nullptr;
}

// udunits2 reads numbers by strtod, also in its own database.
class ClassicNumbers {
 public:
  ClassicNumbers() : classic_(newlocale(LC_NUMERIC_MASK, "C", locale_t{})), before_(uselocale(classic_)) {}
  ~ClassicNumbers() {
    uselocale(before_);
    freelocale(classic_);
  }
  ClassicNumbers(const ClassicNumbers&) = delete;
  ClassicNumbers& operator=(const ClassicNumbers&) = delete;

 private:
  locale_t classic_, before_;
};

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

// udunits2 keeps global state (its error code): callers hold `mutex`.
std::mutex mutex;

ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* const read = ut_read_xml(nullptr);
    if (read) {  // udunits2 knows the degree by its full name only
      ut_unit* const degree = ut_parse(read, "arc_degree", UT_ASCII);
      ut_map_name_to_unit("deg", UT_ASCII, degree);
      ut_free(degree);
    }
    return read;
  }();
  if (!system) throw std::runtime_error("the unit database of udunits2 is missing; install libudunits2-data");
  return system;
}

Unit parse_plain(const std::string& text) { return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8)); }

// The square of a unit expression, so that half powers stay within udunits2's integer exponents:
// product := factor { ("*" | "/" | " " | ".") factor };  factor := (name | "(" product ")" | "sqrt(" product ")") [["^"] exponent]
class SquareParser {
 public:
  explicit SquareParser(std::string_view text) : text_(text) {}
  Unit parse() {
    Unit unit = product(2);
    return position_ == text_.size() ? std::move(unit) : nullptr;
  }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  int depth_ = 0;

  char peek() const { return position_ < text_.size() ? text_[position_] : '\0'; }
  void skip_spaces() {
    while (peek() == ' ') ++position_;
  }
  bool take(std::string_view word) {
    if (!text_.substr(position_).starts_with(word)) return false;
    position_ += word.size();
    return true;
  }
  static Unit raise(Unit unit, double power) {
    if (!unit || power != std::round(power) || std::abs(power) > 100) return nullptr;
    return Unit(ut_raise(unit.get(), static_cast<int>(power)));
  }

  // Every name is raised to `power` times its own exponent.
  Unit product(double power) {
    Unit result = factor(power);
    while (result) {
      skip_spaces();
      const bool divide = take("/");
      if (!divide && !take("*") && !take(".") && (peek() == '\0' || peek() == ')')) break;
      skip_spaces();
      Unit next = factor(divide ? -power : power);
      if (!next) return nullptr;
      result = Unit(ut_multiply(result.get(), next.get()));
    }
    return result;
  }

  Unit factor(double power) {
    skip_spaces();
    if (take("sqrt(")) return group(power / 2);
    if (take("(")) return group(power);
    const std::size_t begin = position_;
    while (std::isalpha(static_cast<unsigned char>(peek())) || (peek() & 0x80) || peek() == '_' || peek() == '%') ++position_;
    const std::string name(text_.substr(begin, position_ - begin));
    const std::optional<double> exponent = read_exponent();
    if (!exponent) return nullptr;
    if (name.empty()) return take("1") ? Unit(ut_get_dimensionless_unit_one(unit_system())) : nullptr;
    return raise(parse_plain(name), power * *exponent);
  }

  Unit group(double power) {
    if (++depth_ > 50) return nullptr;
    // The exponent stands behind the group but is needed inside it: look ahead to the closing parenthesis.
    std::size_t end = position_;
    for (int open = 1; end < text_.size(); ++end) {
      open += text_[end] == '(' ? 1 : text_[end] == ')' ? -1 : 0;
      if (open == 0) break;
    }
    const std::size_t inside = position_;
    position_ = std::min(end + 1, text_.size());
    const std::optional<double> exponent = read_exponent();
    const std::size_t after = position_;
    if (!exponent) return nullptr;
    position_ = inside;
    Unit unit = product(power * *exponent);
    if (position_ != end || !take(")")) return nullptr;
    position_ = after;
    --depth_;
    return unit;
  }

  // 1 when there is none; nothing when "^" is followed by no number.
  std::optional<double> read_exponent() {
    const bool caret = take("^") || take("**");
    const bool bracket = caret && take("(");
    std::size_t begin = position_;
    const auto number = [&]() -> std::optional<double> {
      double value = 0;
      const auto [end, error] = std::from_chars(text_.data() + position_, text_.data() + text_.size(), value, std::chars_format::fixed);
      if (error != std::errc()) return std::nullopt;
      position_ = static_cast<std::size_t>(end - text_.data());
      return value;
    };
    if (!caret && text_.substr(0, begin).empty()) return 1.;
    if (!caret && begin > 0 && !(std::isalpha(static_cast<unsigned char>(text_[begin - 1])) || text_[begin - 1] == ')')) return 1.;
    std::optional<double> value = number();
    if (!value) return caret ? std::nullopt : std::optional<double>(1.);
    if (bracket && take("/")) {
      const std::optional<double> below = number();
      if (!below || *below == 0) return std::nullopt;
      *value /= *below;
    }
    if (bracket && !take(")")) return std::nullopt;
    return value;
  }
};

bool has_half_powers(const std::string& unit) {
  if (unit.find("sqrt") != std::string::npos) return true;
  const std::size_t caret = unit.find('^');
  return caret != std::string::npos && unit.find_first_of("./", caret) != std::string::npos;
}

// value_SI = scale * value + offset
struct Conversion {
  double scale = 1, offset = 0;
};

enum class Failure { none, unknown, dimension };
struct Outcome {
  Failure failure = Failure::none;
  Conversion conversion;
};

Outcome find_conversion(const std::string& unit, const std::string& si_unit) {
  const bool squares = has_half_powers(unit) || has_half_powers(si_unit);
  const Unit from = squares ? SquareParser(unit).parse() : parse_plain(unit);
  if (!from) return {Failure::unknown, {}};
  const Unit to = squares ? SquareParser(si_unit).parse() : parse_plain(si_unit);
  if (!to) throw std::logic_error("no such SI unit: " + si_unit);
  // ut_are_convertible also accepts reciprocals (s and Hz), which is no unit conversion of a quantity.
  const Unit ratio(ut_divide(from.get(), to.get()));
  const Unit one(ut_get_dimensionless_unit_one(unit_system()));
  if (!ut_are_convertible(from.get(), to.get()) || !ratio || !ut_are_convertible(ratio.get(), one.get())) return {Failure::dimension, {}};
  cv_converter* const converter = ut_get_converter(from.get(), to.get());
  if (!converter) return {Failure::dimension, {}};
  const double offset = cv_convert_double(converter, 0), scale = cv_convert_double(converter, 1) - offset;
  cv_free(converter);
  if (squares && (offset != 0 || !(scale > 0))) return {Failure::dimension, {}};
  if (offset != 0 && si_unit != "K") return {Failure::unknown, {}};  // "m since 2", "m @ 5"
  return {Failure::none, {squares ? std::sqrt(scale) : scale, offset}};
}

Conversion conversion_to(const std::string& unit, const std::string& si_unit, const std::string& shown) {
  const std::lock_guard lock(mutex);
  const ClassicNumbers classic;
  Outcome outcome;
  if (si_unit == "any") {
    outcome.failure = Failure::dimension;
    for (const Dimension& d : dimensions) {
      outcome = find_conversion(unit, d.unit);
      if (outcome.failure != Failure::dimension) break;
    }
  } else {
    outcome = find_conversion(unit, si_unit);
  }
  const Dimension* d = find_dimension(si_unit);
  const std::string expected = si_unit == "any" ? "a quantity" : d ? d->name : "a quantity in " + si_unit;
  const std::string remedy = si_unit == "any" ? "write the number in SI without unit"
                             : si_unit == "1" ? "write the number alone"
                                              : fmt::format("write it in {} or another unit of that dimension", d ? d->example : si_unit);
  if (outcome.failure == Failure::unknown)
    throw UnitError(fmt::format("\"{}\": unknown unit \"{}\"", shown, unit), expected + " is expected here", remedy);
  if (outcome.failure == Failure::dimension)
    throw UnitError(fmt::format("\"{}\" has the wrong dimension", shown), expected + " is expected here", remedy);
  return outcome.conversion;
}

// The exponent k when scale is 10^k, within the round-off that udunits2's products of factors accumulate.
std::optional<int> power_of_ten(double scale) {
  if (!(scale > 0)) return std::nullopt;
  const double k = std::round(std::log10(scale));
  if (std::abs(k) > 30 || std::abs(scale / std::pow(10., k) - 1) > 1e-14) return std::nullopt;
  return static_cast<int>(k);
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

// A printable, short form for messages.
std::string shown(const std::string& text) {
  std::string out = text.substr(0, 60);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text.size() > 60 ? out + "..." : out;
}

}  // namespace

double parse_quantity(const std::string& text, const std::string& si_unit) {
  const std::string t = trimmed(text);
  const std::size_t sign = t.starts_with('+') || t.starts_with('-') ? 1 : 0;
  const bool numeric = t.size() > sign && (std::isdigit(static_cast<unsigned char>(t[sign])) || t[sign] == '.');
  const char* const first = t.data() + (t.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto parsed = std::from_chars(first, t.data() + t.size(), value);
  const Dimension* d = find_dimension(si_unit);
  const std::string example = si_unit == "any" || si_unit == "1" ? "1.5" : fmt::format("1.5 {}", d ? d->example : si_unit);
  if (!numeric || parsed.ec == std::errc::invalid_argument)
    throw UnitError(fmt::format("\"{}\" does not start with a number", shown(text)), "a quantity is a number and a unit",
                    fmt::format("write it as \"{}\"", example));
  if (parsed.ec == std::errc::result_out_of_range)
    throw UnitError(fmt::format("\"{}\": the number does not fit", shown(text)), "numbers reach from 1e-307 to 1e308",
                    "write another number");
  const std::string number(first, parsed.ptr), unit = trimmed(std::string(parsed.ptr, t.data() + t.size()));
  if (unit.starts_with(','))
    throw UnitError(fmt::format("\"{}\" has a decimal comma", shown(text)), "numbers are written with a point",
                    fmt::format("write it as \"{}\"", example));
  if (unit.empty()) {
    if (si_unit == "1" || si_unit == "any") return value;
    throw UnitError(fmt::format("\"{}\" has no unit", shown(text)),
                    (d ? d->name : "a quantity in " + si_unit) + std::string(" is expected here"),
                    fmt::format("add the unit, or write the number without quotes when it is in {}", si_unit));
  }
  const Conversion c = conversion_to(shown(unit) == unit ? unit : shown(unit), si_unit, shown(text));
  if (c.offset != 0) return c.scale * value + c.offset;
  if (const auto k = power_of_ten(c.scale)) {
    // Shift the decimal exponent of the text: one rounding instead of two.
    const std::size_t e = number.find_first_of("eE");
    int exponent = *k;
    if (e != std::string::npos) {
      int own = 0;
      const char* digits = number.data() + e + 1 + (number[e + 1] == '+' ? 1 : 0);
      std::from_chars(digits, number.data() + number.size(), own);
      exponent += own;
    }
    const std::string shifted = number.substr(0, e) + "e" + std::to_string(exponent);
    double result = 0;
    if (std::from_chars(shifted.data(), shifted.data() + shifted.size(), result).ec == std::errc()) return result;
  }
  return c.scale * value;
}

double unit_factor(const std::string& unit, const std::string& si_unit) {
  const std::string t = trimmed(unit);
  const Conversion c = conversion_to(t.empty() ? "1" : t, si_unit, shown(unit));
  if (c.offset != 0) throw UnitError(fmt::format("\"{}\" has an offset", shown(unit)), "a unit that only scales is expected here", "use K");
  const auto k = power_of_ten(c.scale);
  if (!k) return c.scale;
  const std::string text = "1e" + std::to_string(*k);
  double factor = 1;
  std::from_chars(text.data(), text.data() + text.size(), factor);
  return factor;
}

std::string dimension_name(const std::string& si_unit) {
  const Dimension* d = find_dimension(si_unit);
  if (!d) return si_unit;
  const std::string name = d->name;
  return name.substr(name.find(' ') + 1);
}

}  // namespace crampon
