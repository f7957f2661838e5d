#include "crampon/step/tip_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "crampon/geometry/segment.hpp"

namespace crampon {

namespace {

/// Distance from a tip to the nearest place where the body does not fill space: its particles are dealt to a lattice about the tip, of which a node
/// that lies inside gets the area of a cell.
double distance_to_edge(const State<2>& state, const Model<2>& model, const Vec<2>& tip, std::uint32_t material, const TipWatch& watch,
                        double radius) {
  constexpr double full = 0.85;  // a node on a straight edge has a half, one that is .45 cells inside of it has this much
  const double h = model.grid.largest_cell();
  const int reach = static_cast<int>(std::ceil(radius / h)) + 1, side = 2 * reach + 1;
  std::vector<double> filled(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (const WatchedParticle& w : watch.particles) {
    if (!belong_together(model, w.material, material)) continue;
    const Vec<2> y = (state.particles.original[w.slot] - tip) * (1 / h);
    const int i = static_cast<int>(std::floor(y[0])), j = static_cast<int>(std::floor(y[1]));
    const double area = state.particles.volume(w.slot) / model.materials[w.material].thickness / (h * h);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        const int m = i + a + reach, n = j + b + reach;
        if (m < 0 || n < 0 || m >= side || n >= side) continue;
        filled[static_cast<std::size_t>(n * side + m)] += area * (1 - std::fabs(y[0] - (i + a))) * (1 - std::fabs(y[1] - (j + b)));
      }
    }
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (int n = -reach; n <= reach; ++n) {
    for (int m = -reach; m <= reach; ++m) {
      if (filled[static_cast<std::size_t>((n + reach) * side + m + reach)] < full) nearest = std::fmin(nearest, h * std::hypot(m, n));
    }
  }
  return nearest;
}

/// Distance from a tip to other cracks, and to parts of its own to which the path comes back.
double distance_to_cracks(const State<2>& state, const CrackTip& tip, const Vec<2>& x, double radius) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const TipVertices vertices(crack, tip);
    bool left = c != tip.crack;  // the path has left the domain
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const Vec<2>&a = crack.original[vertices[k]], &b = crack.original[vertices[k + 1]];
      if (left) nearest = std::fmin(nearest, distance_to_segment(x, a, b));
      left = left || norm(b - x) >= radius;
    }
  }
  return nearest;
}

double distance_to_tips(const State<2>& state, const CrackTip& tip, const Vec<2>& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const CrackTip& other : state.fracture.tips) {
    if (other.status == TipStatus::unborn || (other.crack == tip.crack && other.end == tip.end)) continue;
    const Crack<2>& crack = state.cracks.list[other.crack];
    nearest = std::fmin(nearest, norm(crack.original[TipVertices(crack, other)[0]] - x));
  }
  return nearest;
}

/// Distance from a tip to the nearest particle on which a load acts, and to the nearest node with a prescribed velocity, less the cell that such a node
/// reaches: what they do to the material is not in its stress.
double distance_to_loads(const State<2>& state, const Model<2>& model, const CrackTip& tip, const Vec<2>& x, const TipWatch& watch) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const WatchedParticle& w : watch.particles) {
    if (model.fracture.loaded.empty()) break;
    if (model.fracture.loaded[state.particles.id[w.slot]]) nearest = std::fmin(nearest, norm(state.particles.original[w.slot] - x));
  }
  const Vec<2> present = present_frame(model, state.cracks.list[tip.crack], tip).tip;
  const double reach = model.grid.largest_cell();
  for (const VelocityCondition<2>& condition : model.conditions) {
    if (condition.symmetry || state.clock.time < condition.start || state.clock.time > condition.end) continue;
    for (const std::int64_t node : condition.nodes) {
      const double d = norm(model.grid.node_position(model.grid.node_coordinates(node)) - present);
      nearest = std::fmin(nearest, std::fmax(d - reach, 0));
    }
  }
  return nearest;
}

}  // namespace

std::optional<std::uint32_t> material_at_tip(const State<2>& state, const Model<2>& model, const Vec<2>& tip, const TipWatch& watch) {
  double least = std::numeric_limits<double>::infinity();
  std::optional<std::uint32_t> nearest;
  for (const WatchedParticle& w : watch.particles) {
    if (model.ignores_cracks(model.materials[w.material].field)) continue;
    const double d = norm(state.particles.original[w.slot] - tip);
    if (d < least) least = d, nearest = w.material;
  }
  if (least > model.grid.largest_cell()) return std::nullopt;
  return nearest;
}

bool belong_together(const Model<2>& model, std::uint32_t a, std::uint32_t b) {
  const auto& fields = model.contact.fields;
  return fields[model.materials[a].field].bonded_to == fields[model.materials[b].field].bonded_to;
}

TipRoom find_room(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch) {
  const double h = model.grid.largest_cell();
  const Vec<2> x = original_frame(model, state.cracks.list[tip.crack], tip).tip;
  const auto material = material_at_tip(state, model, x, watch);
  if (!material) return {0, NoParameter::outside};
  TipRoom room{model.fracture.outer * h, NoParameter::none};
  const auto bound = [&](double distance, NoParameter by) {
    if (distance < room.radius) room = {distance, by};
  };
  bound(distance_to_tips(state, tip, x), NoParameter::tip);
  bound(distance_to_cracks(state, tip, x, model.fracture.outer * h), NoParameter::crack);
  bound(distance_to_loads(state, model, tip, x, watch), NoParameter::load);
  bound(distance_to_edge(state, model, x, *material, watch, model.fracture.outer * h), NoParameter::edge);
  return room;
}

}  // namespace crampon
