#include "crampon/output/vtp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "crampon/output/file.hpp"
#include "crampon/output/vtk_xml.hpp"

namespace crampon {
namespace {

constexpr const char* size_name = "particle_size";
constexpr const char* original_name = "original_position";
constexpr const char* names_name = "crack_names";

VtkType real_type(Precision precision) { return precision == Precision::full ? VtkType::float64 : VtkType::float32; }

// Labels must survive single precision, which holds whole numbers only up to 2^24.
bool is_label(const Field& field) {
  static constexpr std::array<std::string_view, 6> names{"id", "body", "material", "node", "velocity_field", "crack"};
  return std::find(names.begin(), names.end(), field.name) != names.end() &&
         std::all_of(field.values.begin(), field.values.end(), [](double v) { return std::trunc(v) == v && std::abs(v) < 9e15; });
}

VtkArray array_of(Field&& field, Precision precision) {
  const VtkType type = is_label(field) ? VtkType::int64 : real_type(precision);
  return {std::move(field.name), std::move(field.unit), field.components, type, std::move(field.values)};
}

Field field_of(VtkArray&& array) { return {std::move(array.name), std::move(array.unit), array.components, std::move(array.values)}; }

VtkArray real_scalar(const char* name, const char* unit, double value) { return {name, unit, 1, VtkType::float64, {value}}; }
VtkArray whole_scalar(const char* name, double value) { return {name, "", 1, VtkType::int64, {value}}; }

double scalar(const PolyData& data, std::string_view name) {
  for (const VtkArray& a : data.field_data)
    if (a.name == name && !a.values.empty()) return a.values[0];
  throw std::runtime_error(fmt::format("it holds no {}; it is not a file of the expected kind", name));
}

// fill = 0, 1, 2, ...
std::vector<double> counted(std::size_t n, double first) {
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = first + static_cast<double>(i);
  return out;
}

PolyData decode_file(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return decode_poly_data(bytes);
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::exception& e) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), e.what()));
}

PointFrame point_frame(PolyData&& data) {
  PointFrame frame;
  frame.time = scalar(data, "TimeValue");
  frame.step = static_cast<std::int64_t>(scalar(data, "step"));
  frame.dimension = static_cast<int>(scalar(data, "dimension"));
  frame.cell = scalar(data, "cell");
  frame.positions = std::move(data.points.values);
  for (VtkArray& a : data.point_data) {
    if (a.name == size_name)
      frame.particle_size = std::move(a.values);
    else
      frame.fields.push_back(field_of(std::move(a)));
  }
  return frame;
}

CrackFrame crack_frame(PolyData&& data) {
  CrackFrame frame;
  frame.time = scalar(data, "TimeValue");
  frame.step = static_cast<std::int64_t>(scalar(data, "step"));
  if (data.string_name != names_name) throw std::runtime_error("it holds no cracks; it is not a file of the expected kind");
  frame.names = std::move(data.strings);
  const std::size_t vertices = data.points.values.size() / 9;
  if (data.line_offsets.size() != 3 * frame.names.size() || data.points.values.size() != 9 * vertices)
    throw std::runtime_error("damaged file: cracks and lines do not fit together");
  for (std::size_t k = 0; k < frame.names.size(); ++k) frame.begin.push_back(static_cast<std::int64_t>(data.line_offsets[k]));
  if (!std::is_sorted(frame.begin.begin(), frame.begin.end()) || frame.begin.back() != static_cast<std::int64_t>(vertices))
    throw std::runtime_error("damaged file: cracks and vertices do not fit together");
  const auto third = [&](const std::vector<double>& all, std::size_t part, std::size_t components) {
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(part * vertices * components);
    return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(vertices * components));
  };
  frame.plane = third(data.points.values, 0, 3);
  frame.upper = third(data.points.values, 1, 3);
  frame.lower = third(data.points.values, 2, 3);
  for (VtkArray& a : data.point_data) {
    a.values = third(a.values, 0, static_cast<std::size_t>(a.components));
    if (a.name == original_name)
      frame.original = std::move(a.values);
    else
      frame.fields.push_back(field_of(std::move(a)));
  }
  return frame;
}

}  // namespace

