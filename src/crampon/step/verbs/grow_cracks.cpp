#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/step/carrier_choice.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/tip_samples.hpp"
#include "crampon/step/verbs.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {

namespace {

Vec<2> turned_left(const Vec<2>& a, double angle) {
  return {{a[0] * std::cos(angle) - a[1] * std::sin(angle), a[0] * std::sin(angle) + a[1] * std::cos(angle)}};
}
double angle_from(const Vec<2>& a, const Vec<2>& b) { return std::atan2(cross(a, b), dot(a, b)); }

/// What a tip is about to do.
struct Growth {
  double angle = 0;  ///< rad, to the left
  double speed = 0;  ///< m/s
};

double angle_of(const GrowthModel& growth, const GrowthCriterion& criterion, const TipState& now, const CrackTip& tip,
                const TipFrame& frame) {
  switch (growth.direction) {
    case GrowthDirection::criterion:
      return criterion.angle(now);
    case GrowthDirection::straight:
      return 0;
    case GrowthDirection::across_opening:
      return norm(now.opening) > 0 ? std::atan2(-now.opening[0], now.opening[1]) : 0.;
    case GrowthDirection::hoop_of_opening:
      return hoop_angle(std::fmax(now.opening[1], 0), now.opening[0]);
    case GrowthDirection::initial:
      return angle_from(frame.ahead, tip.initial);
    case GrowthDirection::given:
      return angle_from(frame.ahead, growth.along);
  }
  return 0;
}

/// Does the tip grow now? One that has lost its domain on the way, since an edge or a crack is near, goes straight on as it did.
std::optional<Growth> decide(const State<2>& state, const Model<2>& model, const CrackTip& tip, const GrowthModel& growth,
                             const TipState& now) {
  if (state.clock.time < growth.start) return std::nullopt;
  if (tip.now.no_J != NoParameter::none) {
    if (tip.status != TipStatus::grows) return std::nullopt;
    return Growth{0, tip.speed};
  }
  const double resistance = growth.resistance.at(tip.grown, tip.speed);
  const TipFrame frame = present_frame(model, state.cracks.list[tip.crack], tip);
  const auto asks = [&](const GrowthCriterion& criterion) -> std::optional<Growth> {
    if (criterion.needs_intensities() && !(now.K.I == now.K.I)) return std::nullopt;
    const double drive = criterion.drive(now) / resistance;
    if (!(drive >= 1)) return std::nullopt;
    Growth g{angle_of(growth, criterion, now, tip, frame), std::fmin(growth.largest_speed, criterion.speed(now))};
    if (growth.by_rate) g.speed = std::fmin(g.speed, growth.largest_speed * (1 - 1 / drive));
    if (!(g.speed > 1e-6 * growth.largest_speed)) return std::nullopt;
    return g;
  };
  if (auto g = asks(*growth.criterion)) return g;
  if (growth.alternate && !tip.fired) return asks(*growth.alternate);
  return std::nullopt;
}

/// Where the way from a to b first meets a crack, as a part of it; what the tip itself belongs to is left out.
double way_to_cracks(const State<2>& state, const CrackTip& tip, const Vec<2>& a, const Vec<2>& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    const Crack<2>& crack = state.cracks.list[c];
    const TipVertices vertices(crack, tip);
    for (std::size_t k = c == tip.crack ? 2 : 0; k + 1 < vertices.size(); ++k) {
      const Vec<2>&p = crack.plane[vertices[k]], &q = crack.plane[vertices[k + 1]];
      const Vec<2> way = b - a, along = q - p;
      const double det = cross(way, along);
      if (det == 0) continue;
      const double s = cross(p - a, along) / det, t = cross(p - a, way) / det;
      if (s >= 0 && s <= 1 && t >= 0 && t <= 1) nearest = std::fmin(nearest, s);
    }
  }
  return nearest;
}

