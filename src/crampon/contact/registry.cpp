#include "crampon/contact/law.hpp"
#include "crampon/contact/laws/adhesive.hpp"
#include "crampon/contact/laws/bonded.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/contact/laws/interface.hpp"
#include "crampon/contact/laws/none.hpp"
#include "crampon/contact/laws/rate_weakening.hpp"
#include "crampon/contact/laws/slip_weakening.hpp"
#include "crampon/contact/laws/speed_friction.hpp"
#include "crampon/contact/laws/stick.hpp"
#include "crampon/contact/laws/viscous.hpp"

namespace crampon {

std::vector<ContactLawSpec> contact_law_examples() {
  contact_laws();  // laws join as the family is made
  return examples_of_family<ContactLawSpec>();
}

ContactLawSpec::ContactLawSpec() {
  // One for all: models have a law for each pair of fields.
  static const auto frictionless = std::make_shared<const ContactLawOf<FrictionlessContact>>(FrictionlessContact{});
  law_ = frictionless;
}

// A further law is one file like laws/coulomb.hpp and one line here.
Family<ContactLawSpec>& contact_laws() {
  static Family<ContactLawSpec> family = [] {
    Family<ContactLawSpec> f("contact law", "law", "What two bodies, or the faces of a crack, do when they meet.");
    add_contact_law<FrictionlessContact>(f);
    add_contact_law<NoContact>(f);
    add_contact_law<BondedContact>(f);
    add_contact_law<StickContact>(f);
    add_contact_law<CoulombContact>(f);
    add_contact_law<AdhesiveContact>(f);
    add_contact_law<SpeedFrictionContact>(f);
    add_contact_law<RateWeakeningContact>(f);
    add_contact_law<SlipWeakeningContact>(f);
    add_contact_law<ViscousContact>(f);
    add_contact_law<InterfaceContact>(f);
    return f;
  }();
  return family;
}

}  // namespace crampon
