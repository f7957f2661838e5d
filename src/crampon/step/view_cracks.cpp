#include "crampon/step/view_cracks.hpp"

#include "crampon/step/crack_images.hpp"

namespace crampon {

namespace {

/// A crack of the input with what lies beyond those of its ends that are no tips.
template <int Dim>
SeenCrack<Dim> with_extensions(const Crack<Dim>& crack) {
  SeenCrack<Dim> seen{crack.plane, crack.facets, {}, {}, {}, crack.closed};
  std::vector<Vec<Dim>> original = crack.original;
  if constexpr (Dim == 2) {  // in space the input will have to say which edges of a crack go on beyond it
    seen.vertices = extended(crack.plane, crack.extension);
    seen.facets = path_facets(seen.vertices.size());
    original = extended(crack.original, crack.extension);
  }
  seen.normals = facet_normals<Dim>(seen.vertices, seen.facets);
  seen.original_normals = facet_normals<Dim>(original, seen.facets);
  return seen;
}

}  // namespace

template <int Dim>
void view_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, int reach) {
  CrackView<Dim>& view = work.crack_view;
  const std::size_t count = state.cracks.size();
  view.cracks = count;
  view.seen.assign(count * (1 + model.symmetries.size()), {});
  for (std::size_t c = 0; c < count; ++c) {
    if (!state.cracks.list[c].plane.empty()) view.seen[c] = with_extensions(state.cracks.list[c]);
  }
  for (std::size_t plane = 0; plane < model.symmetries.size(); ++plane) {
    const double cell = model.grid.cell[static_cast<std::size_t>(model.symmetries[plane].axis)];
    const Mirror<Dim> mirror{model.symmetries[plane], 1e-8 * cell};
    for (std::size_t c = 0; c < count; ++c) {
      if (view.seen[c].vertices.empty()) continue;  // the crack has not started
      if (join_image(view.seen[c], mirror) || reach == 0 || !comes_near(view.seen[c], mirror, 2 * cell)) continue;
      view.seen[count * (1 + plane) + c] = image_of(view.seen[c], mirror);
    }
  }
  view.meshes.clear();
  for (SeenCrack<Dim>& crack : view.seen) {
    crack.neighbours = find_neighbours<Dim>(crack.facets, crack.vertices.size(), crack.closed);
    view.meshes.push_back(crack.mesh());
  }
  view.bins.build({model.grid.origin, model.grid.cell, model.grid.cells, reach, reach}, view.meshes);
}

template <int Dim>
CrackId seen_in_mirror(const CrackView<Dim>& view, CrackId crack, std::size_t plane) {
  const auto image_of_first = static_cast<CrackId>(view.cracks * (1 + plane));
  if (crack >= image_of_first && crack < image_of_first + view.cracks) return crack - image_of_first;
  if (crack >= view.cracks || view.seen[image_of_first + crack].vertices.empty()) return crack;
  return crack + image_of_first;
}

#define CRAMPON_INSTANTIATE(DIM)                                                       \
  template void view_cracks<DIM>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, int); \
  template CrackId seen_in_mirror<DIM>(const CrackView<DIM>&, CrackId, std::size_t);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
