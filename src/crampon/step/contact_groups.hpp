#pragma once
/// Which velocity fields of a node move as one (conventions 13, 14).

#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Are fields on both sides one group? One after another, bonded pairs are pairs like others (N13, conventions 14).
template <int Dim>
bool joins(const Model<Dim>& model, const ContactLaw& law) {
  return law.joins() && model.contact.pairs == ContactPairs::joint;
}

/// A signature without the cracks that join: fields of one material that agree in it move as one (conventions 13, 14).
template <int Dim>
Signature without_joined(const Signature& s, const Model<Dim>& model) {
  Signature out;
  for (const CrackId c : s) {
    if (!joins(model, model.law_across(c))) out.append(c);
  }
  return out;
}

/// Fields on the same sides of all cracks that do not join are one group when a chain of bonded laws links them. present: layers of a block,
/// ascending; group_of: of each, groups by their first layer. Returns how many groups there are.
template <int Dim>
int find_groups(const BlockLayers<Dim>& layers, const Model<Dim>& model, const std::vector<int>& present, std::vector<int>& group_of);

}  // namespace crampon
