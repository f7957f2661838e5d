#include "crampon/input/value_reader.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/core/units.hpp"
#include "crampon/input/function_table.hpp"
#include "crampon/input/toml_source.hpp"

namespace crampon {
namespace {

using Kind = Entry::Kind;

class ValueReader {
 public:
  ValueReader(ReadContext& context, const Entry& entry, std::string unit, std::map<std::string, Location>& places)
      : context_(context), entry_(entry), unit_(std::move(unit)), places_(places) {}

  std::optional<EntryValue> read(const toml::node& node, const std::string& where) {
    switch (entry_.kind) {
      case Kind::quantity:
        return wrap(quantity(node, where));
      case Kind::integer:
        return wrap(integer(node, where));
      case Kind::flag:
        return wrap(flag(node, where));
      case Kind::text:
        return wrap(text(node, where));
      case Kind::choice:
        return wrap(choice(node, where));
      case Kind::function:
        return wrap(function(node, where));
      case Kind::quantities:
        return wrap(numbers(node, where));
      case Kind::integers:
        return wrap(list<std::int64_t>(node, where, entry_.length, [&](const auto& n, const auto& w) { return integer(n, w); }));
      case Kind::texts:
        return wrap(list<std::string>(node, where, entry_.length, [&](const auto& n, const auto& w) { return text(n, w); }));
      case Kind::functions:
        return wrap(list<ValueFunction>(node, where, entry_.length, [&](const auto& n, const auto& w) { return function(n, w); }));
      case Kind::points:
        return wrap(list<std::vector<double>>(node, where, Length{}, [&](const auto& n, const auto& w) { return numbers(n, w); }));
      default:
        throw std::logic_error("entry " + entry_.key + " is not plain");
    }
  }

 private:
  ReadContext& context_;
  const Entry& entry_;
  std::string unit_;
  std::map<std::string, Location>& places_;

  template <class V>
  static std::optional<EntryValue> wrap(std::optional<V> value) {
    return value ? std::optional<EntryValue>(EntryValue(std::move(*value))) : std::nullopt;
  }

  std::nullopt_t complain(const toml::node& node, const std::string& where, std::string what, std::string why, std::string remedy) {
    context_.diagnostics.add(locate(node.source(), where), std::move(what), std::move(why), std::move(remedy));
    return std::nullopt;
  }
  std::nullopt_t wrong_type(const toml::node& node, const std::string& where, const std::string& expected, const std::string& example) {
    return complain(node, where, fmt::format("{} where {} is expected", describe_type(node), expected), entry_.help,
                    fmt::format("write for example {}", example));
  }

  std::string expected_quantity() const {
    return unit_ == "1" ? "a number" : unit_ == "any" ? "a quantity" : fmt::format("a {} in {}", dimension_name(unit_), unit_);
  }
  std::string example() const { return unit_ == "1" || unit_ == "any" ? "2.5" : fmt::format("2.5 (in {}) or \"2.5 {}\"", unit_, unit_); }

  std::optional<double> quantity(const toml::node& node, const std::string& where) {
    double value = 0;
    if (const auto* number = node.as_floating_point()) {
      value = number->get();
    } else if (const auto* whole = node.as_integer()) {
      value = static_cast<double>(whole->get());
    } else if (const auto* words = node.as_string()) {
      try {
        value = parse_quantity(words->get(), unit_);
        if (unit_ == "any") context_.written[where] = words->get();
      } catch (const UnitError& error) {
        return complain(node, where, error.what, error.why, error.remedy);
      }
    } else {
      return wrong_type(node, where, expected_quantity(), example());
    }
    return in_bounds(node, where, value) ? std::optional<double>(value) : std::nullopt;
  }

  // Masses, energies and areas are products of up to three numbers of the input.
  static bool is_computable(double value) { return value == 0 || (std::abs(value) >= 1e-100 && std::abs(value) <= 1e100); }

  bool in_bounds(const toml::node& node, const std::string& where, double value) {
    const bool physical = unit_ != "1" && unit_ != "any";
    const std::string shown_unit = physical ? " " + unit_ : "";
    if (entry_.bounds.contains(value)) {
      if (!physical || !std::isfinite(value) || is_computable(value)) return true;
      complain(node, where, fmt::format("{}{} cannot be computed with", value, shown_unit),
               "products of numbers below 1e-100 or above 1e100 are lost",
               entry_.bounds.infinite ? "correct it; inf stands for no limit" : "correct it");
      return false;
    }
    if (!std::isfinite(value)) {
      complain(node, where, fmt::format("{} is not a usable value", std::isnan(value) ? "nan" : "inf"), "a finite number is needed",
               fmt::format("write for example {}", example()));
    } else {
      complain(node, where, fmt::format("{}{} is out of bounds", value, shown_unit), entry_.help,
               fmt::format("it must be {}{}", entry_.bounds.text(), shown_unit));
    }
    return false;
  }

  std::optional<std::int64_t> integer(const toml::node& node, const std::string& where) {
    const auto* number = node.as_integer();
    if (!number) return wrong_type(node, where, "a whole number", "2");
    if (!in_bounds(node, where, static_cast<double>(number->get()))) return std::nullopt;
    return number->get();
  }

