/// Tractions across cracks through the door the step uses (crack/traction/law.hpp), against the curves written once more as plain
/// functions, with energies by quadrature (docs/theory/traction.md; validation rows 27 and 28).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "unit/traction_cases.hpp"

namespace crampon::test {
namespace {

static_assert(std::is_trivially_copyable_v<TractionHistory>);

Traction update(const TractionLawSpec& law, const PerMode& opening, TractionHistory& history) {
  return update_traction(*law, opening, 0, Vec<3>{}, history);
}
double dissipated(const TractionHistory& h) { return h.dissipated_normal + h.dissipated_shear; }
double work(const TractionHistory& h) { return h.work_normal + h.work_shear; }

class TractionLaws : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, TractionLaws, testing::ValuesIn(all_cases()), [](const auto& i) { return i.param.name; });

// Validation row 27: pull, let go, close, pull again, tear; then there is nothing left.
TEST_P(TractionLaws, PureModesFollowTheirCurves) {
  const auto& [name, kind, shear_kind, law] = GetParam();
  const std::vector<double> parts = {0, 0.05, 0.2, 0.33, 0.1, -0.3, 0.2, 0.45, 0.9, 0, 0.95, 0.999, -0.999, 1.02, 0.5, -2};
  for (const bool in_shear : {false, true}) {
    const PlainCurve curve = in_shear ? plain_shear(shear_kind) : plain(kind);
    const double scale = curve.k * curve.end(), G_c = curve.work(curve.end());
    TractionHistory history;
    double largest = 0;
    for (const double part : parts) {
      SCOPED_TRACE(testing::Message() << (in_shear ? "shear " : "normal ") << part);
      const double u = part * curve.end(), felt = in_shear ? u : std::max(u, 0.);
      largest = std::max(largest, std::abs(felt));
      const Traction T = update(law, in_shear ? PerMode{0, u} : PerMode{u, 0}, history);
      const double expected = curve.secant(largest) * felt, psi = curve.dissipated(largest);
      EXPECT_NEAR(in_shear ? T.shear : T.normal, expected, 1e-10 * std::abs(expected) + 1e-16 * scale);
      EXPECT_EQ(in_shear ? T.normal : T.shear, 0);
      EXPECT_NEAR(T.stored, 0.5 * expected * felt, 1e-10 * std::abs(expected * felt) + 1e-16 * G_c);
      EXPECT_NEAR(in_shear ? history.dissipated_shear : history.dissipated_normal, psi, 1e-10 * psi + 1e-14 * G_c);
      EXPECT_EQ(in_shear ? history.dissipated_normal : history.dissipated_shear, 0);
      EXPECT_EQ(history.failed != 0, largest >= curve.end());
    }
    EXPECT_NEAR(in_shear ? law->toughness().shear : law->toughness().normal, G_c, 1e-12 * G_c);
  }
  EXPECT_NEAR(law->largest_stiffness(), std::max(plain(kind).k, plain_shear(shear_kind).k), 1e-12 * plain(kind).k);
}

TEST_P(TractionLaws, FailAtTheFinalOpeningWhateverTheSteps) {
  const auto& law = GetParam().law;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const bool in_shear : {false, true}) {
    const double end = u_c * (in_shear ? more_opening : 1), G_c = in_shear ? law->toughness().shear : law->toughness().normal;
    const auto opening = [&](double u) { return in_shear ? PerMode{0, -u} : PerMode{u, 0}; };
    TractionHistory history;
    update(law, opening((1 - 1e-9) * end), history);
    EXPECT_EQ(history.failed, 0);
    update(law, opening(end), history);
    EXPECT_EQ(history.failed, 1);
    EXPECT_EQ(history.damage, 1);
    EXPECT_NEAR(dissipated(history), G_c, 1e-14 * G_c);
    for (int trial = 0; trial < 20; ++trial) {  // from anywhere by one jump, after any number of steps
      TractionHistory h;
      double u = 0;
      for (int step = 0; step < trial; ++step) update(law, opening(u = std::min(u + 0.2 * end * uniform(generator), 0.999 * end)), h);
      for (int step = 0; step < trial % 3; ++step) update(law, opening(uniform(generator) * u), h);
      const Traction T = update(law, opening((1 + 9 * uniform(generator)) * end), h);
      EXPECT_EQ(h.failed, 1);
      EXPECT_NEAR(dissipated(h), G_c, 1e-13 * G_c);
      EXPECT_EQ(T.normal + T.shear + T.stored, 0);
    }
  }
}

