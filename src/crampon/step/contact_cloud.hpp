#pragma once
/// Gathers the particles about nodes where materials meet, one by one.

#include <vector>

#include "crampon/contact/node_facts.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

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

 private:
  std::vector<std::vector<CloudPoint<Dim>>> points_{block_nodes<Dim>};
};

}  // namespace crampon