  std::optional<bool> flag(const toml::node& node, const std::string& where) {
    if (const auto* value = node.as_boolean()) return value->get();
    return wrong_type(node, where, "true or false", "true");
  }

  std::optional<std::string> text(const toml::node& node, const std::string& where) {
    const auto* words = node.as_string();
    if (!words) return wrong_type(node, where, "text", "\"left\"");
    const std::string& value = words->get();
    if (entry_.name) {
      const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == ' ' || c >= 0x80; };
      if (value.empty() || !std::all_of(value.begin(), value.end(), allowed))
        return complain(node, where, fmt::format("{} is no name", toml_shown(value)), "names become file names and column headers",
                        "use letters, digits, \"_\", \"-\" and blanks");
    }
    if (entry_.file) {
      std::error_code error;
      const std::string path = resolve_path(context_, value);
      if (!std::filesystem::is_regular_file(path, error))
        return complain(node, where, fmt::format("there is no file {}", toml_shown(value)), fmt::format("looked for {}", path),
                        "correct the path; it is relative to the input file");
    }
    return value;
  }

  std::optional<std::string> choice(const toml::node& node, const std::string& where) {
    const auto* words = node.as_string();
    if (!words) return wrong_type(node, where, "a word", "\"" + entry_.choices.front() + "\"");
    if (std::find(entry_.choices.begin(), entry_.choices.end(), words->get()) != entry_.choices.end()) return words->get();
    return complain(node, where, fmt::format("{} is not one of the choices", toml_shown(words->get())), entry_.help,
                    suggest_from(words->get(), entry_.choices));
  }

  std::optional<ValueFunction> function(const toml::node& node, const std::string& where) {
    if (const toml::table* table = node.as_table()) return read_function_table(context_, *table, unit_, where);
    const std::optional<double> value = quantity(node, where);
    return value ? std::optional(ValueFunction::constant(*value)) : std::nullopt;
  }

  std::optional<std::vector<double>> numbers(const toml::node& node, const std::string& where) {
    return list<double>(node, where, entry_.length, [&](const auto& n, const auto& w) { return quantity(n, w); });
  }

  // One value alone stands for a list of one where that is a possible length.
  bool alone(const toml::node& node, Length length) const {
    return entry_.kind != Kind::points && length.contains(1) &&
           (node.is_number() || node.is_string() || (entry_.kind == Kind::functions && node.is_table()));
  }

  template <class V, class ReadOne>
  std::optional<std::vector<V>> list(const toml::node& node, const std::string& where, Length length, ReadOne read_one) {
    const toml::array* array = node.as_array();
    if (!array && alone(node, length)) {
      const std::optional<V> value = read_one(node, where);
      return value ? std::optional(std::vector<V>{*value}) : std::nullopt;
    }
    if (!array)
      return wrong_type(node, where, entry_.kind != Kind::points && length.contains(1) ? "one value or an array" : "an array",
                        array_example());
    if (!length.contains(array->size()))
      return complain(node, where,
                      fmt::format("{} value{} where {} {} expected", array->size(), array->size() == 1 ? "" : "s", length.text(),
                                  length.most == 1 ? "is" : "are"),
                      entry_.help, fmt::format("write for example {}", array_example()));
    std::vector<V> values;
    bool good = true;
    for (std::size_t k = 0; k < array->size(); ++k) {
      const std::string element = fmt::format("{}[{}]", where, k);
      const std::optional<V> value = read_one(*array->get(k), element);
      good = good && value;
      if (value) values.push_back(*value);
      if (!where.ends_with(']'))  // an element, not the coordinate of a point
        places_[fmt::format("{}[{}]", entry_.key, k)] = locate(array->get(k)->source(), element);
    }
    return good ? std::optional(std::move(values)) : std::nullopt;
  }

  std::string array_example() const {
    const std::size_t size = entry_.length.contains(2) || entry_.kind == Kind::points
                                 ? 2
                                 : std::max<std::size_t>(1, std::min<std::size_t>(3, entry_.length.least));
    std::string one = entry_.kind == Kind::integers ? "2"
                      : entry_.kind == Kind::texts  ? "\"a\""
                      : unit_ == "1"                ? "2.5"
                                                    : "\"2.5 " + unit_ + "\"";
    std::string out = one;
    for (std::size_t k = 1; k < size; ++k) out += ", " + one;
    return entry_.kind == Kind::points ? fmt::format("[[{}], [{}]]", out, out) : "[" + out + "]";
  }

  static std::string toml_shown(const std::string& value) {
    std::string out;
    for (const char c : value.substr(0, 60)) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    return "\"" + out + (value.size() > 60 ? "..." : "") + "\"";
  }
};

}  // namespace

std::optional<EntryValue> read_value(ReadContext& context, const Entry& entry, const std::string& unit, const toml::node& node,
                                     const std::string& where, std::map<std::string, Location>& places) {
  return ValueReader(context, entry, unit, places).read(node, where);
}

std::string resolve_path(const ReadContext& context, const std::string& path) {
  const std::filesystem::path given(path);
  return given.is_absolute() ? given.string() : (std::filesystem::path(context.directory) / given).lexically_normal().string();
}

}  // namespace crampon
