#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "crampon/crack/criteria/best_angle.hpp"
#include "crampon/step/crack_images.hpp"
#include "crampon/step/extend_crack.hpp"
#include "crampon/step/filled_space.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/mean_stress.hpp"
#include "crampon/step/release_faces.hpp"
#include "crampon/step/tip_frame.hpp"
#include "crampon/step/tip_room.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

namespace {

Vec<2> turned_left(const Vec<2>& a, double angle) {
  return {{a[0] * std::cos(angle) - a[1] * std::sin(angle), a[0] * std::sin(angle) + a[1] * std::cos(angle)}};
}
double angle_from(const Vec<2>& a, const Vec<2>& b) { return std::atan2(cross(a, b), dot(a, b)); }

/// What a tip is about to do.
struct Growth {
  double angle = 0;    ///< rad, to the left
  double speed = 0;    ///< m/s
  bool first = false;  ///< the first criterion asks for it, not the alternate
};

/// Mean Cauchy stress of particles ahead of a tip, Pa, in its present frame; their weight falls with the distance in three cells. None where there are none.
std::optional<Tensor2> stress_ahead(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch) {
  const Crack<2>& crack = state.cracks.list[tip.crack];
  const TipFrame frame = original_frame(model, crack, tip), present = present_frame(model, crack, tip);
  const auto mean = mean_stress(state, model, tip, watch, [&](std::size_t slot) {
    const Vec<2> place = frame.turned(state.particles.original[slot] - frame.tip);
    const double r = norm(place) / (3 * model.grid.largest_cell());
    return place[0] <= 0 || r > 2 ? 0. : std::exp(-0.5 * r * r);
  });
  if (!mean) return std::nullopt;
  return turned(*mean, present, present);
}

/// What criteria of growth may ask of a tip whose parameters have just been found.
TipState state_of_tip(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch) {
  const GrowthModel& growth = model.growth[tip.crack];
  TipState out;
  out.J = tip.now.J;
  out.K = {tip.now.rest_I, tip.now.rest_II};
  out.opening = opening_behind(model, state.cracks.list[tip.crack], tip);
  if (const auto elastic = model.materials[tip.material].law->elasticity())
    out.elastic = PlaneElasticity(elastic->plane_lambda(model.stress_state), elastic->mu);
  out.time = state.clock.time;
  out.grown = tip.grown;
  if (growth.criterion->looks_ahead() || (growth.alternate && growth.alternate->looks_ahead()))
    out.ahead = stress_ahead(state, model, tip, watch);
  return out;
}

/// The way from the frame of a tip to its last segment, rad, where they differ by more than 20 degrees: the tip has just turned, and the cells do not see yet by how much. Its
/// parameters are still those of a tip at the corner, and would turn it again.
std::optional<double> unseen_turn(const Crack<2>& crack, const CrackTip& tip, const TipFrame& frame) {
  const TipVertices vertices(crack, tip);
  const double angle = angle_from(frame.ahead, crack.plane[vertices[0]] - crack.plane[vertices[1]]);
  if (std::fabs(angle) < 20 * std::numbers::pi / 180) return std::nullopt;
  return angle;
}

double angle_of(const GrowthModel& growth, const GrowthCriterion& criterion, const TipState& now, const CrackTip& tip,
                const TipFrame& frame, const Crack<2>& crack) {
  const bool asks_parameters = growth.direction == GrowthDirection::criterion || growth.direction == GrowthDirection::across_opening ||
                               growth.direction == GrowthDirection::hoop_of_opening;
  if (asks_parameters && tip.grown > 0) {
    if (const auto angle = unseen_turn(crack, tip, frame)) return *angle;
  }
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
    return Growth{0, tip.speed, false};
  }
  const double resistance = growth.resistance.at(tip.grown, tip.speed);
  const TipFrame frame = present_frame(model, state.cracks.list[tip.crack], tip);
  const auto asks = [&](const GrowthCriterion& criterion) -> std::optional<Growth> {
    if (criterion.needs_intensities() && !std::isfinite(now.K.I)) return std::nullopt;
    const double drive = criterion.drive(now) / resistance;
    if (!(drive >= 1)) return std::nullopt;
    Growth g{angle_of(growth, criterion, now, tip, frame, state.cracks.list[tip.crack]),
             std::fmin(growth.largest_speed, criterion.speed(now)), &criterion == &*growth.criterion};
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

template <int Dim, class Shape>
void grow(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, CrackTip& tip, const TipWatch& watch, const Growth& g) {
  const GrowthModel& growth = model.growth[tip.crack];
  Crack<Dim>& crack = state.cracks.list[tip.crack];
  const TipFrame frame = present_frame(model, crack, tip);
  const double h = model.grid.largest_cell(), normal_segment = 0.5 * h;
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
  const Vec<2> end = frame.tip + e * length;
  if (status != TipStatus::joined && filled(work, model, end, tip.material) < 0.5) {
    status = TipStatus::left;
    crack.extension[tip.end] =
        extension_beyond(work, model, end, e, tip.material, h * reach_beyond_edges(Shape::reach(largest_half_extent)));
  }

  const auto count = static_cast<std::size_t>(std::fmax(1, std::floor(length / normal_segment + 0.25)));
  std::vector<Vec<2>> places;
  for (std::size_t k = 1; k <= count; ++k) places.push_back(frame.tip + e * (length * static_cast<double>(k) / static_cast<double>(count)));
  extend_crack(state, work, model, tip, places, cells_beyond<Shape>);
  if (growth.release > 0) release_faces(state, model, tip, watch, places.size(), state.clock.time + growth.release / g.speed);

  // What a check is late, since steps end when they end, is not lost for the speed.
  const double since = tip.status == TipStatus::grows ? std::fmax(tip.next_check, state.clock.time - work.now.dt) : state.clock.time;
  tip.status = status;
  tip.grown += length;
  tip.speed = g.speed;
  if (std::isfinite(tip.now.J)) state.fracture.energy_by_J += tip.now.J * length * model.materials[tip.material].thickness;
  tip.next_check = since + length / g.speed;
  using Kind = typename CrackEvent<Dim>::Kind;
  CrackEvent<Dim> event{state.clock.time, tip.crack, end,     0,         0,           Kind::grew,
                        tip.end,          g.angle,   g.speed, tip.now.J, tip.now.K_I, tip.now.K_II};
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
        tip.fired = tip.fired || g->first;
        grow<Dim, Shape>(state, work, model, tip, work.tips[t], *g);
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
