#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "crampon/crack/crossing.hpp"
#include "crampon/step/assemble.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {

namespace {

/// Particles in the same or in neighbouring cells hang together when no crack lies between them and they are of one field, or of fields
/// bonded to each other. Bonded cracks part nothing.
template <int Dim>
class PieceSearch {
 public:
  PieceSearch(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model) : state_(state), work_(work), model_(model) {
    for (const Run& run : state.order.runs) {
      const std::uint16_t field = model.materials[run.material].field;
      if (model.is_rigid(field)) continue;
      for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
        if (state.particles.is_padding(p)) continue;
        IndexVector<Dim> cell{};
        const Vec<Dim> x = state.particles.position(p);
        for (int k = 0; k < Dim; ++k)
          cell[k] = static_cast<int>(std::floor((x[static_cast<std::size_t>(k)] - model.grid.origin[static_cast<std::size_t>(k)]) *
                                                model.grid.inverse_cell[static_cast<std::size_t>(k)]));
        list_.push_back({model.contact.fields[field].bonded_to, run.material, cell, static_cast<std::uint32_t>(p)});
      }
    }
    std::sort(list_.begin(), list_.end(), [&](const Entry& a, const Entry& b) {
      return std::tuple(a.group, a.cell, state.particles.id[a.slot]) < std::tuple(b.group, b.cell, state.particles.id[b.slot]);
    });
    above_.resize(list_.size());
    std::iota(above_.begin(), above_.end(), std::size_t{0});
    for (std::size_t first = 0; first < list_.size(); first = end_of(first)) join_cell(first);
  }

  struct Entry {
    std::uint16_t group;
    std::uint32_t material;
    IndexVector<Dim> cell;
    std::uint32_t slot;
  };
  const std::vector<Entry>& list() const { return list_; }
  /// The first entry of the piece of an entry.
  std::size_t first_of(std::size_t i) const {
    while (above_[i] != i) i = above_[i];
    return i;
  }

 private:
  std::size_t end_of(std::size_t first) const {
    std::size_t end = first;
    while (end < list_.size() && list_[end].group == list_[first].group && list_[end].cell == list_[first].cell) ++end;
    return end;
  }
  void join(std::size_t i, std::size_t j) {
    i = first_of(i), j = first_of(j);
    const std::size_t low = std::min(i, j);
    above_[i] = above_[j] = low;
  }

  /// Joins the particles of a cell with each other and with those of the neighbours that come later.
  void join_cell(std::size_t first) {
    const std::size_t end = end_of(first);
    const bool cracked = sees_cracks(list_[first].cell);
    for (std::size_t i = first + 1; i < end; ++i) {
      if (!cracked) join(first, i);
      for (std::size_t j = first; cracked && j < i; ++j) join_if_seen(i, j);
    }
    for (int o = neighbour_count<Dim> / 2 + 1; o < neighbour_count<Dim>; ++o) {
      Entry wanted = list_[first];
      const IndexVector<Dim> step = neighbour_step<Dim>(o);
      for (int k = 0; k < Dim; ++k) wanted.cell[k] += step[k];
      const auto at = std::lower_bound(list_.begin(), list_.end(), wanted, [](const Entry& a, const Entry& b) {
        return std::tuple(a.group, a.cell) < std::tuple(b.group, b.cell);
      });
      if (at == list_.end() || at->group != wanted.group || at->cell != wanted.cell) continue;
      const auto there = static_cast<std::size_t>(at - list_.begin());
      if (!cracked && !sees_cracks(wanted.cell)) {
        join(first, there);
        continue;
      }
      const std::size_t there_end = end_of(there);
      for (std::size_t i = first; i < end; ++i) {
        for (std::size_t j = there; j < there_end; ++j) join_if_seen(i, j);
      }
    }
  }

  bool sees_cracks(const IndexVector<Dim>& cell) const {
    const FacetBins<Dim>& bins = work_.crack_view.bins;
    IndexVector<Dim> low = cell, high = cell;
    for (int k = 0; k < Dim; ++k) --low[k], ++high[k];
    return !bins.empty() && bins.any_in_box(low, high);
  }