/// Mass about a place over what a body at rest would have there: 1 inside, a half on a straight edge.
double filled(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, double density, double thickness) {
  double mass = 0;
  for (const PointNode<2>& node : PointFields<2>(work, model).nodes(x)) {
    const BlockLayers<2>& layers = work.nodes.layers[node.block];
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (model.ignores_cracks(layers.node[l].field)) continue;
      mass += node.S * work.nodes.momentum[layers.slot(l, node.local)][2];
    }
  }
  return mass / (density * model.grid.cell[0] * model.grid.cell[1] * thickness);
}

/// A vertex at an end of a crack, at x; what it needs more is left to choose_anew().
void add_vertex(Crack<2>& crack, const CrackTip& tip, const Vec<2>& x, std::vector<bool>& cracked) {
  const auto put = [&](auto& list, const auto& item) { list.insert(tip.end == 0 ? list.begin() : list.end(), item); };
  for (auto* points : {&crack.plane, &crack.upper, &crack.lower, &crack.original}) put(*points, x);
  put(crack.upper_carriers, std::vector<Carrier>{});
  put(crack.lower_carriers, std::vector<Carrier>{});
  cracked.insert(tip.end == 0 ? cracked.begin() : cracked.end(), true);
  crack.facets.push_back({static_cast<VertexId>(crack.facets.size()), static_cast<VertexId>(crack.facets.size() + 1)});
  CrackTractionState<2>& t = crack.traction;
  if (t.history.empty()) return;
  put(t.area, 0.);
  put(t.history, TractionHistory{});
  put(t.force, Vec<2>{});
  put(t.stored, 0.);
  t.between.insert(tip.end == 0 ? t.between.begin() : t.between.end(), true);
}

/// New carriers for the vertices near a tip that has grown: particles that were seen around the old tip may lie across the crack now. Of a new vertex
/// the place in the undeformed body follows from them.
void choose_anew(State<2>& state, StepWork<2>& work, const Model<2>& model, const CrackTip& tip, std::size_t added) {
  const CarrierChoice<2> choice(state, work, model);
  const PointFields<2> surroundings(work, model);
  Crack<2>& crack = state.cracks.list[tip.crack];
  const std::vector<Vec<2>> normals = vertex_normals(crack);
  const TipVertices vertices(crack, tip);
  const double near = 3 * std::fmax(model.grid.cell[0], model.grid.cell[1]);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::size_t v = vertices[k];
    const Vec<2>& x = crack.plane[v];
    if (k >= added && norm(x - crack.plane[vertices[0]]) > near) break;
    std::vector<Carrier> upper = choice.carriers(x, surroundings.beside(x, -normals[v]));
    std::vector<Carrier> lower = choice.carriers(x, surroundings.beside(x, normals[v]));
    if (k < added) {  // original + sum w u = x, and the weights make sum w x_p = x
      Vec<2> sum{};
      int sides = 0;
      for (const auto* side : {&upper, &lower}) {
        if (side->empty()) continue;
        sum += x - carried_displacement(state, work, *side, PositionTime::leading);
        ++sides;
      }
      if (sides > 0) crack.original[v] = sum * (1. / sides);
    }
    const auto take = [&](std::vector<Carrier>& from, std::vector<Carrier>& to, Vec<2>& point) {
      if (from.empty()) return;
      to = std::move(from);
      point = crack.original[v] + carried_displacement(state, work, to, PositionTime::leading);
    };
    take(upper, crack.upper_carriers[v], crack.upper[v]);
    take(lower, crack.lower_carriers[v], crack.lower[v]);
  }
}

/// Shares of new segments in the area on which a traction law acts.
void lay_tractions(Crack<2>& crack, const CrackTip& tip, std::size_t added, double thickness) {
  const TipVertices vertices(crack, tip);
  for (std::size_t k = 0; k < added; ++k) {
    const std::size_t a = vertices[k], b = vertices[k + 1];
    const double half = 0.5 * thickness * norm(crack.original[b] - crack.original[a]);
    crack.traction.area[a] += half;
    crack.traction.area[b] += half;
  }
}

