#include <algorithm>

#include "crampon/step/carrier_choice.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/point_fields.hpp"
#include "crampon/step/verbs.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {

namespace {

template <int Dim>
void choose_for_all(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const CarrierChoice<Dim> choice(state, work, model);
  const PointFields<Dim> surroundings(work, model);
  for (Crack<Dim>& crack : state.cracks.list) {
    crack.upper_carriers.resize(crack.plane.size());
    crack.lower_carriers.resize(crack.plane.size());
    const std::vector<Vec<Dim>> normals = vertex_normals(crack);
    for (std::size_t v = 0; v < crack.plane.size(); ++v) {
      const Vec<Dim>& x = crack.plane[v];
      const Vec<Dim>& down = normals[v];
      crack.upper_carriers[v] = choice.carriers(x, surroundings.beside(x, -down));
      crack.lower_carriers[v] = choice.carriers(x, surroundings.beside(x, down));
    }
  }
}

}  // namespace

template <int Dim, class Shape>
void choose_carriers(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const auto& cracks = state.cracks.list;
  if (std::none_of(cracks.begin(), cracks.end(), [](const Crack<Dim>& c) { return !c.plane.empty() && c.upper_carriers.empty(); })) return;
  view_cracks(state, work, model, cells_beyond<Shape>);
  choose_for_all(state, work, model);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void choose_carriers<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
