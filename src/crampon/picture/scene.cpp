#include "crampon/picture/scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/output/crack_tips.hpp"

namespace crampon {
namespace {

using Point = std::array<double, 2>;

std::vector<Point> magnified(const std::vector<double>& at, const CrackFrame& frame, std::size_t from, std::size_t to, double factor) {
  if (factor != 1 && frame.original.size() != at.size())
    throw std::invalid_argument("magnified displacements need the original positions of the cracks, which these results do not hold");
  std::vector<Point> points;
  for (std::size_t v = from; v < to; ++v) {
    Point p{at[3 * v], at[3 * v + 1]};
    for (std::size_t k = 0; k < 2 && factor != 1; ++k) {
      const double start = frame.original[3 * v + k];
      p[k] = start + factor * (p[k] - start);
    }
    points.push_back(p);
  }
  return points;
}

void add_cracks(Scene& scene, const CrackFrame& c, const CrackFrame* start, double magnification) {
  for (std::size_t k = 0; k + 1 < c.begin.size(); ++k) {
    const auto from = static_cast<std::size_t>(c.begin[k]), to = static_cast<std::size_t>(c.begin[k + 1]);
    Scene::Surfaces& crack = scene.cracks.emplace_back();
    crack.upper = magnified(c.upper.empty() ? c.plane : c.upper, c, from, to, magnification);
    crack.lower = magnified(c.lower.empty() ? c.plane : c.lower, c, from, to, magnification);
    const auto before = vertices_before(c, k, start ? *start : c);
    if (before) crack.first_at_start = before->first - from, crack.last_at_start = before->second - from;
  }
  for (const FrameTip& tip : tips_of(c)) {
    if (!tip.is_in_body()) continue;
    const std::size_t first = tip.at_end ? tip.vertex - 1 : tip.vertex;
    const std::vector<Point> segment = magnified(c.plane, c, first, first + 2, magnification);
    const Point &at = segment[tip.at_end ? 1 : 0], &behind = segment[tip.at_end ? 0 : 1];
    scene.tips.push_back({at, {at[0] - behind[0], at[1] - behind[1]}, c.names[tip.crack] + " " + tip.end()});
  }
}

// Is a box no larger than the bodies, and near them? A ball that is a wall may be far larger than what it meets, or far away.
bool is_beside(const std::array<double, 4>& box, const std::array<double, 4>& bodies) {
  const double size = std::max(bodies[1] - bodies[0], bodies[3] - bodies[2]);
  if (!(std::max(box[1] - box[0], box[3] - box[2]) <= size)) return false;
  const double near = 0.3 * size;
  return box[0] < bodies[1] + near && box[1] > bodies[0] - near && box[2] < bodies[3] + near && box[3] > bodies[2] - near;
}

// Height of the section through walls in space: half way up the particles.
double middle_height(const std::vector<double>& heights) {
  double low = INFINITY, high = -INFINITY;
  for (const double z : heights) {
    if (!std::isfinite(z)) continue;
    low = std::min(low, z), high = std::max(high, z);
  }
  return low <= high ? 0.5 * (low + high) : 0;
}

}  // namespace

Scene make_scene(const Snapshot& snapshot, const DrawOptions& options, PointValues& quantity) {
  const PointFrame& frame = *snapshot.particles;
  Scene scene;
  scene.shapes = particle_shapes(frame, options.magnification);
  quantity = evaluate_quantity(frame, options.quantity, options.fringe_constant);
  scene.values = std::move(quantity.values);
  scene.time = frame.time;
  for (const DataArray& field : frame.fields) {
    if (field.name != "body" || field.components != 1) continue;
    for (const double b : field.values) scene.body.push_back(static_cast<int>(b));
  }
  for (std::size_t i = 0; i < frame.positions.size() / 3 && frame.dimension == 3; ++i) scene.height.push_back(frame.positions[3 * i + 2]);
  const double height = middle_height(scene.height);
  for (const RigidShape& rigid : snapshot.rigid) {
    const RigidView view(rigid, options.magnification, height);
    if (view.shows_an_edge()) scene.rigid.push_back({&rigid, view});
    if (rigid.body < 0) continue;
    const auto body = static_cast<std::size_t>(rigid.body);
    scene.rigid_body.resize(std::max(scene.rigid_body.size(), body + 1));
    scene.rigid_body[body] = true;
  }
  std::erase_if(scene.shapes, [&](const ParticleShape& s) { return scene.is_rigid(s.index); });
  if (snapshot.cracks) add_cracks(scene, *snapshot.cracks, snapshot.start, options.magnification);
  return scene;
}

PictureExtent extent_of(const Scene& scene) {
  PictureExtent e;
  for (const ParticleShape& s : scene.shapes) {
    const Point reach{std::abs(s.a[0]) + std::abs(s.b[0]), std::abs(s.a[1]) + std::abs(s.b[1])};
    e.include_place({s.centre[0] - reach[0], s.centre[0] + reach[0], s.centre[1] - reach[1], s.centre[1] + reach[1]});
  }
  for (std::size_t i = 0; i < scene.values.size(); ++i) {
    const double v = scene.values[i];
    if (!std::isfinite(v) || scene.is_rigid(i)) continue;
    e.lowest = std::min(e.lowest, v), e.highest = std::max(e.highest, v);
  }
  const std::array<double, 4> bodies = e.window;
  for (const Scene::Rigid& rigid : scene.rigid) {
    const auto box = rigid.view.bounds();
    const bool wall = rigid.shape->body < 0;
    if (box && (!wall || rigid.view.is_hollow() || is_beside(*box, bodies))) e.include_place(*box);
    e.walls = e.walls || wall;
  }
  e.tips = !scene.tips.empty();
  e.grown = std::any_of(scene.cracks.begin(), scene.cracks.end(), [](const Scene::Surfaces& crack) { return crack.has_grown(); });
  return e;
}

void PictureExtent::include_place(const std::array<double, 4>& box) {
  if (!std::isfinite(box[0] + box[1] + box[2] + box[3])) return;
  window = {std::min(window[0], box[0]), std::max(window[1], box[1]), std::min(window[2], box[2]), std::max(window[3], box[3])};
}

void PictureExtent::include(const PictureExtent& other) {
  include_place(other.window);
  lowest = std::min(lowest, other.lowest), highest = std::max(highest, other.highest);
  walls = walls || other.walls;
  tips = tips || other.tips;
  grown = grown || other.grown;
}

PictureExtent picture_extent(const Snapshot& snapshot, const DrawOptions& options) {
  PointValues quantity;
  return extent_of(make_scene(snapshot, options, quantity));
}

Categories::Categories(const std::vector<Snapshot>& snapshots, const std::vector<Scene>& scenes, const DrawOptions& options) {
  const PointFrame& first = *snapshots.front().particles;
  if (!is_category(first, options.quantity)) return;
  bodies_ = options.quantity == "body";
  const std::vector<std::string>& names = bodies_ && options.category_names.empty() ? first.body_names : options.category_names;
  std::map<double, bool> rigid;  // what the numbers stand for; those that are named come in any case
  for (std::size_t k = 0; k < names.size(); ++k)
    rigid[static_cast<double>(k)] = bodies_ && k < scenes[0].rigid_body.size() && scenes[0].rigid_body[k];
  for (const Scene& scene : scenes) {
    for (std::size_t i = 0; i < scene.values.size(); ++i)
      if (std::isfinite(scene.values[i])) rigid[scene.values[i]] = scene.is_rigid(i);
  }
  for (const auto& [value, is_rigid] : rigid) {
    const bool named = value >= 0 && value < static_cast<double>(names.size()) && !names[static_cast<std::size_t>(value)].empty();
    entry_of_[value] = add(named ? names[static_cast<std::size_t>(value)] : fmt::format("{:g}", value), is_rigid);
  }
  for (const Scene& scene : scenes) {
    for (const Scene::Rigid& wall : scene.rigid)
      if (bodies_ && wall.shape->body < 0) add(wall.shape->name, true);
  }
}

std::size_t Categories::add(const std::string& name, bool rigid) {
  for (std::size_t k = 0; k < entries_.size(); ++k)
    if (entries_[k].name == name) return k;
  // Rigid bodies are told apart where bodies are, not where materials are.
  entries_.push_back({name, rigid && !bodies_ ? rigid_colour : category_colour(coloured_++), rigid});
  return entries_.size() - 1;
}

Colour Categories::colour(double value) const {
  const auto found = entry_of_.find(value);
  return found == entry_of_.end() ? palette_colour(Palette::uniform, NAN) : entries_[found->second].colour;
}

Colour Categories::of_rigid(const RigidShape& rigid) const {
  for (const Entry& entry : entries_)
    if (bodies_ && entry.name == rigid.name) return entry.colour;
  return rigid_colour;
}

}  // namespace crampon
