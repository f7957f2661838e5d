#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "crampon/core/parallel.hpp"
#include "crampon/geometry/segment.hpp"
#include "crampon/step/carrier_choice.hpp"
#include "crampon/step/crack_images.hpp"
#include "crampon/step/extend_crack.hpp"
#include "crampon/step/filled_space.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/mean_stress.hpp"
#include "crampon/step/tip_frame.hpp"
#include "crampon/step/tip_room.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

namespace {

/// Cauchy stress in the plane, Pa.
struct PlaneStress {
  double xx = 0, yy = 0, xy = 0;

  PlaneStress() = default;
  explicit PlaneStress(const Tensor2& s) : xx(s[0][0]), yy(s[1][1]), xy(s[0][1]) {}
  void add(const PlaneStress& s, double weight) { xx += s.xx * weight, yy += s.yy * weight, xy += s.xy * weight; }
  void divide(double by) { xx /= by, yy /= by, xy /= by; }
  double largest() const { return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy); }
  /// Unit vector across the largest principal stress. Its longer component is positive, so that rounding does not turn it round.
  Vec<2> across_largest() const {
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    const Vec<2> e{{-std::sin(angle), std::cos(angle)}};
    return (std::fabs(e[0]) > std::fabs(e[1]) ? e[0] : e[1]) < 0 ? -e : e;
  }
};

double distance_to_cracks(const State<2>& state, const Vec<2>& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Crack<2>& crack : state.cracks.list) {
    for (std::size_t v = 1; v < crack.plane.size(); ++v)
      nearest = std::fmin(nearest, distance_to_segment(x, crack.plane[v - 1], crack.plane[v]));
  }
  return nearest;
}

double distance_to_mirrors(const Model<2>& model, const Vec<2>& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const SymmetryPlane& plane : model.symmetries)
    nearest = std::fmin(nearest, std::fabs(x[static_cast<std::size_t>(plane.axis)] - plane.at));
  return nearest;
}

/// A particle at which a crack may start.
struct Nucleus {
  std::uint32_t slot = 0, material = 0;
  PlaneStress mean;
  double largest = 0;  ///< principal stress of the mean, Pa
  Vec<2> rise;         ///< points to where the largest principal stresses of particles about it rise
};

/// What one look at stress sees for a nucleation. The largest principal stress of a mean is at most the mean of the largest principal stresses. So
/// means are found only near particles that reach the strength by themselves.
class Look {
 public:
  Look(const State<2>& state, const Model<2>& model, const NucleationModel& nucleation)
      : state_(state), model_(model), nucleation_(nucleation) {}

  /// Places at which the mean has reached the strength, from the highest mean on.
  std::vector<Nucleus> nuclei() {
    const std::vector<std::size_t> peaks = find_peaks();
    std::vector<Nucleus> found;
    if (peaks.empty()) return found;
    const ParticleMap<2> map(state_, model_);
    const std::vector<std::uint32_t> material_of_pack = find_materials();
    const auto for_near = [&](std::size_t slot, auto f) {  // f(slot, material, weight of its stress): particles within the radius
      const Vec<2> x = state_.particles.position(slot);
      map.for_box(x, nucleation_.radius / model_.grid.smallest_cell(), [&](const ParticleMap<2>::Entry& e) {
        const Vec<2> d = (state_.particles.position(e.slot) - x) * (1 / nucleation_.radius);
        const std::uint32_t material = material_of_pack[e.slot / lanes];
        const double rest = 1 - dot(d, d);  // falls smoothly, so that a particle on the rim does not matter
        if (nucleation_.materials[material] && rest > 0) f(e.slot, material, state_.particles.volume(e.slot) * rest * rest);
      });
    };
    for (const std::size_t peak : peaks) {
      for_near(peak, [&](std::uint32_t slot, std::uint32_t material, double) { found.push_back({slot, material, {}, 0, {}}); });
    }
    const auto id = [&](const Nucleus& n) { return state_.particles.id[n.slot]; };
    std::sort(found.begin(), found.end(), [&](const Nucleus& a, const Nucleus& b) { return id(a) < id(b); });
    found.erase(std::unique(found.begin(), found.end(), [](const Nucleus& a, const Nucleus& b) { return a.slot == b.slot; }), found.end());
    std::erase_if(found, [&](const Nucleus& n) { return !may_start_at(n.slot); });
    parallel_for(found.size(), model_.threads, [&](std::size_t i) {
      Nucleus& nucleus = found[i];
      double weights = 0, sum = 0;  // of largest principal stresses, and their first moments
      Vec<2> moment, places;
      for_near(nucleus.slot, [&](std::uint32_t slot, std::uint32_t material, double weight) {
        if (!belong_together(model_, material, nucleus.material)) return;
        const PlaneStress stress(cauchy_stress(state_, model_, material, slot));
        const Vec<2> from_nucleus = (state_.particles.position(slot) - state_.particles.position(nucleus.slot)) * weight;
        nucleus.mean.add(stress, weight);
        weights += weight;
        sum += stress.largest() * weight;
        moment += from_nucleus * stress.largest();
        places += from_nucleus;
      });
      nucleus.mean.divide(weights);
      nucleus.rise = moment - places * (sum / weights);
      nucleus.largest = nucleus.mean.largest();
    });
    std::erase_if(found, [&](const Nucleus& n) { return !(n.largest >= nucleation_.strength); });
    std::stable_sort(found.begin(), found.end(), [](const Nucleus& a, const Nucleus& b) { return a.largest > b.largest; });
    return found;
  }
  /// Largest principal stress of a particle, Pa; after nuclei().
  double highest() const { return highest_; }

