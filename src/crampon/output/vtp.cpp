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
constexpr const char* bodies_name = "body_names";
constexpr const char *start_name = "rigid_start", *centre_name = "rigid_centre", *turn_name = "rigid_turn";

// Labels must survive single precision, which holds whole numbers only up to 2^24.
bool is_label(const DataArray& field) {
  static constexpr std::array<std::string_view, 6> names{"id", "body", "material", "node", "velocity_field", "crack"};
  if (std::find(names.begin(), names.end(), field.name) == names.end()) return false;
  if (field.values.type() == NumberType::int32 || field.values.type() == NumberType::int64) return true;
  for (const double v : field.values)
    if (!(std::trunc(v) == v && std::abs(v) < 9e15)) return false;
  return true;
}

DataArray real_array(const char* name, const char* unit, int components, Numbers&& values, Precision precision) {
  return {name, unit, components, std::move(values).as(real_type(precision))};
}

DataArray typed(DataArray&& field, Precision precision) {
  const NumberType type = is_label(field) ? NumberType::int64 : real_type(precision);
  field.values = std::move(field.values).as(type);
  return std::move(field);
}

DataArray real_scalar(const char* name, const char* unit, double value) { return {name, unit, 1, {value}}; }
DataArray whole_scalar(const char* name, double value) { return {name, "", 1, Numbers{value}.as(NumberType::int64)}; }

// Where rigid bodies and walls are, a row of each array for each.
template <std::size_t Count, class Member>
DataArray rigid_array(const char* name, const char* unit, const std::vector<RigidPlace>& places, Member member) {
  DataArray field{name, unit, static_cast<int>(Count), {}};
  for (const RigidPlace& place : places)
    for (const double v : place.*member) field.values.push_back(v);
  return field;
}

template <class Member>
void read_rigid(const PolyData& data, std::string_view name, std::vector<RigidPlace>& places, Member member) {
  for (const DataArray& a : data.field_data) {
    if (a.name != name) continue;
    const std::size_t length = (RigidPlace{}.*member).size();
    if (a.values.size() % length != 0 || (!places.empty() && places.size() != a.values.size() / length))
      throw std::runtime_error("damaged file: places of rigid bodies do not fit together");
    places.resize(a.values.size() / length);
    for (std::size_t r = 0; r < places.size(); ++r) a.values.copy(r * length, length, (places[r].*member).data());
  }
}

double scalar(const PolyData& data, std::string_view name) {
  for (const DataArray& a : data.field_data)
    if (a.name == name && !a.values.empty()) return a.values[0];
  throw std::runtime_error(fmt::format("it holds no {}; it is not a file of the expected kind", name));
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
  read_rigid(data, start_name, frame.rigid, &RigidPlace::start);
  read_rigid(data, centre_name, frame.rigid, &RigidPlace::centre);
  read_rigid(data, turn_name, frame.rigid, &RigidPlace::turn);
  frame.positions = std::move(data.points.values);
  if (data.string_name == bodies_name) frame.body_names = std::move(data.strings);
  for (DataArray& a : data.point_data) {
    if (a.name == size_name)
      frame.particle_size = std::move(a.values);
    else
      frame.fields.push_back(std::move(a));
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
  if (data.line_ends.size() != 3 * frame.names.size() || data.points.values.size() != 9 * vertices)
    throw std::runtime_error("damaged file: cracks and lines do not fit together");
  for (std::size_t k = 0; k < frame.names.size(); ++k) frame.begin.push_back(static_cast<std::int64_t>(data.line_ends[k]));
  if (!std::is_sorted(frame.begin.begin(), frame.begin.end()) || frame.begin.back() != static_cast<std::int64_t>(vertices))
    throw std::runtime_error("damaged file: cracks and vertices do not fit together");
  const auto third = [&](const Numbers& all, std::size_t part, std::size_t components) {
    std::vector<double> values(vertices * components);
    all.copy(part * values.size(), values.size(), values.data());
    return values;
  };
  frame.plane = third(data.points.values, 0, 3);
  frame.upper = third(data.points.values, 1, 3);
  frame.lower = third(data.points.values, 2, 3);
  for (DataArray& a : data.point_data) {
    std::vector<double> values = third(a.values, 0, static_cast<std::size_t>(a.components));
    if (a.name == original_name)
      frame.original = std::move(values);
    else
      frame.fields.push_back({a.name, a.unit, a.components, std::move(values)});
  }
  return frame;
}

}  // namespace

void write_vtp(const std::filesystem::path& path, PointFrame frame, Precision precision) {
  PolyData data;
  data.field_data = {real_scalar("TimeValue", "s", frame.time), whole_scalar("step", static_cast<double>(frame.step)),
                     whole_scalar("dimension", frame.dimension), real_scalar("cell", "m", frame.cell)};
  if (!frame.rigid.empty()) {
    data.field_data.push_back(rigid_array<3>(start_name, "m", frame.rigid, &RigidPlace::start));
    data.field_data.push_back(rigid_array<3>(centre_name, "m", frame.rigid, &RigidPlace::centre));
    data.field_data.push_back(rigid_array<9>(turn_name, "", frame.rigid, &RigidPlace::turn));
  }
  if (!frame.body_names.empty()) {
    data.string_name = bodies_name;
    data.strings = std::move(frame.body_names);
  }
  data.vertices = frame.positions.size() / 3;
  data.points = real_array("Points", "m", 3, std::move(frame.positions), precision);
  for (DataArray& field : frame.fields) data.point_data.push_back(typed(std::move(field), precision));
  if (!frame.particle_size.empty()) data.point_data.push_back(real_array(size_name, "m", 3, std::move(frame.particle_size), precision));
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
  std::vector<double> points = std::move(frame.plane);
  points.insert(points.end(), frame.upper.begin(), frame.upper.end());
  points.insert(points.end(), frame.lower.begin(), frame.lower.end());
  data.points = real_array("Points", "m", 3, std::move(points), precision);
  const auto add_thrice = [&](DataArray&& field) {
    const std::vector<double> once = field.values.doubles();
    std::vector<double> thrice;
    for (int k = 0; k < 3; ++k) thrice.insert(thrice.end(), once.begin(), once.end());
    field.values = std::move(thrice);
    data.point_data.push_back(typed(std::move(field), precision));
  };
  for (DataArray& field : frame.fields) add_thrice(std::move(field));
  if (!frame.original.empty()) add_thrice({original_name, "m", 3, std::move(frame.original)});
  DataArray crack{"crack", "", 1, Numbers(NumberType::int32)}, surface{"surface", "", 1, Numbers(NumberType::int32)};
  for (std::size_t part = 0; part < 3; ++part) {
    for (std::size_t k = 0; k < cracks; ++k) {
      data.line_ends.push_back(static_cast<double>(part * vertices) + static_cast<double>(frame.begin[k + 1]));
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