  void join_if_seen(std::size_t i, std::size_t j) {
    if (first_of(i) == first_of(j)) return;
    const Entry &a = list_[i], &b = list_[j];
    const auto ignores_cracks = [&](const Entry& e) { return model_.ignores_cracks(model_.materials[e.material].field); };
    const bool whole = ignores_cracks(a) && ignores_cracks(b);
    const Vec<Dim> x = state_.particles.position(a.slot), y = state_.particles.position(b.slot);
    IndexVector<Dim> low{}, high{};
    for (int k = 0; k < Dim; ++k) low[k] = std::min(a.cell[k], b.cell[k]), high[k] = std::max(a.cell[k], b.cell[k]);
    const std::span<const FacetRef> facets = work_.crack_view.bins.facets_of_box(low, high, room_);
    for (std::size_t f = 0; f < facets.size() && !whole;) {
      std::size_t end = f;
      while (end < facets.size() && facets[end].crack == facets[f].crack) ++end;
      const bool bonded = model_.contact.law_across(facets[f].crack).bonds();
      if (!bonded && cross_crack<Dim>(work_.crack_view.meshes[facets[f].crack], facets.subspan(f, end - f), x, y).crosses()) return;
      f = end;
    }
    join(i, j);
  }

  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::vector<Entry> list_;         ///< by group of bonded fields, cell, number of the particle
  std::vector<std::size_t> above_;  ///< per entry: one of its piece that comes before it; itself: the first
  std::vector<FacetRef> room_;
};

/// Is the particle one of the outer row at the plane?
template <int Dim>
bool is_at_plane(const Model<Dim>& model, const Material<Dim>& material, const SymmetryPlane& plane, const Vec<Dim>& x) {
  const auto axis = static_cast<std::size_t>(plane.axis);
  return std::fabs(x[axis] - plane.at) < 1.5 * material.half_size[axis] * model.grid.cell[axis];
}

}  // namespace

template <int Dim>
void start_rotations(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  Pieces<Dim>& pieces = state.pieces;
  pieces = {};
  if (model.rotation == RotationTransfer::n03) return;
  if (!state.cracks.empty()) view_cracks(state, work, model, 1);
  const PieceSearch<Dim> search(state, work, model);
  const auto& list = search.list();
  pieces.of_field.assign(model.contact.fields.size(), no_piece);
  std::vector<std::uint32_t> piece(list.size()), group_of_piece;
  std::vector<double> mass(model.contact.fields.size(), 0.);  // of groups of bonded fields
  std::vector<Vec<Dim>> first(model.contact.fields.size());
  bool several = false;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (const std::size_t leader = search.first_of(i); leader == i) {
      piece[i] = static_cast<std::uint32_t>(pieces.list.size());
      pieces.list.emplace_back().about = Dim == 3 ? std::array{true, true, true} : std::array{false, false, true};
      group_of_piece.push_back(list[i].group);
    } else {
      piece[i] = piece[leader];
    }
    const Material<Dim>& material = model.materials[list[i].material];
    const Vec<Dim> x = state.particles.position(list[i].slot);
    for (const SymmetryPlane& plane : model.symmetries) {
      if (!is_at_plane(model, material, plane, x)) continue;
      for (int k = 0; k < 3; ++k) pieces.list[piece[i]].about[static_cast<std::size_t>(k)] &= k == plane.axis;
    }
    mass[list[i].group] += state.particles.mass(list[i].slot);
    first[list[i].group] += x * state.particles.mass(list[i].slot);
    std::uint32_t& of_field = pieces.of_field[material.field];
    if (of_field == no_piece) of_field = piece[i];
    if (of_field != piece[i]) of_field = several_pieces, several = true;
  }
  // Pieces of one field share nodes' first moments, and so their origin.
  for (std::size_t k = 0; k < pieces.list.size(); ++k) {
    if (const std::size_t g = group_of_piece[k]; mass[g] > 0) pieces.list[k].origin = first[g] * (1 / mass[g]);
  }
  if (several) pieces.of_particle.assign(state.order.particle_count, no_piece);
  for (std::size_t i = 0; several && i < list.size(); ++i) pieces.of_particle[state.particles.id[list[i].slot]] = piece[i];
}

template void start_rotations<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void start_rotations<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
