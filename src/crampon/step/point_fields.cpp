#include "crampon/step/point_fields.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/crack/crossing.hpp"
#include "crampon/step/assemble.hpp"

namespace crampon {

namespace {

/// Weights along one axis of a point without size. first: the lowest of `count` nodes.
struct AxisWeights {
  int first = 0, count = 0;
  std::array<double, most_nodes_along_axis> w{}, dw{};  ///< and slopes, per cell
};

AxisWeights linear_weights(double g) {
  AxisWeights out;
  out.first = static_cast<int>(std::floor(g));
  out.count = 2;
  out.w[0] = 1 - (g - out.first);
  out.w[1] = g - out.first;
  out.dw[0] = -1;
  out.dw[1] = 1;
  return out;
}

template <class Shape>
AxisWeights weights_of(double g) {
  AxisWeights out;
  const double from_lowest = g + (Shape::bin_shift - Shape::below), first = std::floor(from_lowest);
  Pack N[Shape::width], dN[Shape::width];
  Shape::weights(splat(from_lowest - first), 0., 1., N, dN);
  out.first = static_cast<int>(first);
  out.count = Shape::width;
  for (int n = 0; n < Shape::width; ++n) {
    out.w[static_cast<std::size_t>(n)] = N[n][0];
    out.dw[static_cast<std::size_t>(n)] = dN[n][0];
  }
  return out;
}

/// g: place along the axis, in cells from the grid's origin. Functions of particles with a size are linear functions when the size is none.
template <int Dim>
AxisWeights axis_weights(const Model<Dim>& model, double g) {
  if (model.crack_shape_functions == CrackShapeFunctions::linear) return linear_weights(g);
  return with_shape(model.shape_functions, [g]<class Shape>(std::type_identity<Shape>) {
    if constexpr (Shape::boxes.of_points() && Shape::boxes.cell > 2) {
      return weights_of<Shape>(g);
    } else {
      return linear_weights(g);
    }
  });
}

/// Axes across the mirrors on which a vertex lies, behind which the crack goes on as its image: bit k.
template <int Dim>
unsigned mirrors_at_vertex(const Crack<Dim>& crack, std::size_t v) {
  unsigned axes = 0;
  if constexpr (Dim == 2) {  // in space nothing tells yet which edges of a crack end on a mirror
    if (v == 0) axes |= crack.mirrored[0];
    if (v + 1 == crack.plane.size()) axes |= crack.mirrored[1];
  }
  return axes;
}

}  // namespace

template <int Dim>
std::vector<Vec<Dim>> vertex_normals(const Crack<Dim>& crack) {
  std::vector<Vec<Dim>> normals(crack.plane.size());
  for (const Facet<Dim>& facet : crack.facets) {
    const Vec<Dim> n = Dim == 2 ? facet_normal<Dim>(crack.plane, facet) : area_vector<Dim>(crack.plane, facet);
    for (const VertexId v : facet) normals[v] += n;
  }
  if (crack.closed) {
    normals.front() += normals.back();
    normals.back() = normals.front();
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    // With the normal of the image, what is across a mirror cancels.
    Vec<Dim> in_mirrors = normals[v];
    const unsigned axes = mirrors_at_vertex(crack, v);
    for (int k = 0; k < Dim; ++k) {
      if (axes >> k & 1u) in_mirrors[k] = 0;
    }
    normals[v] = normalized(in_mirrors == Vec<Dim>{} ? normals[v] : in_mirrors);
  }
  return normals;
}

template <int Dim>
PointNodes<Dim> PointFields<Dim>::nodes(const Vec<Dim>& x) const {
  const Grid<Dim>& grid = model_.grid;
  PointNodes<Dim> out;
  std::array<AxisWeights, Dim> along;
  for (int k = 0; k < Dim; ++k) along[k] = axis_weights(model_, (x[k] - grid.origin[k]) * grid.inverse_cell[k]);
  const auto look_at = [&](const IndexVector<Dim>& i) {
    double S = along[0].w[i[0]];
    Vec<Dim> G;
    IndexVector<Dim> node, block;
    for (int k = 1; k < Dim; ++k) S *= along[k].w[i[k]];
    if (S == 0) return;
    int local = 0;
    for (int k = Dim - 1; k >= 0; --k) {
      node[k] = along[k].first + i[k];
      if (node[k] < -block_side) return;
      block[k] = Grid<Dim>::block_of(node[k]);
      if (block[k] >= grid.blocks[k]) return;
      local = local * block_side + node[k] - Grid<Dim>::first_node(block[k]);
    }
    const std::uint32_t there = work_.blocks.of_number[static_cast<std::size_t>(grid.block_number(block))];
    if (there == no_block) return;
    for (int d = 0; d < Dim; ++d) {
      G[d] = d == 0 ? along[0].dw[i[0]] : along[0].w[i[0]];
      for (int k = 1; k < Dim; ++k) G[d] *= d == k ? along[k].dw[i[k]] : along[k].w[i[k]];
      G[d] *= grid.inverse_cell[d];
    }
    out.push_back({S, G, grid.node_position(node), there, local, 0});
  };
  IndexVector<Dim> i{};
  for (int k = 0; k < (Dim == 3 ? along[Dim - 1].count : 1); ++k) {
    if constexpr (Dim == 3) i[2] = k;
    for (i[1] = 0; i[1] < along[1].count; ++i[1]) {
      for (i[0] = 0; i[0] < along[0].count; ++i[0]) look_at(i);
    }
  }
  return out;
}

template <int Dim>
Vec<Dim> PointFields<Dim>::beside(const Vec<Dim>& vertex, const Vec<Dim>& out) const {
  Vec<Dim> x = vertex + out * nudge_;
  for (const SymmetryPlane& plane : model_.symmetries) {
    const auto k = static_cast<std::size_t>(plane.axis);
    if (std::fabs(vertex[k] - plane.at) < nudge_) x[k] = plane.at + plane.side * 0.01 * nudge_;
  }
  return x;
}

/// f(crack, i) for every place i that a crack parts from `from`, by cracks, ascending.
template <int Dim>
template <class F>
void PointFields<Dim>::for_crossings(const Vec<Dim>& from, std::span<const Vec<Dim>> places, F f) const {
  // The cells of all lines; what a line only touches, or rounding puts beside it, is within the bins' margin.
  constexpr double touching = 1e-10;
  std::array<int, Dim> low, high;
  for (std::size_t k = 0; k < Dim; ++k) {
    double least = from[k], most = from[k];
    for (const Vec<Dim>& x : places) {
      least = std::min(least, x[k]);
      most = std::max(most, x[k]);
    }
    const double origin = model_.grid.origin[k], per_cell = model_.grid.inverse_cell[k];
    low[k] = static_cast<int>(std::floor((least - origin) * per_cell + touching));
    high[k] = std::max(low[k], static_cast<int>(std::ceil((most - origin) * per_cell - touching)) - 1);
  }
  static thread_local std::vector<FacetRef> room;
  const std::span<const FacetRef> facets = work_.crack_view.bins.facets_of_box(low, high, room);
  std::array<Crossing<Dim>, most_nodes<Dim>> crossings;
  for (std::size_t k = 0; k < facets.size();) {
    const CrackId c = facets[k].crack;
    const std::size_t first = k;
    while (k < facets.size() && facets[k].crack == c) ++k;
    cross_stencil<Dim>(work_.crack_view.meshes[c], facets.subspan(first, k - first), from, places, {crossings.data(), places.size()});
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (crossings[i].crosses()) f(c, i);
    }
  }
}

