#pragma once
#include <algorithm>

#include "crampon/contact/node_facts.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// The symmetry planes on which a node of the grid lies.
template <int Dim>
Mirrors mirrors_at(const Model<Dim>& model, std::int64_t node_number) {
  Mirrors mirrors;
  for (const SymmetryPlane& plane : model.symmetries) {
    const std::vector<std::int64_t>& nodes = model.conditions[plane.condition].nodes;
    if (mirrors.axes >> plane.axis & 1u || !std::binary_search(nodes.begin(), nodes.end(), node_number)) continue;
    mirrors.axes |= 1u << plane.axis;
    mirrors.images *= 2;
  }
  return mirrors;
}

}  // namespace crampon
