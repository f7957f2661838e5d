#include "crampon/step/extend_crack.hpp"

#include "crampon/step/carrier_choice.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/tip_frame.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {

namespace {

/// A vertex at an end of a crack, at x; what it needs more is left to choose_anew().
void add_vertex(Crack<2>& crack, const CrackTip& tip, const Vec<2>& x, std::vector<bool>& cracked) {
  const auto put = [&](auto& list, const auto& item) { list.insert(tip.end == 0 ? list.begin() : list.end(), item); };
  for (auto* points : {&crack.plane, &crack.upper, &crack.lower, &crack.original}) put(*points, x);
  put(crack.upper_carriers, std::vector<Carrier>{});
  put(crack.lower_carriers, std::vector<Carrier>{});
  put(cracked, true);
  if (tip.end == 0) {
    for (FadingTraction<2>& f : crack.fading) ++f.vertex;
  }
  crack.facets.push_back({static_cast<VertexId>(crack.facets.size()), static_cast<VertexId>(crack.facets.size() + 1)});
  CrackTractionState<2>& t = crack.traction;
  if (t.history.empty()) return;
  put(t.area, 0.);
  put(t.history, TractionHistory{});
  put(t.force, Vec<2>{});
  put(t.stored, 0.);
  put(t.between, true);
}

/// New carriers for the vertices near a tip that has grown: particles that were seen around the old tip may lie across the crack now. Of a new vertex
/// the place in the undeformed body follows from them.
void choose_anew(State<2>& state, StepWork<2>& work, const Model<2>& model, const CrackTip& tip, std::size_t added) {
  const CarrierChoice<2> choice(state, work, model);
  const PointFields<2> surroundings(work, model);
  Crack<2>& crack = state.cracks.list[tip.crack];
  const std::vector<Vec<2>> normals = vertex_normals(crack);
  const TipVertices vertices(crack, tip);
  const double near = 3 * model.grid.largest_cell();  // carriers are looked for within one or two cells
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

}  // namespace

void extend_crack(State<2>& state, StepWork<2>& work, const Model<2>& model, const CrackTip& tip, const std::vector<Vec<2>>& places,
                  int reach) {
  Crack<2>& crack = state.cracks.list[tip.crack];
  for (const Vec<2>& x : places) add_vertex(crack, tip, x, state.observed.cracked[tip.crack]);
  view_cracks(state, work, model, reach);
  choose_anew(state, work, model, tip, places.size());
  if (model.growth[tip.crack].bridged && !crack.traction.area.empty())
    lay_tractions(crack, tip, places.size(), model.tractions[tip.crack].thickness);
}

void start_crack(State<2>& state, StepWork<2>& work, const Model<2>& model, std::uint32_t number, const std::vector<Vec<2>>& places,
                 int reach) {
  Crack<2>& crack = state.cracks.list[number];
  const std::size_t count = places.size();
  crack.plane = crack.upper = crack.lower = crack.original = places;
  crack.upper_carriers.resize(count), crack.lower_carriers.resize(count);
  crack.facets = path_facets(count);
  state.observed.cracked[number].assign(count, true);
  view_cracks(state, work, model, reach);
  CrackTip end;
  end.crack = number;
  choose_anew(state, work, model, end, count);
  if (!model.tractions[number].acts()) return;
  crack.traction = {std::vector<double>(count), std::vector<TractionHistory>(count), std::vector<Vec<2>>(count), std::vector<double>(count),
                    std::vector<bool>(count, true)};
  lay_tractions(crack, end, count - 1, model.tractions[number].thickness);
}

}  // namespace crampon
