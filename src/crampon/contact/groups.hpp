#pragma once
/// Which velocity fields of a node move as one (conventions 13, 14).

#include <vector>

#include "crampon/contact/contact_model.hpp"

namespace crampon {

/// A signature without the cracks that join: fields of one material that agree in it move as one (conventions 13, 14).
template <int Dim>
Signature without_bonded(const Signature& s, const ContactModel<Dim>& contact) {
  Signature out;
  for (const CrackId c : s) {
    if (!contact.makes_one_group(contact.law_across(c))) out.append(c);
  }
  return out;
}

/// Fields on the same sides of all cracks that do not join are one group when a chain of bonded laws links them. present: those of `layers` that
/// have mass at the node, ascending; group_of: of each, groups by their first layer. Returns how many groups there are.
template <int Dim>
int find_groups(const std::vector<Layer>& layers, const ContactModel<Dim>& contact, const std::vector<int>& present,
                std::vector<int>& group_of);

}  // namespace crampon
