#include "crampon/picture/display_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "crampon/core/formula.hpp"

namespace crampon {
namespace {

constexpr std::array<const char*, 11> prefixes{"f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P"};
constexpr int no_prefix = 5;

// Largest multiple e of 3 with 10^e <= value, value > 0. Numbers that would round up to 1000 count as 1000.
int engineering_exponent(double value) { return 3 * static_cast<int>(std::floor(std::log10(value * (1 + 1e-12)) / 3)); }

std::string superscript(int exponent) {
  static constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[static_cast<std::size_t>(c - '0')];
  return out;
}

// "m2" is metres squared: what follows the first symbol tells whether a prefix scales the unit linearly.
bool takes_prefix(std::string_view unit) {
  for (const std::string_view symbol : {"Pa", "Hz", "kg", "m", "s", "N", "J", "W"}) {
    if (!unit.starts_with(symbol)) continue;
    const std::string_view rest = unit.substr(symbol.size());
    if (rest.empty() || rest.front() == '/' || rest.front() == ' ' || rest.front() == '.' || rest.front() == '*') return true;
  }
  return false;
}

// "m2/s2" as "m²/s²", "Pa m^(1/2)" as "Pa √m".
std::string pretty(std::string_view unit) {
  constexpr std::string_view root = "m^(1/2)";
  std::string out;
  if (const std::size_t at = unit.find(root); at != std::string_view::npos)
    return pretty(unit.substr(0, at)) + "√m" + pretty(unit.substr(at + root.size()));
  for (const char c : unit) {
    if (c >= '0' && c <= '9' && !out.empty())
      out += superscript(c - '0');
    else if (c == '*' || c == '.')
      out += "·";
    else
      out += c;
  }
  return out;
}

}  // namespace

DisplayScale display_scale(double largest, const std::string& unit) {
  const bool dimensionless = unit.empty() || unit == "1";
  const std::string plain = dimensionless ? "" : pretty(unit);
  if (!(largest > 0) || !std::isfinite(largest)) return {1, plain};
  int exponent = engineering_exponent(largest);
  if (!dimensionless && takes_prefix(unit)) {
    const bool kilogram = unit.starts_with("kg");
    if (kilogram) exponent += 3;  // prefixes go to the gram
    const int k = exponent / 3 + no_prefix;
    if (kilogram) exponent -= 3;
    if (k >= 0 && k < static_cast<int>(prefixes.size()))
      return {std::pow(10., exponent), prefixes[static_cast<std::size_t>(k)] + (kilogram ? plain.substr(1) : plain)};
  }
  if (exponent >= -3 && exponent <= 3 && largest >= 0.01 && largest < 1e4) return {1, plain};
  return {std::pow(10., exponent), "×10" + superscript(exponent) + (plain.empty() ? "" : " " + plain)};
}

std::string spelt_out(std::string name) {
  if (name == "von_mises") return "von Mises stress";
  // What is shown and what it is of: "J.notch.end". A formula of the user's may be called "1.5 times J".
  if (const std::size_t dot = name.find('.'); dot != std::string::npos && is_formula_name(name.substr(0, dot))) {
    std::string of = name.substr(dot + 1);
    std::replace(of.begin(), of.end(), '.', ' ');
    return spelt_out(name.substr(0, dot)) + ", " + spelt_out(of);
  }
  const bool is_symbol = name.size() > 1 && name[1] == '_';  // with an index
  if (!is_symbol) std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string label_with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name.empty() ? unit : fmt::format("{} ({})", name, unit);
}

Ticks round_ticks(double lowest, double highest, int most) {
  Ticks ticks;
  if (!(highest > lowest) || most < 1) return {1, {lowest}};
  const double raw = (highest - lowest) / most;
  const double decade = std::pow(10., std::floor(std::log10(raw)));
  const double mantissa = raw / decade;
  const double rounding = 1e-9;
  ticks.step = decade * (mantissa <= 1 + rounding ? 1 : mantissa <= 2 + rounding ? 2 : mantissa <= 5 + rounding ? 5 : 10);
  const double slack = rounding * (highest - lowest) / ticks.step;
  const double first = std::ceil(lowest / ticks.step - slack), last = std::floor(highest / ticks.step + slack);
  for (double k = first; k <= last; ++k) ticks.at.push_back(k * ticks.step);
  return ticks;
}

std::string tick_label(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos) text = fmt::format("{:.{}f}", 0., decimals);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

std::string quantity_text(double value, double largest, const std::string& unit) {
  const DisplayScale scale = display_scale(largest, unit);
  std::string text = fmt::format("{:.4g}", value / scale.factor);
  if (text.front() == '-') text.replace(0, 1, "−");
  return scale.unit.empty() ? text : text + " " + scale.unit;
}

}  // namespace crampon