// Beyond failure a step does nothing more, whatever its direction.
TEST_P(TractionLaws, OvershootIsFree) {
  const auto& law = GetParam().law;
  for (const PerMode& d : {PerMode{0.2, 1}, PerMode{1, 0.3}, PerMode{-0.3, -1.4}}) {
    const auto jump = [&](double far) {
      TractionHistory history;
      update(law, {0.3 * u_c, 0.1 * more_opening * u_c}, history);
      update(law, {(0.3 + far * d.normal) * u_c, (0.1 + far * d.shear) * more_opening * u_c}, history);
      EXPECT_EQ(history.failed, 1);
      return history;
    };
    // Not so far that the crack closes on the way: closed faces slide without opening.
    const TractionHistory near = jump(0.9), beyond = jump(d.normal < 0 ? 1 : 5);
    EXPECT_NEAR(beyond.dissipated_normal, near.dissipated_normal, 1e-12 * dissipated(near));
    EXPECT_NEAR(beyond.dissipated_shear, near.dissipated_shear, 1e-12 * dissipated(near));
  }
}

/// A path that wanders, opens and closes, and grows with t from 0 to about twice the final openings.
PerMode wander(double t) {
  return {u_c * t * (0.8 + 1.3 * std::sin(31 * t)), more_opening * u_c * t * (0.3 + 1.4 * std::sin(17 * t + 1) - 0.5 * std::cos(47 * t))};
}

TEST_P(TractionLaws, WorkIsStoredOrDissipated) {
  const auto& law = GetParam().law;
  const double G = law->toughness().normal;
  for (const bool to_failure : {false, true}) {
    const double size = to_failure ? 1 : 0.08;
    for (const int steps : {4000, 16000}) {
      TractionHistory history;
      double error = 0;
      for (int k = 1; k <= steps; ++k) {
        const double last_n = history.dissipated_normal, last_t = history.dissipated_shear, last_damage = history.damage;
        const PerMode path = wander(1.5 * k / steps), u = {size * path.normal, size * path.shear};
        const Traction T = update(law, u, history);
        ASSERT_GE(history.dissipated_normal, last_n * (1 - 1e-14));
        ASSERT_GE(history.dissipated_shear, last_t * (1 - 1e-14));
        ASSERT_GE(history.damage, last_damage * (1 - 1e-14));
        ASSERT_GE(T.normal, 0);
        ASSERT_TRUE(u.normal > 0 || T.normal == 0);
        ASSERT_GE(T.shear * u.shear, 0);
        error = std::max(error, std::abs(work(history) - T.stored - dissipated(history)));
      }
      EXPECT_EQ(history.failed != 0, to_failure);
      // Second order in the step; first order in the one step in which a law gives way.
      EXPECT_LT(error, (to_failure ? 60. : 1e3 / steps) / steps * G);
    }
  }
}

/// Along a straight path at an angle (as fractions of the final openings) to failure.
TractionHistory pull(const TractionLawSpec& law, double angle, int steps) {
  TractionHistory history;
  for (int k = 1; k <= 2 * steps && history.failed == 0; ++k)
    update(law, {std::cos(angle) * u_c * k / steps, -std::sin(angle) * more_opening * u_c * k / steps}, history);
  return history;
}

std::vector<Case> cases_of_one_shape() {
  std::vector<Case> cases = all_cases();
  std::erase_if(cases, [](const Case& c) { return c.curve != c.shear_curve; });
  return cases;
}
class TractionLawsOfOneShape : public TractionLaws {};
INSTANTIATE_TEST_SUITE_P(All, TractionLawsOfOneShape, testing::ValuesIn(cases_of_one_shape()), [](const auto& i) { return i.param.name; });

// Validation row 28.
TEST_P(TractionLawsOfOneShape, ProportionalPathsUseUpTheToughnesses) {
  const auto& law = GetParam().law;
  const bool coupled = law.as<MixedModeTraction>() || law.as<CoupledSawtooth>();
  const PerMode G_c = law->toughness();
  for (const int steps : {1, 7, 1000})
    for (int degrees = 0; degrees <= 90; degrees += 15) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees in " << steps << " steps");
      const double angle = degrees * M_PI / 180;
      const TractionHistory history = pull(law, angle, steps);
      ASSERT_EQ(history.failed, 1);
      const double part_n = history.dissipated_normal / G_c.normal, part_t = history.dissipated_shear / G_c.shear;
      EXPECT_NEAR(part_n + part_t, 1, 1e-10);
      if (coupled) {
        EXPECT_NEAR(part_n, std::pow(std::cos(angle), 2), 1e-10);
      }
    }
}

