#include "crampon/step/fixed_components.hpp"

namespace crampon {

template <int Dim>
unsigned fixed_axes(const StepWork<Dim>& work, std::size_t b, int node) {
  unsigned axes = 0;
  const auto& fixed = work.scratch[b].fixed;
  auto at = std::lower_bound(fixed.begin(), fixed.end(), node, [](const FixedComponent& c, int n) { return c.node < n; });
  for (; at != fixed.end() && at->node == node; ++at) {
    if (at->active) axes |= 1u << at->axis;
  }
  return axes;
}

template unsigned fixed_axes<2>(const StepWork<2>&, std::size_t, int);
template unsigned fixed_axes<3>(const StepWork<3>&, std::size_t, int);

}  // namespace crampon
