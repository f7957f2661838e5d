#include "crampon/output/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/output/stress_measures.hpp"

namespace crampon {
namespace {

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
constexpr std::array<std::string_view, 6> tensor_parts{"xx", "yy", "zz", "xy", "yz", "xz"};

const DataArray* find_field(const PointFrame& frame, std::string_view name) {
  for (const DataArray& field : frame.fields)
    if (field.name == name) return &field;
  return nullptr;
}

template <class Function>
std::vector<double> per_point(const DataArray& field, Function function) {
  const std::size_t n = static_cast<std::size_t>(field.components);
  std::vector<double> out(field.values.size() / n);
  std::vector<double> row(n);
  for (std::size_t i = 0; i < out.size(); ++i) {
    field.values.copy(i * n, n, row.data());
    out[i] = function(row.data());
  }
  return out;
}

std::vector<double> magnitude(const DataArray& field) {
  return per_point(field, [](const double* v) { return std::hypot(v[0], v[1], v[2]); });
}

std::optional<std::size_t> component_index(const DataArray& field, std::string_view part) {
  const auto index = [&](const auto& parts) -> std::optional<std::size_t> {
    const auto found = std::find(parts.begin(), parts.end(), part);
    if (found == parts.end()) return std::nullopt;
    return static_cast<std::size_t>(found - parts.begin());
  };
  if (field.components == 3) return index(axes);
  if (field.components == 6) return index(tensor_parts);
  return std::nullopt;
}

}  // namespace

PointValues evaluate_quantity(const PointFrame& frame, const std::string& name, double fringe_constant) {
  if (const DataArray* field = find_field(frame, name)) {
    if (field->components == 1) return {name, field->unit, field->values.doubles()};
    if (field->components == 3) return {name, field->unit, magnitude(*field)};
    if (field->components == 6) throw std::invalid_argument(fmt::format("\"{0}\" is a tensor; name a component, such as \"{0}_xx\"", name));
  }
  if (const std::size_t cut = name.rfind('_'); cut != std::string::npos) {
    const DataArray* field = find_field(frame, std::string_view(name).substr(0, cut));
    const std::string_view part = std::string_view(name).substr(cut + 1);
    if (field && field->components == 3 && part == "magnitude") return {name, field->unit, magnitude(*field)};
    if (field) {
      if (const auto k = component_index(*field, part))
        return {name, field->unit, per_point(*field, [&](const double* v) { return v[*k]; })};
    }
  }
  const DataArray* stress = find_field(frame, "stress");
  if (const StressMeasure* measure = find_stress_measure(name)) {
    if (!stress || stress->components != 6)
      throw std::invalid_argument(fmt::format("\"{}\" needs the field \"stress\", which these results do not hold", name));
    return {name, std::string(measure->unit), per_point(*stress, [&](const double* s) { return measure->of(s, fringe_constant); })};
  }
  throw std::invalid_argument(fmt::format("no quantity \"{}\"; {}", name, suggest_from(name, quantity_names(frame))));
}

bool is_category(const PointFrame& frame, const std::string& name) {
  const DataArray* field = find_field(frame, name);
  if (!field || field->components != 1 || name == "id") return false;
  const NumberType type = field->values.type();
  return name == "body" || name == "material" || type == NumberType::int32 || type == NumberType::int64;
}

std::vector<std::string> quantity_names(const PointFrame& frame) {
  std::vector<std::string> names;
  for (const DataArray& field : frame.fields) {
    if (field.components == 1 || field.components == 3) names.push_back(field.name);
    if (field.components == 3)
      for (const std::string_view part : axes) names.push_back(fmt::format("{}_{}", field.name, part));
    if (field.components == 6)
      for (const std::string_view part : tensor_parts) names.push_back(fmt::format("{}_{}", field.name, part));
  }
  if (const DataArray* stress = find_field(frame, "stress"); stress && stress->components == 6)
    for (const StressMeasure& measure : stress_measures()) names.emplace_back(measure.name);
  return names;
}

}  // namespace crampon
