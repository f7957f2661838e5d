#include "crampon/contact/strictest.hpp"

#include <algorithm>
#include <array>

namespace crampon {

namespace {

/// Compared from left to right.
using Strictness = std::array<double, 3>;

/// Friction that never exceeds a stress is less strict than without that limit.
constexpr double rubs = 3;

Strictness strictness_of(const NoContact&) { return {0}; }
Strictness strictness_of(const FrictionlessContact&) { return {1}; }
Strictness strictness_of(const ViscousContact& law) { return {2, law.viscosity / law.film}; }
Strictness strictness_of(const CoulombContact& law) {
  return {rubs, std::max(law.friction, law.static_friction.value_or(0)), law.strength ? -1 / *law.strength : 0};
}
Strictness strictness_of(const SpeedFrictionContact& law) { return {rubs, law.friction, law.shear_strength}; }
Strictness strictness_of(const RateWeakeningContact& law) { return {rubs, law.static_friction, law.shear_strength}; }
Strictness strictness_of(const SlipWeakeningContact& law) { return {rubs, law.static_friction, law.shear_strength}; }
Strictness strictness_of(const AdhesiveContact& law) { return {4, law.friction, law.shear_strength}; }
Strictness strictness_of(const InterfaceContact& law) { return {5, law.tangential, std::max(law.tension, law.compression)}; }
Strictness strictness_of(const StickContact&) { return {6}; }
Strictness strictness_of(const BondedContact&) { return {7}; }

Strictness strictness(const ContactLawSpec& law) {
  return std::visit([](const auto& l) { return strictness_of(l); }, law);
}

}  // namespace

const ContactLawSpec& strictest(const ContactLawSpec& a, const ContactLawSpec& b) { return strictness(b) > strictness(a) ? b : a; }

}  // namespace crampon
