#include "crampon/step/crack_carriers.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "crampon/step/assemble.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {

namespace {

/// How far from a point its carriers lie at most, in cells along each axis; the first that is good enough is taken. One cell holds two rows
/// of the usual two particles per cell; a point outside of all material needs more, to tell a turn from a strain from afar.
constexpr double reaches[] = {1, 1.5, 2, 3, 4, 6};
/// Carriers are good enough when they are spread by this in every direction (variance, cells^2) ...
constexpr double least_variance = 0.02;
/// ... and the point lies no further from their middle than the square root of this, in standard deviations. On an edge it is 1.7 of them
/// away, in a corner 2.4.
constexpr double most_leverage = 8;

/// Particles that can carry points, by cells.
class ParticleMap {
 public:
  ParticleMap(const State<2>& state, const Model<2>& model) : grid_(model.grid) {
    for (const Run& run : state.order.runs) {
      if (model.ignores_cracks(model.materials[run.material].field)) continue;  // no crack parts it
      for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
        if (state.particles.is_padding(p)) continue;
        list_.push_back({cell_of(state.particles.position(p)), state.particles.id[p], static_cast<std::uint32_t>(p),
                         model.materials[run.material].field});
      }
    }
    std::sort(list_.begin(), list_.end(), [](const Entry& a, const Entry& b) {
      return std::tuple(a.cell[1], a.cell[0], a.id) < std::tuple(b.cell[1], b.cell[0], b.id);
    });
  }

  struct Entry {
    std::array<int, 2> cell;
    std::uint32_t id, slot;
    std::uint16_t field;
  };
  /// f(entry) for particles in cells that the box of half sizes reach (cells) about x meets.
  template <class F>
  void for_box(const Vec<2>& x, double reach, F f) const {
    const Vec<2> r{{reach * grid_.cell[0], reach * grid_.cell[1]}};
    const std::array<int, 2> low = cell_of(x - r), high = cell_of(x + r);
    for (int j = low[1]; j <= high[1]; ++j) {
      auto at = std::lower_bound(list_.begin(), list_.end(), std::array{j, low[0]}, [](const Entry& e, const std::array<int, 2>& c) {
        return std::tuple(e.cell[1], e.cell[0]) < std::tuple(c[0], c[1]);
      });
      for (; at != list_.end() && at->cell[1] == j && at->cell[0] <= high[0]; ++at) f(*at);
    }
  }

 private:
  std::array<int, 2> cell_of(const Vec<2>& x) const {
    std::array<int, 2> cell;
    for (std::size_t k = 0; k < 2; ++k) cell[k] = static_cast<int>(std::floor((x[k] - grid_.origin[k]) * grid_.inverse_cell[k]));
    return cell;
  }

  const Grid<2>& grid_;
  std::vector<Entry> list_;  ///< by cell, then id
};

/// Weights of particles in the displacement of a point: of the fit of a linear field to theirs, each with some weight of its own.
struct LinearFit {
  double leverage = 0, variance = 0;  ///< of the point, 1; smallest of the particles' places, cells^2

  /// y: places less the point, cells; weights: own weights in, weights of the fit out. Directions in which places hardly differ count as
  /// if the field did not change along them.
  LinearFit(const std::vector<Vec<2>>& y, std::vector<double>& weights) {
    double sum = 0;
    Vec<2> mean{};
    for (std::size_t i = 0; i < y.size(); ++i) {
      sum += weights[i];
      mean += y[i] * weights[i];
    }
    mean *= 1 / sum;
    double xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const Vec<2> d = y[i] - mean;
      xx += weights[i] / sum * d[0] * d[0];
      xy += weights[i] / sum * d[0] * d[1];
      yy += weights[i] / sum * d[1] * d[1];
    }
    const double middle = 0.5 * (xx + yy), half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy);
    // Directions of most and least spread. Where both are equal, any will do.
    Vec<2> along{{1, 0}};
    if (root > 1e-12 * middle) along = half > 0 ? normalized(Vec<2>{{half + root, xy}}) : normalized(Vec<2>{{xy, root - half}});
    const Vec<2> across{{-along[1], along[0]}};
    Vec<2> slope{};
    const auto take = [&](const Vec<2>& e, double spread) {
      if (spread < least_variance) return;
      slope -= e * (dot(mean, e) / spread);
      leverage += dot(mean, e) * dot(mean, e) / spread;
    };
    take(along, middle + root);
    take(across, middle - root);
    variance = middle - root;
    for (std::size_t i = 0; i < y.size(); ++i) weights[i] *= (1 + dot(y[i] - mean, slope)) / sum;
  }
  bool good() const { return variance >= least_variance && leverage <= most_leverage; }
};

class CarrierChoice {
 public:
  CarrierChoice(const State<2>& state, const StepWork<2>& work, const Model<2>& model)
      : state_(state), work_(work), model_(model), surroundings_(work, model), map_(state, model) {}