template <int Dim>
bool PointFields<Dim>::parted(const Vec<Dim>& particle, const Vec<Dim>& point) const {
  bool parted = false;
  for_crossings(particle, {&point, 1}, [&](CrackId, std::size_t) { parted = true; });
  return parted;
}

template <int Dim>
PointNodes<Dim> PointFields<Dim>::at(const Vec<Dim>& x, std::uint16_t field) const {
  const PointNodes<Dim> about = nodes(x);
  std::array<Vec<Dim>, most_nodes<Dim>> places;
  for (std::size_t i = 0; i < about.size(); ++i) places[i] = about[i].x;
  std::array<Layer, most_nodes<Dim>> seen{};
  if (!work_.crack_view.meshes.empty() && !model_.ignores_cracks(field)) {
    for_crossings(x, {places.data(), about.size()}, [&](CrackId c, std::size_t i) { seen[i].cracks.append(c); });
  }
  PointNodes<Dim> out;
  for (std::size_t i = 0; i < about.size(); ++i) {
    PointNode<Dim> node = about[i];
    seen[i].field = field;
    const BlockLayers<Dim>& layers = work_.nodes.layers[node.block];
    const int layer = layer_of<Dim>(layers.node, seen[i]);
    if (layer < 0) continue;
    node.slot = layers.slot(layer, node.local);
    if (work_.nodes.momentum[node.slot][Dim] > 0) out.push_back(node);
  }
  return out;
}

template <int Dim>
Vec<Dim> velocity_at(const StepWork<Dim>& work, const PointNodes<Dim>& nodes) {
  Vec<Dim> v;
  for (const PointNode<Dim>& node : nodes) {
    for (int k = 0; k < Dim; ++k) v[k] += node.S * work.nodes.velocity[node.slot][k];
  }
  return v;
}

template <int Dim>
std::array<Vec<Dim>, Dim> velocity_gradient_at(const StepWork<Dim>& work, const PointNodes<Dim>& nodes) {
  std::array<Vec<Dim>, Dim> L{};
  for (const PointNode<Dim>& node : nodes) {
    for (int d = 0; d < Dim; ++d) {
      for (int k = 0; k < Dim; ++k) L[d][k] += work.nodes.velocity[node.slot][d] * node.G[k];
    }
  }
  return L;
}

#define CRAMPON_INSTANTIATE(DIM)                                                    \
  template std::vector<Vec<DIM>> vertex_normals<DIM>(const Crack<DIM>&);            \
  template class PointFields<DIM>;                                                  \
  template Vec<DIM> velocity_at<DIM>(const StepWork<DIM>&, const PointNodes<DIM>&); \
  template std::array<Vec<DIM>, DIM> velocity_gradient_at<DIM>(const StepWork<DIM>&, const PointNodes<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
