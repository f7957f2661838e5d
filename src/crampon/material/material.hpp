#pragma once
/// The door to constitutive laws: what the step needs of a law, without knowing which law it is.
/// A law itself is a plain struct in its own file (material/neo_hookean.hpp); law_kernel.hpp wraps it; registry.cpp lists it.

#include <memory>

#include "crampon/core/declaration.hpp"

namespace crampon {

class MaterialLaw;  // material/material_law.hpp
/// A law with its parameters, shared by all particles made of it.
using MaterialSpec = std::shared_ptr<const MaterialLaw>;

/// The family as the input sees it: `law = "neo_hookean"` and the law's own keys.
Family<MaterialSpec>& materials();

}  // namespace crampon