void write_vtp(const std::filesystem::path& path, PointFrame frame, Precision precision) {
  PolyData data;
  data.field_data = {real_scalar("TimeValue", "s", frame.time), whole_scalar("step", static_cast<double>(frame.step)),
                     whole_scalar("dimension", frame.dimension), real_scalar("cell", "m", frame.cell)};
  const std::size_t points = frame.positions.size() / 3;
  data.points = {"Points", "m", 3, real_type(precision), std::move(frame.positions)};
  for (Field& field : frame.fields) data.point_data.push_back(array_of(std::move(field), precision));
  if (!frame.particle_size.empty()) data.point_data.push_back({size_name, "m", 3, real_type(precision), std::move(frame.particle_size)});
  data.vertex_connectivity = counted(points, 0);
  data.vertex_offsets = counted(points, 1);
  write_file(path, encode_poly_data(std::move(data)));
}

void write_vtp(const std::filesystem::path& path, CrackFrame frame, Precision precision) {
  const std::size_t cracks = frame.names.size(), vertices = frame.plane.size() / 3;
  if (frame.begin.size() != cracks + 1 || frame.begin.front() != 0 || frame.begin.back() != static_cast<std::int64_t>(vertices) ||
      frame.upper.size() != frame.plane.size() || frame.lower.size() != frame.plane.size() ||
      (!frame.original.empty() && frame.original.size() != frame.plane.size()))
    throw std::invalid_argument(fmt::format("{}: crack frame with parts that do not fit together", path.string()));
  PolyData data;
  data.field_data = {real_scalar("TimeValue", "s", frame.time), whole_scalar("step", static_cast<double>(frame.step))};
  data.string_name = names_name;
  data.strings = frame.names;
  data.points = {"Points", "m", 3, real_type(precision), frame.plane};
  data.points.values.insert(data.points.values.end(), frame.upper.begin(), frame.upper.end());
  data.points.values.insert(data.points.values.end(), frame.lower.begin(), frame.lower.end());
  const auto add_thrice = [&](VtkArray array) {
    const std::vector<double> once = array.values;
    for (int k = 0; k < 2; ++k) array.values.insert(array.values.end(), once.begin(), once.end());
    data.point_data.push_back(std::move(array));
  };
  for (Field& field : frame.fields) add_thrice(array_of(std::move(field), precision));
  if (!frame.original.empty()) add_thrice({original_name, "m", 3, real_type(precision), frame.original});
  VtkArray crack{"crack", "", 1, VtkType::int32, {}}, surface{"surface", "", 1, VtkType::int32, {}};
  data.line_connectivity = counted(3 * vertices, 0);
  for (std::size_t part = 0; part < 3; ++part) {
    for (std::size_t k = 0; k < cracks; ++k) {
      data.line_offsets.push_back(static_cast<double>(part * vertices) + static_cast<double>(frame.begin[k + 1]));
      crack.values.push_back(static_cast<double>(k));
      surface.values.push_back(static_cast<double>(part));
    }
  }
  data.cell_data = {std::move(crack), std::move(surface)};
  write_file(path, encode_poly_data(std::move(data)));
}

PointFrame read_vtp(const std::filesystem::path& path) {
  try {
    return point_frame(decode_file(path));
  } catch (const std::runtime_error& e) {
    if (std::string_view(e.what()).starts_with(path.string())) throw;
    fail(path, e);
  }
}

CrackFrame read_crack_vtp(const std::filesystem::path& path) {
  try {
    return crack_frame(decode_file(path));
  } catch (const std::runtime_error& e) {
    if (std::string_view(e.what()).starts_with(path.string())) throw;
    fail(path, e);
  }
}

}  // namespace crampon
