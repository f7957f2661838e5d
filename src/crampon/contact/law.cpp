#include "crampon/contact/law.hpp"

namespace crampon {

const Declaration<NoContact>& NoContact::declaration() {
  static const auto d = Declaration<NoContact>("none", "The faces pass through each other.");
  return d;
}

const Declaration<BondedContact>& BondedContact::declaration() {
  static const auto d = Declaration<BondedContact>("bonded", "The faces are joined for good, as if there were no crack.");
  return d;
}

const Declaration<StickContact>& StickContact::declaration() {
  static const auto d = Declaration<StickContact>("stick", "No slip while the faces press on each other; free to open.");
  return d;
}

const Declaration<FrictionlessContact>& FrictionlessContact::declaration() {
  static const auto d = Declaration<FrictionlessContact>("frictionless", "The faces do not interpenetrate and slip without resistance.");
  return d;
}

const Declaration<CoulombContact>& CoulombContact::declaration() {
  static const auto d = Declaration<CoulombContact>("coulomb", "Stick up to the friction limit, then slip against a constant ratio.")
                            .quantity("friction", &CoulombContact::friction, "1", Bounds::non_negative(),
                                      "coefficient of friction: tangential over normal impulse at the onset of slip", Presence::required);
  return d;
}

const Family<ContactLawSpec>& contact_laws() {
  static const auto family = Family<ContactLawSpec>("contact law", "law", "What the faces of a crack do when they meet.")
                                 .add(FrictionlessContact::declaration())
                                 .add(NoContact::declaration())
                                 .add(BondedContact::declaration())
                                 .add(StickContact::declaration())
                                 .add(CoulombContact::declaration());
  return family;
}

}  // namespace crampon
