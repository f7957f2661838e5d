#pragma once
/// What the faces of a crack do when they meet. A law is a small value type; the nodal solve (contact/node_solve.hpp)
/// turns it into impulses. Adding a law: one struct here or in its own file, one entry in ContactLawSpec and contact_laws().

#include <variant>

#include "crampon/core/declaration.hpp"

namespace crampon {

/// The faces do not see each other.
struct NoContact {
  static const Declaration<NoContact>& declaration();
};

/// Joined for good: no detection, equal to a body without the crack (CONVENTIONS 44).
struct BondedContact {
  static const Declaration<BondedContact>& declaration();
};

/// No slip while in contact and in compression; free to open.
struct StickContact {
  static const Declaration<StickContact>& declaration();
};

/// Slip without resistance.
struct FrictionlessContact {
  static const Declaration<FrictionlessContact>& declaration();
};

/// Coulomb friction: tangential impulse at most friction times the normal impulse.
struct CoulombContact {
  double friction = 0;  ///< coefficient mu, dimensionless
  static const Declaration<CoulombContact>& declaration();
};

using ContactLawSpec = std::variant<FrictionlessContact, NoContact, BondedContact, StickContact, CoulombContact>;

/// The family as the input sees it: `contact = { law = "coulomb", friction = 0.3 }`.
const Family<ContactLawSpec>& contact_laws();

}  // namespace crampon
