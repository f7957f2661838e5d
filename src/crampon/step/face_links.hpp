#pragma once
/// Particles' parts in the columns below loaded faces (step/loaded_faces.hpp), as the grid sees them (docs/theory/loads.md).

#include <algorithm>
#include <array>
#include <cmath>

#include "crampon/shape/stencil.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// cof F = det F inverse(F)^T: takes area vectors along.
template <int Dim>
std::array<double, Dim * Dim> cofactor(const std::array<double, Dim * Dim>& F) {
  if constexpr (Dim == 2) {
    return {F[3], -F[2], -F[1], F[0]};
  } else {
    std::array<double, 9> C;
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t d1 = (d + 1) % 3, d2 = (d + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        C[d * 3 + k] = F[d1 * 3 + k1] * F[d2 * 3 + k2] - F[d1 * 3 + k2] * F[d2 * 3 + k1];
      }
    }
    return C;
  }
}

template <int Dim>
Vec<Dim> column_of(const std::array<double, Dim * Dim>& F, std::size_t k) {
  Vec<Dim> out;
  for (std::size_t d = 0; d < Dim; ++d) out[d] = F[d * Dim + k];
  return out;
}

/// A link seen on the grid: how much of its stress reaches a node, and the force on it, per unit of traction.
template <int Dim, class Shape>
class LinkWeights {
 public:
  /// half_size: the same for all particles of a column, so that nodes see whole columns.
  LinkWeights(const Grid<Dim>& grid, const HalfSize<Dim>& half_size, const FaceLink& link, const FaceColumn& column,
              const std::array<double, Dim * Dim>& F, const Vec<Dim>& x_p)
      : link_(link) {
    const double outward = link.mirrored ? -column.direction : column.direction;
    flux_ = column_of<Dim>(F, column.axis) * (outward * link.flux);
    if (!link.ends) return;
    normal_ = column_of<Dim>(cofactor<Dim>(F), column.axis) * outward;
    const double area = norm(normal_);  // of the deformed face over that of the undeformed one; det F = area * thickness
    normal_ *= 1 / area;
    const double thickness = dot(normal_, column_of<Dim>(F, column.axis)) * outward;
    below_ = link.depth * thickness + dot(normal_, x_p);
    for (int k = 0; k < Dim; ++k) {
      const double across = std::fabs(normal_[k]) * grid.cell[k];
      reach_ += Shape::reach(half_size[k]) * across;
      ramp_ += across;
    }
  }
  /// Force on a node at x per unit of traction, but for the rest.
  double operator()(const Vec<Dim>& x, double S, const Vec<Dim>& G) const {
    const double whole = dot(flux_, G) + S * link_.source;
    if (!link_.ends) return whole;
    const double depth = below_ - dot(normal_, x);
    return whole * std::clamp((reach_ + ramp_ - depth) / ramp_, 0., 1.);
  }

 private:
  const FaceLink& link_;
  Vec<Dim> flux_, normal_;
  double below_ = 0, reach_ = 0, ramp_ = 0;
};

/// As far as domains may reach.
template <int Dim, class Shape>
HalfSize<Dim> reaching_half_size(const Material<Dim>& material) {
  HalfSize<Dim> half = material.half_size;
  if (Shape::has_domains) half.fill(largest_half_extent);
  return half;
}

/// f(weight, S, n) for all nodes n of a particle's stencil.
template <int Dim, class Shape, class F>
[[gnu::always_inline]] inline void for_nodes(const LinkWeights<Dim, Shape>& weights, const Grid<Dim>& grid,
                                             const IndexVector<Dim>& first_node, const Stencil<Dim, Shape>& stencil, int l, F f) {
  using T = Tile<Dim, Shape>;
  const auto lowest = unflatten<Dim>(stencil.of.lowest(l), T::side);
  for (int n = 0; n < T::stencil; ++n) {
    const auto step = unflatten<Dim>(n, Shape::width);
    Vec<Dim> x, G;
    for (int k = 0; k < Dim; ++k) {
      x[k] = grid.node_coordinate(k, lowest[k] + step[k] + first_node[k] - T::offset);
      G[k] = stencil.slope(n, k, l);
    }
    const double S = stencil.weight(n, l);
    f(weights(x, S, G), S, n);
  }
}

/// f(link number, link, column) for what a particle has a part in.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_links(const LoadedFaces<Dim>& faces, std::uint32_t particle, F f) {
  for (std::uint32_t i = faces.first_of[particle]; i < faces.first_of[particle + 1]; ++i) {
    const FaceLink& link = faces.links[faces.by_particle[i]];
    f(faces.by_particle[i], link, faces.columns[link.column]);
  }
}

/// Force on a face per area that it had undeformed, Pa. area_vector: of the deformed face over the undeformed area.
template <int Dim>
Vec<Dim> traction_on(const Load<Dim>& load, const FaceColumn& column, const Vec<Dim>& area_vector, const Vec<Dim>& value) {
  return load.kind == Load<Dim>::Kind::pressure ? area_vector * -value[0] : value * column.share;
}

}  // namespace crampon