 private:
  /// Particles that reach the strength by themselves, with room for a nucleus within the radius.
  std::vector<std::size_t> find_peaks() {
    const std::vector<Run>& runs = state_.order.runs;
    std::vector<std::vector<std::size_t>> of_run(runs.size());
    std::vector<double> highest(runs.size(), highest_);
    parallel_for(runs.size(), model_.threads, [&](std::size_t r) {
      if (!nucleation_.materials[runs[r].material]) return;
      for (std::size_t k = runs[r].first_pack; k < runs[r].end_pack; ++k) {
        const PackView<2> pack(state_, model_, runs[r].material, k);
        const Pack to_cauchy = pack.report().to_cauchy;
        for (std::size_t p = k * lanes; p < (k + 1) * lanes; ++p) {
          if (state_.particles.is_padding(p)) continue;
          const double largest = PlaneStress(cauchy_stress(pack, to_cauchy, p % lanes)).largest();
          highest[r] = std::fmax(highest[r], largest);
          if (largest >= nucleation_.strength &&
              distance_to_cracks(state_, state_.particles.position(p)) >= nucleation_.distance - nucleation_.radius)
            of_run[r].push_back(p);
        }
      }
    });
    std::vector<std::size_t> all;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      highest_ = std::fmax(highest_, highest[r]);
      all.insert(all.end(), of_run[r].begin(), of_run[r].end());
    }
    return all;
  }
  std::vector<std::uint32_t> find_materials() const {
    std::vector<std::uint32_t> material_of_pack(state_.particles.packs);
    for (const Run& run : state_.order.runs)
      std::fill(material_of_pack.begin() + run.first_pack, material_of_pack.begin() + run.end_pack, run.material);
    return material_of_pack;
  }
  bool may_start_at(std::size_t slot) const {
    const Vec<2>& X = state_.particles.original[slot];
    if (nucleation_.region && !nucleation_.region->contains(Vec<3>{{X[0], X[1], 0}}, 1e-9 * model_.grid.smallest_cell())) return false;
    return distance_to_cracks(state_, state_.particles.position(slot)) >= nucleation_.distance;
  }

  const State<2>& state_;
  const Model<2>& model_;
  const NucleationModel& nucleation_;
  double highest_ = -std::numeric_limits<double>::infinity();
};

/// The path of a new crack.
struct NewPath {
  std::array<double, 2> way{};   ///< from the nucleus to the start and to the end, m
  std::array<bool, 2> leaves{};  ///< there it lies on the edge of the body
};

/// A path of the given length (m) with its middle at x, in the direction e. Where it would end outside of the body or nearer than a cell to its
/// edge, it ends on the edge and has its length from there, or goes on to the edge on the other side.
NewPath lay_path(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, const Vec<2>& e, std::uint32_t material, double length) {
  const double h = model.grid.largest_cell(), step = 0.05 * h;
  const auto way_out = [&](const Vec<2>& along) {
    for (double way = step; way < length + h; way += step) {
      if (filled(work, model, x + along * way, material) < 0.5) return way;
    }
    return std::numeric_limits<double>::infinity();
  };
  const std::array<double, 2> out = {way_out(-e), way_out(e)};
  NewPath path;
  path.way = {0.5 * length, 0.5 * length};
  const auto leaves = [&](std::size_t end) {
    if (path.leaves[end] || out[end] >= path.way[end] + h) return false;
    path.way[end] = out[end];
    return path.leaves[end] = true;
  };
  for (const std::size_t end : {0, 1}) {
    const std::size_t other = 1 - end;
    if (!leaves(end) || path.leaves[other]) continue;
    path.way[other] = std::fmax(0.5 * length, length - path.way[end]);
    leaves(other);
  }
  return path;
}

