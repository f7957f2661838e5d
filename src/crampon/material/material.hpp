#pragma once
/// The door to constitutive laws: what the step needs of a law, without knowing which law it is.
/// A law itself is a plain struct in its own file (material/neo_hookean.hpp). LawKernel in material_law.hpp wraps it; registry.cpp lists it.

#include <memory>
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/material/material_law.hpp"

namespace crampon {

/// A law with its parameters, shared by all particles made of it.
using MaterialSpec = std::shared_ptr<const MaterialLaw>;

/// The family as the input sees it: `law = "neo_hookean"` and the law's own keys.
Family<MaterialSpec>& materials();

/// Every law of the family once, with the parameters of its example: for what goes through all laws.
std::vector<MaterialSpec> material_examples();

/// The one line by which a law joins the family.
template <class Law>
void add_material(Family<MaterialSpec>& family) {
  static_assert(MaterialLawContract<Law>::complete);
  examples_of_family<MaterialSpec>().push_back(std::make_shared<LawKernel<Law>>(Law::example()));
  family.add<Law>(Law::declaration(), [](Law law) -> MaterialSpec { return std::make_shared<LawKernel<Law>>(law); });
}

}  // namespace crampon