  /// Of the side of `from`, which is x or a hair beside it.
  std::vector<Carrier> carriers(const Vec<2>& x, const Vec<2>& from) const {
    std::vector<Carrier> chosen;
    for (const double reach : reaches) {
      const std::vector<Candidate> near = candidates(x, from, reach);
      if (near.empty()) continue;
      std::vector<Vec<2>> y;
      std::vector<double> weights;
      for (const Candidate& c : near) {
        y.push_back(c.y);
        const double near_by = (1 - std::fabs(c.y[0]) / reach) * (1 - std::fabs(c.y[1]) / reach);
        weights.push_back(state_.particles.mass(c.slot) * near_by * near_by);
      }
      const LinearFit fit(y, weights);
      chosen.clear();
      for (std::size_t i = 0; i < near.size(); ++i) chosen.push_back({near[i].id, near[i].flip, weights[i]});
      if (fit.good()) break;
    }
    return chosen;
  }

 private:
  struct Candidate {
    Vec<2> y;  ///< place less the point, cells
    std::uint32_t id, slot;
    std::uint16_t field;
    std::uint8_t flip;
  };

  /// Particles seen within reach, of the velocity field of the nearest one, with their images in mirrors.
  std::vector<Candidate> candidates(const Vec<2>& x, const Vec<2>& from, double reach) const {
    std::vector<Candidate> found;
    std::vector<Vec<2>> places;
    map_.for_box(x, reach, [&](const ParticleMap::Entry& e) {
      const Vec<2> place = state_.particles.position(e.slot);
      const Vec<2> y = in_cells(place - x);
      if (!within(y, reach)) return;
      found.push_back({y, e.id, e.slot, e.field, 0});
      places.push_back(place);
    });
    std::vector<Candidate> seen;
    constexpr std::size_t at_once = most_nodes_in_plane;
    for (std::size_t first = 0; first < places.size(); first += at_once) {
      const std::size_t count = std::min(at_once, places.size() - first);
      const unsigned hidden = surroundings_.hidden(from, {places.data() + first, count});
      for (std::size_t i = 0; i < count; ++i) {
        if (!(hidden >> i & 1u)) seen.push_back(found[first + i]);
      }
    }
    if (seen.empty()) return seen;
    const Candidate& nearest =
        *std::min_element(seen.begin(), seen.end(), [](const Candidate& a, const Candidate& b) { return dot(a.y, a.y) < dot(b.y, b.y); });
    const std::uint16_t field = nearest.field;
    std::erase_if(seen, [&](const Candidate& c) { return c.field != field; });
    for (const SymmetryPlane& mirror : model_.symmetries) {
      const auto k = static_cast<std::size_t>(mirror.axis);
      const auto image_of = [&](Candidate c) {
        c.y[k] += 2 * (mirror.at - x[k] - c.y[k] * model_.grid.cell[k]) * model_.grid.inverse_cell[k];
        c.flip = static_cast<std::uint8_t>(c.flip ^ 1u << k);
        return c;
      };
      std::vector<Candidate> images;
      for (const Candidate& c : found) {
        const Candidate image = image_of(c);
        if (c.field == field && within(image.y, reach) && seen_in_mirror(mirror, from, state_.particles.position(c.slot)))
          images.push_back(image);
      }
      for (const Candidate& c : seen) {  // images in another mirror
        const Candidate image = image_of(c);
        if (c.flip != 0 && within(image.y, reach)) images.push_back(image);
      }
      seen.insert(seen.end(), images.begin(), images.end());
    }
    return seen;
  }

  /// Cracks and their images behind the mirror part points as they part them in the whole body.
  bool seen_in_mirror(const SymmetryPlane& mirror, const Vec<2>& from, Vec<2> place) const {
    const auto k = static_cast<std::size_t>(mirror.axis);
    place[k] = 2 * mirror.at - place[k];
    return surroundings_.hidden(from, {&place, 1}) == 0;
  }
  Vec<2> in_cells(const Vec<2>& d) const { return {{d[0] * model_.grid.inverse_cell[0], d[1] * model_.grid.inverse_cell[1]}}; }
  static bool within(const Vec<2>& y, double reach) { return std::fabs(y[0]) < reach && std::fabs(y[1]) < reach; }

  const State<2>& state_;
  const StepWork<2>& work_;
  const Model<2>& model_;
  PointFields surroundings_;
  ParticleMap map_;
};

