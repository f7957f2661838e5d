#include "crampon/contact/law.hpp"

#include <fmt/format.h>

namespace crampon {

namespace {

constexpr Presence required = Presence::required;

}  // namespace

const Declaration<NoContact>& NoContact::declaration() {
  static const auto d = Declaration<NoContact>("none", "The two pass through each other.");
  return d;
}

const Declaration<BondedContact>& BondedContact::declaration() {
  static const auto d = Declaration<BondedContact>("bonded", "Joined for good, as if there were no boundary between the two.");
  return d;
}

const Declaration<StickContact>& StickContact::declaration() {
  static const auto d = Declaration<StickContact>("stick", "No slip while the two press on each other; free to open.");
  return d;
}

const Declaration<FrictionlessContact>& FrictionlessContact::declaration() {
  static const auto d = Declaration<FrictionlessContact>("frictionless", "The two do not interpenetrate and slip without resistance.");
  return d;
}

const Declaration<CoulombContact>& CoulombContact::declaration() {
  static const auto d = Declaration<CoulombContact>("coulomb", "Stick up to the friction limit, then slip against a constant ratio.")
                            .quantity("friction", &CoulombContact::friction, "1", Bounds::non_negative(),
                                      "coefficient of friction: tangential over normal impulse while sliding", required)
                            .quantity("static_friction", &CoulombContact::static_friction, "1", Bounds::non_negative(),
                                      "coefficient at the onset of sliding; left out: the same as friction")
                            .quantity("strength", &CoulombContact::strength, "Pa", Bounds::positive(),
                                      "shear stress that friction never exceeds; left out: no limit")
                            .check([](const CoulombContact& in, Diagnostics& diagnostics) {
                              if (in.static_friction && *in.static_friction < in.friction)
                                diagnostics.add("static_friction", "static_friction is below friction",
                                                fmt::format("{} < {}", *in.static_friction, in.friction),
                                                "more is needed to start sliding than to keep it up");
                            });
  return d;
}

const Declaration<AdhesiveContact>& AdhesiveContact::declaration() {
  static const auto d = Declaration<AdhesiveContact>(
                            "adhesive",
                            "What has met holds together until (S/shear_strength)^2 + (N/normal_strength)^2 reaches 1; under pressure "
                            "the shear strength adds to friction.")
                            .quantity("friction", &AdhesiveContact::friction, "1", Bounds::non_negative(), "coefficient of friction")
                            .quantity("shear_strength", &AdhesiveContact::shear_strength, "Pa", Bounds::positive(),
                                      "shear stress that adhesion bears", required)
                            .quantity("normal_strength", &AdhesiveContact::normal_strength, "Pa", Bounds::positive(),
                                      "tensile stress that adhesion bears", required);
  return d;
}

const Declaration<SpeedFrictionContact>& SpeedFrictionContact::declaration() {
  static const auto d =
      Declaration<SpeedFrictionContact>("speed_friction",
                                        "Friction that changes in proportion to the speed of sliding: friction + per_speed v.")
          .quantity("friction", &SpeedFrictionContact::friction, "1", Bounds::non_negative(), "coefficient of friction at no speed",
                    required)
          .quantity("per_speed", &SpeedFrictionContact::per_speed, "s/m", Bounds::any(), "what a speed of 1 m/s adds to it", required)
          .quantity("shear_strength", &SpeedFrictionContact::shear_strength, "Pa", Bounds::non_negative(),
                    "shear stress that is borne without pressure");
  return d;
}

const Declaration<RateWeakeningContact>& RateWeakeningContact::declaration() {
  static const auto d =
      Declaration<RateWeakeningContact>("rate_weakening", "Friction that falls smoothly from rest to sliding.")
          .quantity("friction", &RateWeakeningContact::friction, "1", Bounds::non_negative(), "coefficient at high speed", required)
          .quantity("static_friction", &RateWeakeningContact::static_friction, "1", Bounds::non_negative(), "coefficient at rest", required)
          .quantity("half_speed", &RateWeakeningContact::half_speed, "m/s", Bounds::positive(), "speed at which half of the fall is done",
                    required)
          .quantity("shear_strength", &RateWeakeningContact::shear_strength, "Pa", Bounds::non_negative(),
                    "shear stress that is borne without pressure")
          .check([](const RateWeakeningContact& in, Diagnostics& diagnostics) {
            if (in.static_friction < in.friction)
              diagnostics.add("static_friction", "static_friction is below friction",
                              fmt::format("{} < {}", in.static_friction, in.friction),
                              "use speed_friction for friction that rises with speed");
          });
  return d;
}

const Declaration<SlipWeakeningContact>& SlipWeakeningContact::declaration() {
  using Decay = SlipWeakeningContact::Decay;
  static const auto d =
      Declaration<SlipWeakeningContact>("slip_weakening", "Friction that falls, and cohesion that vanishes, with the distance slipped.")
          .quantity("friction", &SlipWeakeningContact::friction, "1", Bounds::non_negative(), "coefficient after long slip", required)
          .quantity("static_friction", &SlipWeakeningContact::static_friction, "1", Bounds::non_negative(), "coefficient before slip",
                    required)
          .quantity("distance", &SlipWeakeningContact::distance, "m", Bounds::positive(), "distance of slip over which they change",
                    required)
          .quantity("shear_strength", &SlipWeakeningContact::shear_strength, "Pa", Bounds::non_negative(),
                    "cohesion: shear stress borne without pressure before slip")
          .choice("decay", &SlipWeakeningContact::decay, {{"exponential", Decay::exponential}, {"linear", Decay::linear}},
                  "how the coefficient falls; cohesion always falls linearly");
  return d;
}

const Declaration<ViscousContact>& ViscousContact::declaration() {
  static const auto d =
      Declaration<ViscousContact>("viscous", "A film of liquid between the two: shear stress is viscosity times speed over its thickness.")
          .quantity("viscosity", &ViscousContact::viscosity, "Pa s", Bounds::positive(), "viscosity of the film", required)
          .quantity("film", &ViscousContact::film, "m", Bounds::positive(), "thickness of the film", required);
  return d;
}

const Declaration<InterfaceContact>& InterfaceContact::declaration() {
  static const Bounds stiffness{.low = 0, .infinite = true};
  static const auto d =
      Declaration<InterfaceContact>("interface",
                                    "An imperfect interface: tractions in proportion to the displacement across it since the start.")
          .quantity("tangential", &InterfaceContact::tangential, "Pa/m", stiffness, "stiffness against sliding; inf: none", required)
          .quantity("tension", &InterfaceContact::tension, "Pa/m", stiffness, "stiffness against opening; inf: none", required)
          .quantity("compression", &InterfaceContact::compression, "Pa/m", stiffness, "stiffness against closing; inf: none")
          .quantity(
              "shear_strength", &InterfaceContact::shear_strength, "Pa", Bounds::positive(),
              "shear traction at which it fails for good, with (S/shear_strength)^2 + (N/normal_strength)^2 = 1; left out: never by shear")
          .quantity("normal_strength", &InterfaceContact::normal_strength, "Pa", Bounds::positive(),
                    "tensile traction at which it fails; left out: never by tension")
          .quantity("friction", &InterfaceContact::friction, "1", Bounds::non_negative(), "coefficient of friction once it has failed");
  return d;
}

const Family<ContactLawSpec>& contact_laws() {
  static const auto family = Family<ContactLawSpec>("contact law", "law", "What two bodies, or the faces of a crack, do when they meet.")
                                 .add(FrictionlessContact::declaration())
                                 .add(NoContact::declaration())
                                 .add(BondedContact::declaration())
                                 .add(StickContact::declaration())
                                 .add(CoulombContact::declaration())
                                 .add(AdhesiveContact::declaration())
                                 .add(SpeedFrictionContact::declaration())
                                 .add(RateWeakeningContact::declaration())
                                 .add(SlipWeakeningContact::declaration())
                                 .add(ViscousContact::declaration())
                                 .add(InterfaceContact::declaration());
  return family;
}

}  // namespace crampon
