#pragma once
/// What two bodies, or the faces of a crack, do when they meet. A law is a small value type; the nodal solve
/// (contact/node_solve.hpp) turns it into impulses, and friction.hpp says how much it resists sliding. Adding a law: one struct here
/// or in its own file, one entry in ContactLawSpec and contact_laws(), one overload in friction.cpp.

#include <cmath>
#include <optional>
#include <variant>

#include "crampon/core/declaration.hpp"

namespace crampon {

/// The two do not see each other.
struct NoContact {
  static const Declaration<NoContact>& declaration();
};

/// Joined for good: no detection, equal to a body without the boundary (conventions 44).
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
  double friction = 0;                         ///< coefficient mu of sliding, dimensionless
  std::optional<double> static_friction = {};  ///< ... at the onset of sliding; none: the same
  std::optional<double> strength = {};         ///< most shear stress that friction reaches, Pa; none: no limit
  static const Declaration<CoulombContact>& declaration();
};

/// Faces that have met hold together until (S/shear_strength)^2 + (N/normal_strength)^2 = 1; friction and the shear strength resist
/// sliding under pressure.
struct AdhesiveContact {
  double friction = 0;         ///< dimensionless
  double shear_strength = 0;   ///< S_a, Pa
  double normal_strength = 0;  ///< N_a, Pa
  static const Declaration<AdhesiveContact>& declaration();
};

/// mu = friction + per_speed * v.
struct SpeedFrictionContact {
  double friction = 0;        ///< dimensionless, at no speed
  double per_speed = 0;       ///< k, s/m; negative: weakening
  double shear_strength = 0;  ///< S_a, Pa
  static const Declaration<SpeedFrictionContact>& declaration();
};

/// mu = friction + (static_friction - friction)/(1 + v/half_speed): from rest smoothly down to sliding.
struct RateWeakeningContact {
  double friction = 0, static_friction = 0;  ///< dimensionless
  double half_speed = 0;                     ///< v_h, m/s
  double shear_strength = 0;                 ///< S_a, Pa
  static const Declaration<RateWeakeningContact>& declaration();
};

/// Friction that falls from static_friction to friction, and cohesion that vanishes, with the distance slipped.
struct SlipWeakeningContact {
  enum class Decay { exponential, linear };
  double friction = 0, static_friction = 0;  ///< dimensionless
  double distance = 0;                       ///< d_c, m
  double shear_strength = 0;                 ///< S_a at no slip, Pa
  Decay decay = Decay::exponential;
  static const Declaration<SlipWeakeningContact>& declaration();
};

/// A film of liquid: shear stress viscosity * v / film.
struct ViscousContact {
  double viscosity = 0;  ///< eta, Pa s
  double film = 0;       ///< thickness h_l, m
  static const Declaration<ViscousContact>& declaration();
};

/// An imperfect interface: tractions in proportion to the displacement across it (docs/theory/contact.md, interfaces).
struct InterfaceContact {
  double tangential = 0;                       ///< D_t, Pa/m; infinite: no slip
  double tension = 0;                          ///< D_nt, Pa/m; infinite: does not open
  double compression = HUGE_VAL;               ///< D_nc, Pa/m; infinite: does not close
  std::optional<double> shear_strength = {};   ///< Pa; reached: the interface is gone and contact is left
  std::optional<double> normal_strength = {};  ///< Pa
  double friction = 0;                         ///< of that contact
  bool can_fail() const { return shear_strength || normal_strength; }
  static const Declaration<InterfaceContact>& declaration();
};

using ContactLawSpec = std::variant<FrictionlessContact, NoContact, BondedContact, StickContact, CoulombContact, AdhesiveContact,
                                    SpeedFrictionContact, RateWeakeningContact, SlipWeakeningContact, ViscousContact, InterfaceContact>;

/// The family as the input sees it: `contact = { law = "coulomb", friction = 0.3 }`.
const Family<ContactLawSpec>& contact_laws();

}  // namespace crampon