void choose_for_all(State<2>& state, StepWork<2>& work, const Model<2>& model) {
  const CarrierChoice choice(state, work, model);
  const PointFields surroundings(work, model);
  for (Crack<2>& crack : state.cracks.list) {
    crack.upper_carriers.resize(crack.plane.size());
    crack.lower_carriers.resize(crack.plane.size());
    for (std::size_t v = 0; v < crack.plane.size(); ++v) {
      const Vec<2>& x = crack.plane[v];
      const Vec<2> down = vertex_normal(crack, v);
      crack.upper_carriers[v] = choice.carriers(x, surroundings.beside(x, -down));
      crack.lower_carriers[v] = choice.carriers(x, surroundings.beside(x, down));
    }
  }
}

}  // namespace

template <int Dim, class Shape>
void choose_carriers(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if (state.cracks.empty() || !state.cracks.list.front().upper_carriers.empty()) return;
  if constexpr (Dim == 2) {  // the input admits cracks in 2D only
    view_cracks(state, work, model, cells_beyond<Shape>);
    choose_for_all(state, work, model);
  }
}

template <int Dim>
void drop_lost_carriers(State<Dim>& state, StepWork<Dim>& work) {
  for (auto& crack : state.cracks.list) {
    for (Carriers* side : {&crack.upper_carriers, &crack.lower_carriers}) {
      for (std::vector<Carrier>& carriers : *side) {
        const bool lost = std::any_of(carriers.begin(), carriers.end(),
                                      [&](const Carrier& c) { return work.places.slot_of_id[c.particle] == padding_id; });
        if (lost) carriers.clear();
      }
    }
  }
}

Vec<2> carried_displacement(const State<2>& state, const StepWork<2>& work, const std::vector<Carrier>& carriers, PositionTime time) {
  Vec<2> sum{};
  for (const Carrier& c : carriers) {
    const std::uint32_t slot = work.places.slot_of_id[c.particle];
    const Particles<2>& particles = state.particles;
    const Vec<2> x = time == PositionTime::present ? particles.present_position(slot) : particles.position(slot),
                 u = x - particles.original[slot];
    for (int k = 0; k < 2; ++k) sum[k] += (c.flip >> k & 1u ? -c.weight : c.weight) * u[k];
  }
  return sum;
}

template <class Shape>
void find_nodes_of_point(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const std::vector<Carrier>& carriers,
                         std::vector<NodeOfPoint>& nodes) {
  using T = Tile<2, Shape>;
  nodes.clear();
  StencilFactors<2, Shape> factors;
  for (const Carrier& carrier : carriers) {
    const std::uint32_t slot = work.places.slot_of_id[carrier.particle], pack = slot / lanes;
    const std::uint32_t b = work.places.block_of_pack[pack];
    const Block<2>& block = work.blocks.list[b];
    const BlockLayers<2>& layers = work.nodes.layers[b];
    BlockStencils<2, Shape> stencils(state, work, model, b);
    std::uint32_t r = block.first_run;
    while (pack >= state.order.runs[r].end_pack) ++r;
    stencils.enter_run(r);
    stencils.compute(pack, factors);
    const PairTarget* targets = stencils.targets(pack);
    const int lane = static_cast<int>(slot % lanes);
    for (int n = 0; n < T::stencil; ++n) {
      const double weight = factors.weight(n, lane) * carrier.weight;
      if (weight == 0) continue;
      const PairTarget target =
          targets ? targets[lane * T::stencil + n]
                  : PairTarget{static_cast<std::uint16_t>(factors.lowest(lane) + T::steps[n]), static_cast<std::uint8_t>(factors.layer), 0};
      IndexVector<2> local = unflatten<2>(target.node, T::side);
      int neighbour = 0, stride = 1;
      for (int k = 0; k < 2; ++k) {
        local[k] -= T::offset;
        const int step = local[k] < 0 ? -1 : local[k] >= block_side ? 1 : 0;
        local[k] -= step * block_side;
        neighbour += (step + 1) * stride;
        stride *= 3;
      }
      NodeOfPoint at;
      at.block = block.neighbours[neighbour];
      const BlockLayers<2>& there = work.nodes.layers[at.block];
      at.slot = there.slot(layer_of<2>(there.node, layers.tile[target.layer]), local[1] * block_side + local[0]);
      at.flip = static_cast<std::uint8_t>(carrier.flip ^ target.flip);
      auto same = std::find_if(nodes.begin(), nodes.end(), [&](const NodeOfPoint& q) { return q.slot == at.slot && q.flip == at.flip; });
      if (same == nodes.end()) same = nodes.insert(nodes.end(), at);
      same->weight += weight;
    }
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void choose_carriers<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE
template void drop_lost_carriers<2>(State<2>&, StepWork<2>&);
template void drop_lost_carriers<3>(State<3>&, StepWork<3>&);
#define CRAMPON_INSTANTIATE(SHAPE)                                                                                            \
  template void find_nodes_of_point<SHAPE>(const State<2>&, const StepWork<2>&, const Model<2>&, const std::vector<Carrier>&, \
                                           std::vector<NodeOfPoint>&);
CRAMPON_FOR_ALL_SHAPES_IN_PLANE(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
