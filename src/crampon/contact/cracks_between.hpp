#pragma once
/// The cracks that lie between two sides of a node, taken as one (N13 sec. 2.3; docs/theory/contact.md, who meets whom).

#include <optional>
#include <vector>

#include "crampon/contact/contact_model.hpp"
#include "crampon/contact/node_facts.hpp"

namespace crampon {

template <int Dim>
struct CracksBetween {
  const ContactLaw* law = nullptr;  ///< the strictest of theirs
  ContactName name;
  CrackAtNode<Dim> as_one;   ///< the first of them, with the mean normal of all
  bool first_above = false;  ///< the first of the two sides is above
};

/// \param first, second  cracks that part either side from the node
/// \param cracks         what Task 1 left at the node about each crack
/// Empty when none of the cracks between them acts: contact acts as soon as one does.
template <int Dim>
std::optional<CracksBetween<Dim>> cracks_between(const Signature& first, const Signature& second,
                                                 const std::vector<CrackAtNode<Dim>>& cracks, const ContactModel<Dim>& contact);

}  // namespace crampon
