#include "crampon/contact/friction.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

constexpr SlidingLimit stick{true, 0, 0};

/// Sticks when the impulse that would stop all slip is within what the law bears.
SlidingLimit limited(const Sliding& s, double per_normal, double rest = 0) {
  return per_normal * s.normal + rest >= s.full ? stick : SlidingLimit{false, per_normal, rest};
}

SlidingLimit limit_of(const NoContact&, const Sliding&) { return {}; }
SlidingLimit limit_of(const FrictionlessContact&, const Sliding&) { return {}; }
SlidingLimit limit_of(const BondedContact&, const Sliding&) { return stick; }
SlidingLimit limit_of(const StickContact&, const Sliding&) { return stick; }

SlidingLimit limit_of(const CoulombContact& law, const Sliding& s) {
  const double most = law.strength ? *law.strength * s.area * s.dt : HUGE_VAL;
  const double at_onset = std::max(law.static_friction.value_or(0), law.friction);
  if (std::min(at_onset * s.normal, most) >= s.full) return stick;
  return law.friction * s.normal <= most ? SlidingLimit{false, law.friction, 0} : SlidingLimit{false, 0, most};
}

SlidingLimit limit_of(const AdhesiveContact& law, const Sliding& s) { return limited(s, law.friction, law.shear_strength * s.area * s.dt); }

/// S = S_a + (mu + k v) N with v = (d_t - S)/m, solved for S.
SlidingLimit limit_of(const SpeedFrictionContact& law, const Sliding& s) {
  const double cohesion = law.shear_strength * s.area * s.dt;
  if (law.friction * s.normal + cohesion >= s.full) return stick;
  const double with_speed = 1 + law.per_speed * s.normal / s.mass;
  if (with_speed <= 0) return stick;  // weakens faster than the slip can grow within the step
  const double S = (cohesion + (law.friction + law.per_speed * s.full / s.mass) * s.normal) / with_speed;
  return {false, 0, std::clamp(S, 0., s.full)};
}

/// (S - a)(D - S) = (mu_s - mu_d) N m v_h with a = S_a + mu_d N and D = d_t + m v_h: the smaller root, written so that nothing cancels
/// where v_h is far above the speeds at hand.
SlidingLimit limit_of(const RateWeakeningContact& law, const Sliding& s) {
  const double cohesion = law.shear_strength * s.area * s.dt;
  if (law.static_friction * s.normal + cohesion >= s.full) return stick;
  const double a = cohesion + law.friction * s.normal, D = s.full + s.mass * law.half_speed;
  const double fall = (law.static_friction - law.friction) * s.normal * s.mass * law.half_speed;
  const double root = std::sqrt(std::max((D - a) * (D - a) - 4 * fall, 0.));
  return {false, 0, std::min(a + 2 * fall / (D - a + root), s.full)};
}

SlidingLimit limit_of(const SlipWeakeningContact& law, const Sliding& s) {
  const double share = s.slip / law.distance, left = std::max(1 - share, 0.);
  const double fall = law.decay == SlipWeakeningContact::Decay::linear ? left : std::exp(-share);
  return limited(s, law.friction + (law.static_friction - law.friction) * fall, law.shear_strength * left * s.area * s.dt);
}

/// Once the interface has failed.
SlidingLimit limit_of(const InterfaceContact& law, const Sliding& s) { return limited(s, law.friction); }

/// S = eta A v/h_l with v = (d_t - S)/m.
SlidingLimit limit_of(const ViscousContact& law, const Sliding& s) {
  const double drag = law.viscosity * s.area * s.dt / (s.mass * law.film);
  return {false, 0, s.full * drag / (1 + drag)};
}

}  // namespace

SlidingLimit sliding_limit(const ContactLawSpec& law, const Sliding& sliding) {
  return std::visit([&](const auto& l) { return limit_of(l, sliding); }, law);
}

bool needs_history(const ContactLawSpec& law) {
  if (const auto* interface = std::get_if<InterfaceContact>(&law)) return interface->can_fail();
  return std::holds_alternative<SlipWeakeningContact>(law);
}

bool needs_area(const ContactLawSpec& law) {
  if (const auto* coulomb = std::get_if<CoulombContact>(&law)) return coulomb->strength.has_value();
  return std::holds_alternative<AdhesiveContact>(law) || std::holds_alternative<SpeedFrictionContact>(law) ||
         std::holds_alternative<RateWeakeningContact>(law) || std::holds_alternative<SlipWeakeningContact>(law) ||
         std::holds_alternative<ViscousContact>(law) || std::holds_alternative<InterfaceContact>(law);
}

bool adhesion_holds(const ContactLawSpec& law, double pull, double full, double area, double dt) {
  const auto* glue = std::get_if<AdhesiveContact>(&law);
  if (!glue || !(area > 0)) return false;
  const double N = std::max(pull, 0.) / (area * dt * glue->normal_strength), S = full / (area * dt * glue->shear_strength);
  return N * N + S * S < 1;
}

}  // namespace crampon