template <int Dim, class Shape>
void grow(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, CrackTip& tip, const Growth& g) {
  const GrowthModel& growth = model.growth[tip.crack];
  Crack<Dim>& crack = state.cracks.list[tip.crack];
  const TipFrame frame = present_frame(model, crack, tip);
  const double h = std::fmax(model.grid.cell[0], model.grid.cell[1]), normal_segment = 0.5 * h;
  const Vec<2> e = turned_left(frame.ahead, g.angle);
  const double rest = growth.largest_growth - tip.grown;
  double length = std::fmin(growth.increment, rest);
  TipStatus status = TipStatus::grows;
  if (rest - length < 1e-6 * growth.increment) status = TipStatus::arrested;

  const double looks = length + 0.25 * h, met = looks * way_to_cracks(state, tip, frame.tip, frame.tip + e * looks);
  if (met <= looks) {
    length = met + 1e-3 * h;  // a hair across, so that nothing passes between
    status = TipStatus::joined;
  }
  const Material<2>& material = model.materials[tip.material];
  const double density = material.law->density();
  if (status != TipStatus::joined && filled(work, model, frame.tip + e * length, density, material.thickness) < 0.5) {
    status = TipStatus::left;
    crack.extension[tip.end] = 4 * h * std::fmax(1, Shape::reach(largest_half_extent) / 1.5);
  }

  const auto count = static_cast<std::size_t>(std::fmax(1, std::floor(length / normal_segment + 0.25)));
  for (std::size_t k = 1; k <= count; ++k) {
    add_vertex(crack, tip, frame.tip + e * (length * static_cast<double>(k) / static_cast<double>(count)),
               state.observed.cracked[tip.crack]);
  }
  view_cracks(state, work, model, cells_beyond<Shape>);
  choose_anew(state, work, model, tip, count);
  if (growth.bridged && !crack.traction.area.empty()) lay_tractions(crack, tip, count, model.tractions[tip.crack].thickness);

  // What a check is late, since steps end when they end, is not lost for the speed.
  const double since = tip.status == TipStatus::grows ? std::fmax(tip.next_check, state.clock.time - work.now.dt) : state.clock.time;
  tip.status = status;
  tip.grown += length;
  tip.speed = g.speed;
  if (std::isfinite(tip.now.J)) state.fracture.released += tip.now.J * length * material.thickness;
  tip.next_check = since + length / g.speed;
  using Kind = typename CrackEvent<Dim>::Kind;
  CrackEvent<Dim> event{state.clock.time, tip.crack,   frame.tip + e * length, 0, 0, Kind::grew, tip.end, g.angle, g.speed, tip.now.J,
                        tip.now.K_I,      tip.now.K_II};
  if (status == TipStatus::joined) event.kind = Kind::joined;
  if (status == TipStatus::left) event.kind = Kind::left;
  if (status == TipStatus::arrested) event.kind = Kind::arrested;
  state.ledger.events.push_back(event);
}

}  // namespace

template <int Dim, class Shape>
void grow_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if constexpr (Dim == 2) {
    for (std::size_t t = 0; t < state.fracture.tips.size(); ++t) {
      CrackTip& tip = state.fracture.tips[t];
      const GrowthModel& growth = model.growth[tip.crack];
      if (!may_grow(tip, growth) || state.clock.time < tip.next_check * (1 - 1e-12)) continue;
      const TipState now = state_of_tip(state, model, tip, work.tips[t]);
      if (const auto g = decide(state, model, tip, growth, now)) {
        tip.fired = tip.fired || growth.criterion->drive(now) >= growth.resistance.at(tip.grown, tip.speed);
        grow<Dim, Shape>(state, work, model, tip, *g);
      } else {
        tip.next_check = state.clock.time + growth.interval;
      }
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void grow_cracks<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
