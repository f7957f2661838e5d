#pragma once
/// What contact starts from at one node: all that Task 1 left there, as plain values.

#include <array>
#include <cstdint>
#include <vector>

#include "crampon/contact/node_solve.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/layers.hpp"

namespace crampon {

/// The symmetry planes on which a node lies.
struct Mirrors {
  unsigned axes = 0;  ///< bit k: one across axis k
  double images = 1;  ///< how many times what the model has is there

  /// A vector and its image together: the component across is gone.
  template <int Dim>
  Vec<Dim> together(Vec<Dim> a) const {
    for (int k = 0; k < Dim; ++k) a[k] *= axes >> k & 1u ? 0. : images;
    return a;
  }
  /// The mean of both.
  template <int Dim>
  Vec<Dim> mean(Vec<Dim> a) const {
    for (int k = 0; k < Dim; ++k) a[k] *= axes >> k & 1u ? 0. : 1.;
    return a;
  }
};

/// A particle that has a part in a node (S_ip > 1e-10): what regressions for normals and gaps start from (N13 sec. 3 step 1).
template <int Dim>
struct CloudPoint {
  int layer = 0;                  ///< of the node's block
  std::uint32_t particle = 0;     ///< its place among all
  std::uint8_t mirrored = 0;      ///< bit k: x and F are those of its image across axis k
  GroupSet group = 0;             ///< its group at the node
  Vec<Dim> x;                     ///< from the node, m; of a folded pair the mirror image
  double S = 0;                   ///< S_ip
  double m = 0;                   ///< m_p S_ip, kg
  std::array<Vec<Dim>, Dim> F{};  ///< columns of its deformation gradient
  Vec<Dim> half_size;             ///< of the particle at the start, m
  /// From its middle to the nearest point of its body's surface now, m; zero: it lies deep, or nobody asks; not a number: nobody knows.
  Vec<Dim> to_surface;

  /// From the middle of the deformed particle to the middles of its faces, m.
  std::array<Vec<Dim>, Dim> half_edges() const {
    std::array<Vec<Dim>, Dim> r = F;
    for (int k = 0; k < Dim; ++k) r[k] *= half_size[k];
    return r;
  }
  /// Its F and way to the surface in a mirror across axis k.
  void mirror(int k) {
    for (auto& column : F) column[k] = -column[k];
    F[k] = -F[k];
    to_surface[k] = -to_surface[k];
  }
};

/// Adds the images across axis k of all points, for a node on a symmetry plane.
template <int Dim>
void add_images(std::vector<CloudPoint<Dim>>& points, int k) {
  const std::size_t count = points.size();
  points.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    CloudPoint<Dim> image = points[i];
    image.x[k] = -image.x[k];
    image.mirror(k);
    points.push_back(image);
  }
}

/// One velocity field with mass at the node, and the sums that its particles left there.
template <int Dim>
struct FieldAtNode {
  int layer = 0;            ///< of the node's block
  std::uint16_t field = 0;  ///< material field
  Signature cracks;         ///< those that part it from the node
  int group = 0;            ///< among those of the node (contact/groups.hpp)
  double m = 0;             ///< sum of m_p S_ip, kg
  double volume = 0;        ///< sum of V_p S_ip, m3; in 2D m2
  Vec<Dim> x, X, g;         ///< sums of m (x - x_i), m (X - x_i), V_p G_ip
  double history = 0;       ///< sum of m c, c what particles remember of contact
};

/// What Task 1 left at the node about one crack: unit normals now and at the start, and the side of the particles across.
template <int Dim>
struct CrackAtNode {
  CrackId crack = 0;
  Vec<Dim> n, N;
  double side = 0;
};

/// The node, with the part of the model that it sees: on a symmetry plane without the images.
template <int Dim>
struct NodeFacts {
  std::int64_t number = 0;  ///< in the grid
  Mirrors mirrors;
  int groups = 0;
  std::vector<FieldAtNode<Dim>> fields;
  std::vector<CrackAtNode<Dim>> cracks;
  std::vector<CloudPoint<Dim>> cloud;  ///< where normals, gaps or springs ask for it, else empty
};

}  // namespace crampon