TEST(DecoupledTraction, ModeExponentDecidesFailure) {
  for (const double m : {0.5, 1., 2., 6.})
    for (const Case& c : all_cases(m)) {
      if (c.name == "coupled_sawtooth" || c.name.starts_with("mixed")) continue;
      SCOPED_TRACE(testing::Message() << c.name << ", m = " << m);
      const TractionHistory history = pull(c.law, 0.6, 50);
      const PerMode G_c = c.law->toughness();
      EXPECT_NEAR(std::pow(history.dissipated_normal / G_c.normal, m) + std::pow(history.dissipated_shear / G_c.shear, m), 1, 1e-10);
    }
  for (const double m : {0., -1.})
    for (const Case& c : all_cases(m)) {
      if (c.name == "coupled_sawtooth" || c.name.starts_with("mixed")) continue;
      TractionHistory history;
      update(c.law, {0.999 * u_c, 0.999 * more_opening * u_c}, history);
      EXPECT_EQ(history.failed, 0) << c.name;
      update(c.law, {u_c, 0.999 * more_opening * u_c}, history);
      EXPECT_EQ(history.failed, 1) << c.name;
    }
}

// Any two curves: the damage found by bisection on the table's functions.
TEST(MixedModeTraction, DamageSolvesTheEllipse) {
  const std::vector<std::pair<std::string, SofteningCurve>> normals = {
      {"triangular", triangular()}, {"trilinear", trilinear()}, {"cubic", cubic()}, {"exponential", exponential()}};
  const std::vector<std::pair<std::string, SofteningCurve>> shears = {{"triangular", triangular(more_stress, more_opening)},
                                                                      {"trilinear", trilinear(more_stress, more_opening)},
                                                                      {"cubic", cubic(more_stress, more_opening)},
                                                                      {"exponential", exponential(more_stress, more_opening)}};
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const auto& [n, normal] : normals)
    for (const auto& [t, shear] : shears) {
      const PlainCurve N = plain(n), S = plain_shear(t);
      const MixedModeTraction law{normal, shear};
      for (int trial = 0; trial < 20; ++trial) {
        SCOPED_TRACE(testing::Message() << n << ", " << t << ", trial " << trial);
        const double angle = 0.5 * M_PI * uniform(generator), size = uniform(generator);
        const PerMode u = {size * std::cos(angle) * N.end(), (trial % 2 ? 1 : -1) * size * std::sin(angle) * S.end()};
        TractionHistory history;
        const Traction T = update(law, u, history);
        ASSERT_EQ(history.failed, 0);
        const auto f = [&](double D) { return std::pow(u.normal / N.opening_at(D), 2) + std::pow(u.shear / S.opening_at(D), 2) - 1; };
        double low = 0, high = 1;
        if (f(0) <= 0) high = 0;
        for (int k = 0; k < 55; ++k) {
          const double D = 0.5 * (low + high);
          (f(D) > 0 ? low : high) = D;
        }
        // The oracle holds D itself to round-off, and with it 1 - D to round-off of 1.
        const double D = 0.5 * (low + high);
        EXPECT_NEAR(history.damage, D, 1e-13);
        EXPECT_NEAR(T.normal, (1 - D) * N.k * u.normal, (1e-10 * (1 - D) + 1e-14) * N.k * u.normal);
        EXPECT_NEAR(T.shear, (1 - D) * S.k * u.shear, (1e-10 * (1 - D) + 1e-14) * S.k * std::abs(u.shear));
      }
    }
}

// Where one mode is used up the other has nothing left; damage done by one is felt by the other.
TEST(MixedModeTraction, DamageIsOfBothModes) {
  const MixedModeTraction law{triangular(), cubic(more_stress, more_opening)};
  TractionHistory history;
  update(law, {0.5 * u_c, 0}, history);
  const double D = history.damage;
  EXPECT_NEAR(D, 1 - (0.5 / 0.9) / (0.5 / 0.1), 1e-14);  // 1 - S/(k u)
  const Traction T = update(law, {-1, 0.01 * u_c}, history);
  EXPECT_EQ(T.normal, 0);
  EXPECT_NEAR(T.shear, (1 - D) * cubic(more_stress, more_opening).stiffness() * 0.01 * u_c, 1e-12 * sigma);
  update(law, {0, 0}, history);
  update(law, {2 * u_c, 0}, history);
  EXPECT_EQ(update(law, {0, 0.01 * u_c}, history).shear, 0);
  EXPECT_NEAR(history.dissipated_normal, law.toughness().normal, 1e-14 * law.toughness().normal);
}

