#pragma once
/// Which particles carry a surface point of a crack (step/crack_carriers.hpp).

#include <algorithm>
#include <cmath>
#include <vector>

#include "crampon/step/linear_fit.hpp"
#include "crampon/step/point_fields.hpp"

namespace crampon {

/// How far from a point its carriers lie at most, in cells along each axis; the first that is good enough is taken. One cell holds two rows
/// of the usual two particles per cell and axis; a point outside of all material needs more, to tell a turn from a strain from afar.
inline constexpr double carrier_reaches[] = {1, 1.5, 2, 3, 4, 6};

/// Particles that can carry points, by cells.
template <int Dim>
class ParticleMap {
 public:
  using Cell = IndexVector<Dim>;
  struct Entry {
    Cell cell;
    std::uint32_t id, slot;
    std::uint16_t field;
  };

  ParticleMap(const State<Dim>& state, const Model<Dim>& model) : grid_(model.grid) {
    for (const Run& run : state.order.runs) {
      if (model.ignores_cracks(model.materials[run.material].field)) continue;  // no crack parts it
      for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
        if (state.particles.is_padding(p)) continue;
        list_.push_back({cell_of(state.particles.position(p)), state.particles.id[p], static_cast<std::uint32_t>(p),
                         model.materials[run.material].field});
      }
    }
    std::sort(list_.begin(), list_.end(),
              [](const Entry& a, const Entry& b) { return a.cell == b.cell ? a.id < b.id : comes_before(a.cell, b.cell); });
  }

  /// f(entry) for particles in cells that the box of half sizes reach (cells) about x meets.
  template <class F>
  void for_box(const Vec<Dim>& x, double reach, F f) const {
    const Vec<Dim> r = grid_.cell * reach;
    const Cell low = cell_of(x - r), high = cell_of(x + r);
    Cell first = low;  // of a row of cells along the first axis
    for (int k = Dim == 3 ? low[Dim - 1] : 0; k <= (Dim == 3 ? high[Dim - 1] : 0); ++k) {
      if constexpr (Dim == 3) first[2] = k;
      for (first[1] = low[1]; first[1] <= high[1]; ++first[1]) {
        Cell end = first;
        end[0] = high[0] + 1;
        const auto in_front = [](const Entry& e, const Cell& cell) { return comes_before(e.cell, cell); };
        auto at = std::lower_bound(list_.begin(), list_.end(), first, in_front);
        for (; at != list_.end() && comes_before(at->cell, end); ++at) f(*at);
      }
    }
  }

 private:
  /// The first axis varies fastest.
  static bool comes_before(const Cell& a, const Cell& b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }
  Cell cell_of(const Vec<Dim>& x) const {
    Cell cell;
    for (std::size_t k = 0; k < Dim; ++k) cell[k] = static_cast<int>(std::floor((x[k] - grid_.origin[k]) * grid_.inverse_cell[k]));
    return cell;
  }

  const Grid<Dim>& grid_;
  std::vector<Entry> list_;  ///< by cell, then id
};

template <int Dim>
class CarrierChoice {
 public:
  CarrierChoice(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model)
      : state_(state), work_(work), model_(model), surroundings_(work, model), map_(state, model) {}

  /// Of the side of `from`, which is x or a hair beside it.
  std::vector<Carrier> carriers(const Vec<Dim>& x, const Vec<Dim>& from) const {
    std::vector<Carrier> chosen;
    for (const double reach : carrier_reaches) {
      const std::vector<Candidate> near = candidates(x, from, reach);
      if (near.empty()) continue;
      std::vector<Vec<Dim>> y;
      std::vector<double> weights;
      for (const Candidate& c : near) {
        y.push_back(c.y);
        double near_by = 1;
        for (std::size_t k = 0; k < Dim; ++k) near_by *= 1 - std::fabs(c.y[k]) / reach;
        weights.push_back(state_.particles.mass(c.slot) * near_by * near_by);
      }
      const LinearFit<Dim> fit(y, weights);
      chosen.clear();
      for (std::size_t i = 0; i < near.size(); ++i) chosen.push_back({near[i].id, near[i].flip, weights[i]});
      if (fit.good()) break;
    }
    return chosen;
  }

 private:
  struct Candidate {
    Vec<Dim> y;  ///< place less the point, cells
    std::uint32_t id, slot;
    std::uint16_t field;
    std::uint8_t flip;
  };

  /// Particles seen within reach, of the velocity field of the nearest one, with their images in mirrors.
  std::vector<Candidate> candidates(const Vec<Dim>& x, const Vec<Dim>& from, double reach) const {
    std::vector<Candidate> found, seen;
    map_.for_box(x, reach, [&](const typename ParticleMap<Dim>::Entry& e) {
      const Vec<Dim> place = state_.particles.position(e.slot);
      const Vec<Dim> y = in_cells(place - x);
      if (!within(y, reach)) return;
      found.push_back({y, e.id, e.slot, e.field, 0});
      if (is_seen(place, from)) seen.push_back(found.back());
    });
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

  /// A particle on a crack, or within rounding of it, carries neither side: to which it belongs may differ from segment to segment. So the place a hair
  /// beyond it must be seen.
  bool is_seen(const Vec<Dim>& place, const Vec<Dim>& from) const { return !surroundings_.parted(place + (place - from) * 1e-6, from); }

  /// Cracks and their images behind the mirror part points as they part them in the whole body.
  bool seen_in_mirror(const SymmetryPlane& mirror, const Vec<Dim>& from, Vec<Dim> place) const {
    const auto k = static_cast<std::size_t>(mirror.axis);
    place[k] = 2 * mirror.at - place[k];
    return is_seen(place, from);
  }
  Vec<Dim> in_cells(Vec<Dim> d) const {
    for (std::size_t k = 0; k < Dim; ++k) d[k] *= model_.grid.inverse_cell[k];
    return d;
  }
  static bool within(const Vec<Dim>& y, double reach) {
    return std::all_of(y.c.begin(), y.c.end(), [reach](double along) { return std::fabs(along) < reach; });
  }

  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  PointFields<Dim> surroundings_;
  ParticleMap<Dim> map_;
};

}  // namespace crampon
