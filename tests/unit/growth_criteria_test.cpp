/// Criteria of growth. What each must do, for every one that is registered; the angle and the load of each against independent formulas; and a toy
/// that joins with one struct and one line.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "crampon/crack/criteria/critical_j.hpp"
#include "crampon/crack/criteria/critical_opening.hpp"
#include "crampon/crack/criteria/energy_balance.hpp"
#include "crampon/crack/criteria/max_energy_release.hpp"
#include "crampon/crack/criteria/max_hoop_stress.hpp"
#include "crampon/crack/criteria/max_principal_stress.hpp"
#include "crampon/crack/criteria/mixed_power.hpp"
#include "crampon/crack/criteria/steady_state.hpp"
#include "crampon/crack/criteria/strain_energy_density.hpp"
#include "crampon/input/reference.hpp"
#include "crampon/input/schema.hpp"
#include "crampon/step/growth_model.hpp"

namespace crampon {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double E = 70e9, nu = 0.3, mu = E / (2 * (1 + nu));
const PlaneElasticity elastic(2 * mu * nu / (1 - 2 * nu), mu);

/// A tip whose field has these intensities; the opening two cells of a millimetre behind it, and the stress about as far ahead, follow.
TipState tip_with(double K_I, double K_II) {
  TipState tip;
  tip.K = {K_I, K_II};
  tip.elastic = elastic;
  tip.J = (K_I * K_I + K_II * K_II) / elastic.modulus;
  tip.opening = Vec<2>{{K_II, K_I}} * ((elastic.kappa + 1) / mu * std::sqrt(2e-3 / (2 * pi)));
  Tensor2 sum{};  // over the half plane ahead
  for (int k = -80; k <= 80; ++k) {
    const Tensor2 stress = tip_field(elastic, tip.K, 2e-3, k * degree).stress;
    for (std::size_t i = 0; i < 2; ++i) sum[i] += stress[i] * (1 / 161.);
  }
  tip.ahead = sum;
  return tip;
}
/// Mixtures of opening and sliding, from pure opening to pure sliding in both senses.
std::vector<StressIntensity> mixtures() {
  std::vector<StressIntensity> all;
  for (int k = -12; k <= 12; ++k) all.push_back({1e6 * std::cos(k * pi / 24), 1e6 * std::sin(k * pi / 24)});
  all[0].I = all[24].I = 0;
  return all;
}
double hoop_stress(const StressIntensity& K, double theta) {  // times sqrt(2 pi r)
  const Tensor2 s = tip_field(elastic, K, 1 / (2 * pi), theta).stress;
  const Vec<2> across{{-std::sin(theta), std::cos(theta)}};
  return dot(across, Vec<2>{{dot(s[0], across), dot(s[1], across)}});
}
/// The place of the largest value among many, by looking at all.
template <class F>
double place_of_largest(double low, double high, F f) {
  double best = low;
  for (double theta = low; theta <= high; theta += 1e-4) {
    if (f(theta) > f(best)) best = theta;
  }
  return best;
}

/// Gives way when a toy pulls; to the left by the toy's angle.
struct ToyCriterion {
  double pull = 0, toy_angle = 0;
  static constexpr const char* name = "toy_criterion";
  static constexpr bool needs_intensities = true;
  static constexpr bool looks_ahead = false;
  static std::vector<ToyCriterion> examples() { return {{2, 0}}; }
  double drive(const TipState& tip) const { return std::pow(std::fmax(tip.K.I, 0) / pull, 2); }
  double angle(const TipState&) const { return toy_angle; }
  double speed(const TipState&) const { return no_limit_of_speed; }
  static const Declaration<ToyCriterion>& declaration() {
    static const auto d = Declaration<ToyCriterion>(name, "A criterion that exists in a test.")
                              .quantity("pull", &ToyCriterion::pull, "Pa m^(1/2)", Bounds::positive(), "of a toy", Presence::required)
                              .quantity("toy_angle", &ToyCriterion::toy_angle, "rad", Bounds::any(), "where the toy sends a tip");
    return d;
  }
};
const bool joined = (add_growth_criterion<ToyCriterion>(growth_criteria()), true);

struct Member {
  std::string name;
  GrowthCriterionSpec criterion;
};
void PrintTo(const Member& m, std::ostream* out) { *out << m.name; }
std::vector<Member> members() {
  std::vector<Member> all;
  for (const GrowthCriterionSpec& c : growth_criterion_examples()) {
    int number = 1;
    for (const Member& m : all) number += m.criterion->name() == c->name();
    all.push_back({c->name() + "_" + std::to_string(number), c});
  }
  return all;
}
class EveryCriterion : public testing::TestWithParam<Member> {
 protected:
  const GrowthCriterion& criterion = *GetParam().criterion;
};
INSTANTIATE_TEST_SUITE_P(Criteria, EveryCriterion, testing::ValuesIn(members()), [](const auto& of) { return of.param.name; });

TEST_P(EveryCriterion, IsDrivenByEnergy) {
  for (const StressIntensity& K : mixtures()) {
    const double once = criterion.drive(tip_with(K.I, K.II)), thrice = criterion.drive(tip_with(3 * K.I, 3 * K.II));
    EXPECT_GE(once, 0);
    EXPECT_NEAR(thrice, 9 * once, 1e-6 * thrice) << "twice the load is four times the energy";
  }
}
TEST_P(EveryCriterion, DoesNotGrowWithoutLoad) {
  const double drive = criterion.drive(tip_with(0, 0));
  EXPECT_LT(drive, 1);
  EXPECT_TRUE(std::isfinite(criterion.angle(tip_with(0, 0))));
}
TEST_P(EveryCriterion, GrowsStraightOnUnderPureOpening) { EXPECT_NEAR(criterion.angle(tip_with(1e6, 0)), 0, 1e-9); }
TEST_P(EveryCriterion, IsTheSameInAMirror) {
  for (const StressIntensity& K : mixtures()) {
    const TipState tip = tip_with(K.I, K.II), image = tip_with(K.I, -K.II);
    EXPECT_NEAR(criterion.drive(tip), criterion.drive(image), 1e-9 * criterion.drive(tip));
    if (K.II != 0) {
      EXPECT_NEAR(criterion.angle(tip), -criterion.angle(image), 1e-6);
    }
  }
}
TEST_P(EveryCriterion, TurnsAwayFromTheSenseOfSliding) {
  for (const StressIntensity& K : mixtures()) {
    if (K.II == 0) continue;
    const double angle = criterion.angle(tip_with(K.I, K.II));
    EXPECT_LE(angle * K.II, 0);
    EXPECT_LT(std::fabs(angle), 0.75 * pi + 1e-9);
  }
}
TEST_P(EveryCriterion, HasASpeedWhereItGrows) {
  const TipState tip = tip_with(1e9, 0);
  ASSERT_GE(criterion.drive(tip), 1);
  EXPECT_GT(criterion.speed(tip), 0);
}
TEST_P(EveryCriterion, StandsInTheSchemaAndOnTheReferencePage) {
  const Alternative* of = growth_criteria().find(criterion.name());
  ASSERT_NE(of, nullptr);
  const std::string schema = json_schema(), page = reference_page();
  EXPECT_NE(schema.find("\"" + criterion.name() + "\""), std::string::npos);
  EXPECT_NE(page.find("### " + criterion.name() + "\n\n" + of->record->help()), std::string::npos);
}
TEST(GrowthCriteria, EachHasAnExample) {
  ASSERT_TRUE(joined);
  std::set<std::string> with_example, listed;
  for (const GrowthCriterionSpec& c : growth_criterion_examples()) with_example.insert(c->name());
  for (const Alternative& of : growth_criteria().alternatives()) listed.insert(of.name());
  EXPECT_EQ(with_example, listed);
  EXPECT_EQ(listed.size(), 10u);
}

TEST(MaxHoopStress, FindsTheLargest) {
  for (const StressIntensity& K : mixtures()) {
    const TipState tip = tip_with(K.I, K.II);
    const MaxHoopStress criterion{1e6};
    const double theta = place_of_largest(-pi, pi, [&](double t) { return hoop_stress(K, t); });
    EXPECT_NEAR(criterion.angle(tip), theta, 2e-4);
    EXPECT_NEAR(criterion.drive(tip), std::pow(hoop_stress(K, theta) / 1e6, 2), 1e-6);
  }
  // Known: K_II/K_I = .25, .5, 1, 2; pure sliding.
  const double ratios[] = {0.25, 0.5, 1, 2}, angles[] = {-25.33, -40.21, -53.13, -61.34}, equivalent[] = {1.0853, 1.2828, 1.7889, 2.9005};
  for (int k = 0; k < 4; ++k) {
    const TipState tip = tip_with(1e6, ratios[k] * 1e6);
    EXPECT_NEAR(MaxHoopStress{1e6}.angle(tip) / degree, angles[k], 0.005);
    EXPECT_NEAR(std::sqrt(MaxHoopStress{1e6}.drive(tip)), equivalent[k], 5e-5);
  }
  EXPECT_NEAR(MaxHoopStress{1e6}.angle(tip_with(0, 1e6)) / degree, -70.529, 0.001);
  EXPECT_NEAR(std::sqrt(MaxHoopStress{1e6}.drive(tip_with(0, 1e6))), 2 / std::sqrt(3.), 1e-9);
  EXPECT_EQ(MaxHoopStress{1e6}.drive(tip_with(-1e6, 0)), 0) << "faces that press on each other";
}

TEST(StrainEnergyDensity, FindsTheLeast) {
  for (const StressIntensity& K : mixtures()) {
    const TipState tip = tip_with(K.I, K.II);
    const auto density = [&](double t) {  // of the field itself
      const TipField f = tip_field(elastic, K, 1, t);
      return 0.5 * (dot(f.stress[0], f.gradient[0]) + dot(f.stress[1], f.gradient[1]));
    };
    // The least one within 30 degrees of the largest hoop stress: further away it is less again, near the faces, where nothing grows.
    const double hoop = MaxHoopStress{1e6}.angle(tip),
                 theta = place_of_largest(hoop - 30 * degree, hoop + 30 * degree, [&](double t) { return -density(t); });
    const StrainEnergyDensity criterion{1e6};
    EXPECT_NEAR(criterion.angle(tip), theta, 3e-4) << K.I << " " << K.II;
    EXPECT_LT(std::fabs(theta - hoop), 29 * degree) << "not at the end of what was looked at";
    const TipField open = tip_field(elastic, {1e6, 0}, 1, 0);
    const double of_K_Ic = 0.5 * (dot(open.stress[0], open.gradient[0]) + dot(open.stress[1], open.gradient[1]));
    EXPECT_NEAR(criterion.drive(tip), density(theta) / of_K_Ic, 1e-6);
  }
  // Pure sliding: cos(theta) = (1 - 2 nu)/3.
  EXPECT_NEAR(StrainEnergyDensity{1e6}.angle(tip_with(0, 1e6)), -std::acos((1 - 2 * nu) / 3), 1e-6);
}

TEST(MaxEnergyRelease, FindsTheLargest) {
  for (const StressIntensity& K : mixtures()) {
    const TipState tip = tip_with(K.I, K.II);
    // Hoop and shear stress at an angle are the intensities of a small kink there.
    const auto release = [&](double t) {
      const Tensor2 s = tip_field(elastic, K, 1 / (2 * pi), t).stress;
      const Vec<2> along{{std::cos(t), std::sin(t)}}, across{{-std::sin(t), std::cos(t)}};
      const Vec<2> traction{{dot(s[0], across), dot(s[1], across)}};
      return (std::pow(std::fmax(dot(traction, across), 0), 2) + std::pow(dot(traction, along), 2)) / elastic.modulus;
    };
    const double away = 0.75 * pi;
    const double theta = K.II == 0 ? 0 : place_of_largest(K.II > 0 ? -away : 0, K.II > 0 ? 0 : away, release);
    const MaxEnergyRelease criterion{10};
    EXPECT_NEAR(criterion.angle(tip), theta, 3e-4);
    EXPECT_NEAR(criterion.drive(tip), release(theta) / 10, 1e-6);
  }
}

TEST(MixedPower, LiesOnItsCurve) {
  for (const StressIntensity& K : mixtures()) {
    for (const double p : {1., 1.5, 2., 4.}) {
      const MixedPower criterion{1e6, 0.7e6, p, 2};
      const double s = std::sqrt(criterion.drive(tip_with(K.I, K.II)));
      EXPECT_NEAR(std::pow(K.I / s / 1e6, p) + std::pow(K.II / s / 0.7e6, 2), 1, 1e-9);
    }
    EXPECT_EQ((MixedPower{1e6, 0.7e6, 2, 2}.drive(tip_with(-5e6, 0))), 0);
  }
}

TEST(CriticalJ, AndTheOthersThatTakeJ) {
  for (const StressIntensity& K : mixtures()) {
    const TipState tip = tip_with(K.I, K.II);
    EXPECT_NEAR(CriticalJ{5}.drive(tip), tip.J / 5, 1e-12);
    EXPECT_NEAR(CriticalJ{5}.angle(tip), MaxHoopStress{1}.angle(tip), 1e-12);
    const EnergyDrivenGrowth growth{0.25 * tip.J, 800};
    EXPECT_NEAR(growth.drive(tip), 4, 1e-9);
    EXPECT_NEAR(growth.speed(tip), 600, 1e-9);
    EXPECT_EQ((EnergyDrivenGrowth{2 * tip.J, 800}.speed(tip)), 0);
  }
  TipState without_K = tip_with(1e6, 0);
  without_K.K = {std::nan(""), std::nan("")};
  EXPECT_EQ(CriticalJ{5}.angle(without_K), 0);
}

TEST(SteadyState, GoesOnOnceBegun) {
  const SteadyState criterion{1e3, 300, 2e-6};
  TipState tip = tip_with(1e6, 0);
  ASSERT_LT(tip.J, 1e3);
  EXPECT_LT(criterion.drive(tip), 1);
  tip.time = 2e-6;
  EXPECT_GE(criterion.drive(tip), 1);
  tip.time = 0, tip.grown = 1e-6;
  EXPECT_GE(criterion.drive(tip), 1);
  EXPECT_EQ(criterion.speed(tip), 300);
}

TEST(CriticalOpening, TakesTheNearerOfBoth) {
  TipState tip;
  tip.opening = {{3e-6, 1e-6}};
  EXPECT_NEAR((CriticalOpening{2e-6, {}}.drive(tip)), 0.25, 1e-12);
  EXPECT_NEAR((CriticalOpening{2e-6, 2e-6}.drive(tip)), 2.25, 1e-12);
  tip.opening = {{0, -1e-5}};
  EXPECT_EQ((CriticalOpening{2e-6, 2e-6}.drive(tip)), 0);
}

TEST(MaxPrincipalStress, GrowsAcrossIt) {
  for (int k = -8; k <= 8; ++k) {  // a pull at an angle to the direction across the crack
    const double a = k * 10 * degree;
    const Vec<2> pull{{-std::sin(a), std::cos(a)}};
    TipState tip;
    tip.ahead = Tensor2{pull * (3e6 * pull[0]), pull * (3e6 * pull[1])};
    EXPECT_NEAR(MaxPrincipalStress{1e6}.angle(tip), a, 1e-9);
    EXPECT_NEAR(MaxPrincipalStress{1e6}.drive(tip), 9, 1e-9);
  }
}

TEST(Resistance, FollowsGrowthAndSpeed) {
  Resistance r;
  EXPECT_EQ(r.at(1, 100), 1);
  r.grown = {0, 1, 3}, r.factor = {1, 2, 3};
  EXPECT_DOUBLE_EQ(r.at(0, 0), 1);
  EXPECT_DOUBLE_EQ(r.at(0.5, 0), 1.5);
  EXPECT_DOUBLE_EQ(r.at(2, 0), 2.5);
  EXPECT_DOUBLE_EQ(r.at(9, 0), 3);
  r.speed = 200, r.exponent = 2;
  EXPECT_DOUBLE_EQ(r.at(9, 100), 3 * 1.25);
}

}  // namespace
}  // namespace crampon
