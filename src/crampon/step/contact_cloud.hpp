#pragma once
/// The particles about nodes where materials meet, one by one: what regressions for normals and gaps start from (N13 sec. 3 step 1).

#include <vector>

#include "crampon/core/vector.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// A particle that has a part in a node (S_ip > 1e-10).
template <int Dim>
struct CloudPoint {
  int layer = 0;                  ///< of the node's block
  std::uint32_t particle = 0;     ///< its place among all
  std::uint8_t mirrored = 0;      ///< bit k: x and F are those of its image across axis k
  GroupSet group = 0;             ///< at the node; set by who knows the groups
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

/// Columns of the deformation gradient since the start of a particle whose law says F: those that bear stress from the start begin with another.
template <int Dim>
std::array<Vec<Dim>, Dim> since_start(const Model<Dim>& model, std::uint32_t id, const std::array<Vec<Dim>, Dim>& F) {
  if (model.undeformed.empty()) return F;
  const std::array<Vec<Dim>, Dim>& back = model.undeformed[id];
  std::array<Vec<Dim>, Dim> of_start{};
  for (int k = 0; k < Dim; ++k) {
    for (int j = 0; j < Dim; ++j) of_start[k] += F[j] * back[k][j];
  }
  return of_start;
}

/// Particles by own node of a block, in the order of tiles and packs, so that sums over them do not depend on threads.
template <int Dim>
class ContactCloud {
 public:
  /// Collects what reaches the nodes for which wanted[node] holds: all particles, or those that are not known to lie deep in their body.
  enum class Of { all, surface };
  template <class Shape>
  void collect(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block,
               const std::vector<bool>& wanted, Of of = Of::all);
  void clear() {
    for (auto& points : points_) points.clear();
  }
  std::vector<CloudPoint<Dim>>& at(int node) { return points_[static_cast<std::size_t>(node)]; }
  /// Adds the images of the particles of a node on a symmetry plane across axis k.
  void add_images(int node, int k) {
    auto& points = at(node);
    const std::size_t count = points.size();
    points.reserve(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      CloudPoint<Dim> image = points[i];
      image.x[k] = -image.x[k];
      image.mirror(k);
      points.push_back(image);
    }
  }

 private:
  std::vector<std::vector<CloudPoint<Dim>>> points_{block_nodes<Dim>};
};

}  // namespace crampon