// Hogberg: at the peak the tractions lie on an ellipse whatever the direction, also for peaks at different parts of the final openings.
TEST(CoupledSawtooth, PeaksLieOnAnEllipse) {
  const CoupledSawtooth law{triangular(), {8e6, 5e-5, 2e-4}};
  for (const double angle : {0., 0.2, 0.7, 1.1, M_PI / 2}) {
    const double s = std::sin(angle), c = std::cos(angle), lambda_p = 1 / std::sqrt(s * s / 0.01 + c * c / 0.0625);
    double largest = 0;
    TractionHistory history;
    for (int k = 1; k < 4000; ++k) {
      const double lambda = k * lambda_p / 400;
      const Traction T = update(law, {lambda * s * u_c, lambda * c * 2e-4}, history);
      const double ratio = std::hypot(T.normal / sigma, T.shear / 8e6);
      const double expected = lambda >= 1 ? 0 : lambda < lambda_p ? lambda / lambda_p : (1 - lambda) / (1 - lambda_p);
      ASSERT_NEAR(ratio, expected, 1e-12);
      largest = std::max(largest, ratio);
    }
    EXPECT_NEAR(largest, 1, 1e-12);
  }
}

// Damaged in the direction of the early peak, then turned to that of the late one: elastic there until its own peak.
TEST(CoupledSawtooth, IsNeverStifferThanItsElasticPart) {
  const CoupledSawtooth law{triangular(), {8e6, 5e-5, 2e-4}};  // lambda_p of 0.1 and 0.25
  TractionHistory history;
  update(law, {0.15 * u_c, 0}, history);
  EXPECT_NEAR(history.damage, 0.15, 1e-15);
  EXPECT_NEAR(update(law, {0, 0.2 * 2e-4}, history).shear, 8e6 * 0.2 / 0.25, 1e-6);
  EXPECT_NEAR(history.damage, 0.15, 1e-15);
  EXPECT_NEAR(update(law, {0.1 * u_c, 0}, history).normal, sigma * (0.85 / 0.9) * (0.1 / 0.15), 1e-6);
}

TEST(LinearElasticTraction, NeverFails) {
  const TractionLawSpec law = LinearElasticTraction{2e11, 3e11};
  TractionHistory history;
  const Traction T = update(law, {1e-3, -2e-3}, history);
  EXPECT_EQ(T.normal, 2e8);
  EXPECT_EQ(T.shear, -6e8);
  EXPECT_DOUBLE_EQ(T.stored, 0.5 * (2e5 + 12e5));
  EXPECT_DOUBLE_EQ(work(history), T.stored);  // one step of a straight line: the trapezoid is exact
  EXPECT_EQ(update(law, {-1e-3, 0}, history).normal, 0);
  EXPECT_EQ(dissipated(history) + history.failed, 0);
  EXPECT_EQ(law->largest_stiffness(), 3e11);
  EXPECT_TRUE(std::isinf(law->toughness().normal));
}

TEST(PressureTraction, PushesByTimeAndPlace) {
  const TractionLawSpec everywhere = PressureTraction{ValueFunction::expression("1e5*t*(1+x)"), {}};
  TractionHistory history;
  EXPECT_DOUBLE_EQ(update_traction(*everywhere, {-1e-6, 0}, 2, {{3, 0, 0}}, history).normal, -8e5);
  EXPECT_DOUBLE_EQ(update_traction(*everywhere, {1e-6, 5}, 2, {{3, 0, 0}}, history).normal, -8e5);
  EXPECT_NEAR(work(history), -0.5 * 8e5 * 1e-6 * -1 - 8e5 * 2e-6, 1e-15);  // closing against it first, then it opens the crack
  const TractionLawSpec open = PressureTraction{ValueFunction::constant(1e5), 1e-6};
  EXPECT_EQ(update(open, {1e-6, 0}, history).normal, 0);
  EXPECT_EQ(update(open, {2e-6, 0}, history).normal, -1e5);
  EXPECT_EQ(update(NoTraction{}, {1, 1}, history).normal, 0);
}

}  // namespace
}  // namespace crampon::test