/// The middle of a new crack in the direction e: half a particle's half size beside the particle, to the side where stress rises. Through its middle,
/// and through those of its row, rounding would decide which of them lie above the crack and which below.
Vec<2> beside_row(const State<2>& state, const Model<2>& model, const Nucleus& nucleus, const Vec<2>& e) {
  const HalfSize<2>& half = model.materials[nucleus.material].half_size;
  const Vec<2> left{{-e[1], e[0]}};
  const double aside = 0.5 * std::fmin(half[0] * model.grid.cell[0], half[1] * model.grid.cell[1]);
  return state.particles.position(nucleus.slot) + left * std::copysign(aside, dot(nucleus.rise, left));
}

template <class Shape>
void start_at(State<2>& state, StepWork<2>& work, const Model<2>& model, const NucleationModel& nucleation, std::uint32_t number,
              const Nucleus& nucleus) {
  const double h = model.grid.largest_cell();
  const Vec<2> e = nucleus.mean.across_largest(), x = beside_row(state, model, nucleus, e);
  const NewPath path = lay_path(work, model, x, e, nucleus.material, nucleation.length);
  const double length = path.way[0] + path.way[1];
  const auto segments = static_cast<std::size_t>(std::fmax(2, std::round(length / (0.5 * h))));
  std::vector<Vec<2>> places;
  for (std::size_t k = 0; k <= segments; ++k)
    places.push_back(x + e * (length * static_cast<double>(k) / static_cast<double>(segments) - path.way[0]));
  Crack<2>& crack = state.cracks.list[number];
  const double reach = h * reach_beyond_edges(Shape::reach(largest_half_extent));
  if (path.leaves[0]) crack.extension[0] = extension_beyond(work, model, places.front(), -e, nucleus.material, reach);
  if (path.leaves[1]) crack.extension[1] = extension_beyond(work, model, places.back(), e, nucleus.material, reach);
  start_crack(state, work, model, number, places, cells_beyond<Shape>);
  for (CrackTip& tip : state.fracture.tips) {
    if (tip.crack != number) continue;
    tip.status = path.leaves[tip.end] ? TipStatus::left : TipStatus::waits;
    tip.material = nucleus.material;
    tip.next_check = state.clock.time;
    tip.initial = original_frame(model, crack, tip).ahead;
  }
  CrackEvent<2> event;
  event.time = state.clock.time;
  event.crack = number;
  event.x = state.particles.position(nucleus.slot);
  event.kind = CrackEvent<2>::Kind::nucleated;
  event.angle = std::atan2(e[1], e[0]);
  state.ledger.events.push_back(event);
}

template <class Shape>
void nucleate(State<2>& state, StepWork<2>& work, const Model<2>& model, const NucleationModel& nucleation, NucleationState& now) {
  Look look(state, model, nucleation);
  const std::vector<Nucleus> nuclei = look.nuclei();
  now.highest = std::fmax(now.highest, look.highest());
  for (const Nucleus& nucleus : nuclei) {
    const Vec<2> x = state.particles.position(nucleus.slot);
    if (now.made == nucleation.most || distance_to_cracks(state, x) < nucleation.distance) continue;
    if (distance_to_mirrors(model, x) < nucleation.distance) {
      now.at_mirror = true;
      continue;
    }
    start_at<Shape>(state, work, model, nucleation, nucleation.first + static_cast<std::uint32_t>(now.made), nucleus);
    ++now.made;
  }
  now.next = state.clock.time + nucleation.interval;
}

}  // namespace

template <int Dim, class Shape>
void nucleate_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if constexpr (Dim == 2) {
    for (std::size_t n = 0; n < model.nucleations.size(); ++n) {
      NucleationState& now = state.fracture.nucleations[n];
      if (now.made == model.nucleations[n].most || state.clock.time < now.next * (1 - 1e-12)) continue;
      nucleate<Shape>(state, work, model, model.nucleations[n], now);
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void nucleate_cracks<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
