/// Laws of friction and adhesion under whole blocks, against what is known of them (validation rows 37 to 39).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "on_floor.hpp"

namespace crampon::test {
namespace {

/// A block pressed on a floor by gravity that rises within T, s, and that slides freely otherwise.
constexpr double T = 0.008;
OnFloor sliding_block(const std::string& law, double speed) {
  OnFloor s;
  s.law = law;
  s.velocity = speed;
  s.gravity_y = fmt::format("{}*{}", -g, eased(T));
  return s;
}

struct Law {
  const char* name;
  std::string law;
  std::function<double(double, double)> mu;  ///< of speed, m/s, and distance slipped, m
  std::string shape_functions = "bspline", floor = "wall";
};
void PrintTo(const Law& c, std::ostream* out) { *out << c.name << ", " << c.shape_functions << ", " << c.floor; }
class FrictionOfPointMass : public testing::TestWithParam<Law> {};

/// v' = -mu(v, s) g(t), s' = v for a point: within 1 % of the speed at the start all along. What is seen is the waves in the block, whose
/// speed at the floor is not quite its mean speed.
TEST_P(FrictionOfPointMass, IsThatOfTheBlock) {
  const Law& c = GetParam();
  constexpr double v_0 = 0.5;
  OnFloor setup = sliding_block(c.law, v_0);
  setup.shape_functions = c.shape_functions;
  setup.floor = c.floor;
  const Motion m = follow(setup);
  double v = v_0, s = 0, worst = 0;
  constexpr int parts = 20;  // of a step, by the midpoint rule
  for (std::size_t i = 1; i < m.t.size(); ++i) {
    const double dt = (m.t[i] - m.t[i - 1]) / parts;
    for (int k = 0; k < parts; ++k) {
      const double weight = g * eased_at(m.t[i - 1] + (k + 0.5) * dt, T), v_mid = v - 0.5 * dt * c.mu(v, s) * weight;
      v -= dt * c.mu(v_mid, s + 0.5 * dt * v) * weight;
      s += dt * v_mid;
    }
    worst = std::fmax(worst, std::fabs(m.v[i] - v));
  }
  RecordProperty("worst_percent", fmt::format("{:.4f}", 100 * worst / v_0));
  RecordProperty("v_end", fmt::format("{:.4f} of {:.4f}", m.v.back(), v));
  EXPECT_GT(v, 0.2 * v_0);  // still sliding
  EXPECT_LT(worst, 0.01 * v_0);
  // All that is lost goes to friction.
  const double lost = 0.5 * m.mass * (v_0 * v_0 - m.v.back() * m.v.back());
  RecordProperty("friction_of_lost", fmt::format("{:.4f}", m.at_end("friction_loss") / lost));
  if (setup.floor != "body") {
    EXPECT_NEAR(m.at_end("friction_loss"), lost, 0.01 * lost);
  }
}
const char* const with_speed = "{ law = \"speed_friction\", friction = 0.05, per_speed = 0.4 }";
const char* const less_with_speed = "{ law = \"speed_friction\", friction = 0.4, per_speed = -0.5 }";
const char* const with_rate = "{ law = \"rate_weakening\", friction = 0.1, static_friction = 0.5, half_speed = 0.3 }";
const char* const with_slip = "{ law = \"slip_weakening\", friction = 0.1, static_friction = 0.4, distance = 0.005 }";
const char* const with_slip_linear =
    "{ law = \"slip_weakening\", friction = 0.1, static_friction = 0.4, distance = 0.01, decay = \"linear\" }";
double by_rate(double v, double) { return 0.1 + 0.4 / (1 + v / 0.3); }
double by_slip(double, double s) { return 0.1 + 0.3 * std::exp(-s / 0.005); }
double by_slip_linear(double, double s) { return 0.1 + 0.3 * std::fmax(0, 1 - s / 0.01); }
INSTANTIATE_TEST_SUITE_P(Laws, FrictionOfPointMass,
                         testing::Values(Law{"speed", with_speed, [](double v, double) { return 0.05 + 0.4 * v; }, "linear"},
                                         Law{"less_with_speed", less_with_speed, [](double v, double) { return 0.4 - 0.5 * v; }, "gimp"},
                                         Law{"rate", with_rate, by_rate, "linear"}, Law{"rate", with_rate, by_rate, "bspline", "rigid"},
                                         Law{"slip", with_slip, by_slip, "gimp"}, Law{"slip", with_slip, by_slip, "bspline"},
                                         Law{"slip", with_slip, by_slip, "bspline", "body"},
                                         Law{"slip_linear", with_slip_linear, by_slip_linear, "bspline"}));

/// Validation row 37: mu = mu_0 + k v leaves v = (v_0 + mu_0/k) e^(-k g t) - mu_0/k; 1 % from full weight on.
TEST(VelocityDependentFriction, SlowsExponentially) {
  constexpr double mu_0 = 0.05, k = 0.4;
  const Motion m = follow(sliding_block(with_speed, 0.5));
  const std::size_t first = m.first(T);
  double worst = 0;
  for (std::size_t i = first; i < m.t.size(); ++i) {
    const double v = (m.v[first] + mu_0 / k) * std::exp(-k * g * (m.t[i] - m.t[first])) - mu_0 / k;
    worst = std::fmax(worst, std::fabs(m.v[i] / v - 1));
  }
  RecordProperty("worst_percent", fmt::format("{:.4f}", 100 * worst));
  EXPECT_LT(worst, 0.01);
}

class Shapes : public testing::TestWithParam<const char*> {};

/// A film with eta/film = 200 Pa s/m drags 1000 kg/m3 of 8 mm height at the rate 25/s. 1 %: what the area under the block errs by.
TEST_P(Shapes, ViscousFilmSlowsAtItsRate) {
  OnFloor s = sliding_block("{ law = \"viscous\", viscosity = 0.02, film = 1e-4 }", 0.5);
  s.gravity_y = fmt::format("{}*{}", -10 * g, eased(T));  // so that the drag does not tip it
  s.shape_functions = GetParam();
  s.end = 0.03;
  const Motion m = follow(s);
  std::vector<double> log_v;
  for (const double v : m.v) log_v.push_back(std::log(v));
  const double rate = -slope(m, log_v, T);
  RecordProperty("rate", fmt::format("{:.3f}", rate));
  EXPECT_NEAR(rate, 25, 0.25);
}

/// Friction capped at 20 Pa under 78 Pa with mu = .5 slows 8 kg/m2 by 2.5 m/s2. 1 %: what the area under the block errs by.
TEST_P(Shapes, StrengthCapsFriction) {
  OnFloor s = sliding_block("{ law = \"coulomb\", friction = 0.5, strength = 20 }", 0.5);
  s.shape_functions = GetParam();
  s.end = 0.03;
  const Motion m = follow(s);
  const double a = -slope(m, m.v, T);
  RecordProperty("deceleration", fmt::format("{:.4f}", a));
  EXPECT_NEAR(a, 2.5, 0.025);
}

/// Friction takes all of 1/2 m v^2 of a block that comes to rest, 1 %; what is left shakes. With linear functions 2 %: their particles slip less than
/// the nodes at which friction acts, and the rest is booked as lost by contact.
TEST_P(Shapes, BlockThatComesToRestHeatsByItsEnergy) {
  OnFloor s = sliding_block(coulomb(0.2), 0.1);
  s.shape_functions = GetParam();
  s.end = 0.07;
  s.room = 0.008;
  const Motion m = follow(s);
  const double energy = 0.5 * m.mass * 0.1 * 0.1;
  RecordProperty("friction", fmt::format("{:.5f}", m.at_end("friction_loss") / energy));
  RecordProperty("contact", fmt::format("{:.5f}", m.at_end("contact_loss") / energy));
  RecordProperty("v_end", fmt::format("{:.2e}", m.v.back()));
  EXPECT_NEAR(m.at_end("friction_loss"), energy, (s.shape_functions == "linear" ? 0.02 : 0.01) * energy);
  EXPECT_LT(std::fabs(m.v.back()), 0.001);
}
INSTANTIATE_TEST_SUITE_P(Friction, Shapes, testing::ValuesIn(all_shape_functions()));

/// A block of 16 x 8 mm with the stresses N across the floor and S along it, Pa, functions of time, everywhere: by tractions on its top and
/// ends. Small particles: a traction acts at the particles of the face, and its distance from the face bends the foot.
OnFloor stressed_block(const std::string& law, const std::string& N, const std::string& S) {
  OnFloor s;
  s.width = 0.016;
  s.height = 0.008;
  s.nu = 0;
  s.particles_per_cell = 8;
  s.gravity_y = "0";
  s.law = law;
  s.room = 0.008;
  const auto traction = [](const char* face, const std::string& x, const std::string& y) {
    return fmt::format(
        "[[load]]\nkind = \"traction\"\nbody = \"body\"\nface = \"{}\"\nvalue = [{{ expression = \"{}\" }}, {{ expression = \"{}\" }}]\n",
        face, x, y);
  };
  s.more = traction("y+", S, N) + traction("x+", "0", S) + traction("x-", "0", "-(" + S + ")");
  return s;
}

struct Pull {
  const char* name;
  double normal, shear;  ///< in proportion
  const char* shape_functions;
  double tolerance = 0.02;
};
void PrintTo(const Pull& c, std::ostream* out) { *out << c.name << ", " << c.shape_functions; }
class Adhesion : public testing::TestWithParam<Pull> {};

/// Validation row 39: a block under stress that rises slowly comes off where (S/S_a)^2 + (N/N_a)^2 = 1. The floor bears that much, and then
/// nothing. 2 %: under shear the node at an end is the first to go and takes the others with it (1 % here, 4 % with 2 x 2 particles per
/// cell, whose end tractions act deeper inside). With B-splines, whose foot is softer at its ends, 8 %.
TEST_P(Adhesion, BreaksOnItsEllipse) {
  const Pull& c = GetParam();
  constexpr double normal_strength = 300, shear_strength = 200, rise = 0.04;
  const double size = std::hypot(c.normal, c.shear), normal = c.normal / size, shear = c.shear / size;
  OnFloor s =
      stressed_block(fmt::format("{{ law = \"adhesive\", normal_strength = {}, shear_strength = {} }}", normal_strength, shear_strength),
                     fmt::format("{}*t", normal * normal_strength / rise), fmt::format("{}*t", shear * shear_strength / rise));
  s.shape_functions = c.shape_functions;
  s.end = 1.2 * rise;
  s.damping = "500";
  const Motion m = follow(s);
  double most = 0, broke = 0;
  for (std::size_t i = 0; i < m.t.size(); ++i) {
    const double load = std::hypot(m.reaction_x[i] / (s.width * shear_strength), m.reaction_y[i] / (s.width * normal_strength));
    if (load > most) most = load, broke = m.t[i];
  }
  RecordProperty("bore", fmt::format("{:.4f}", most));
  RecordProperty("load_when_it_broke", fmt::format("{:.4f}", broke / rise));
  RecordProperty("reaction_at_end", fmt::format("{:.2e} {:.2e}", m.reaction_x.back() / s.width, m.reaction_y.back() / s.width));
  EXPECT_NEAR(most, 1, c.tolerance);
  EXPECT_NEAR(broke / rise, 1, c.tolerance);
  EXPECT_GT(std::hypot(m.v.back(), m.fall.back()), 0.01);
}
INSTANTIATE_TEST_SUITE_P(Pulls, Adhesion, testing::Values(Pull{"tangential", 0, 1, "linear"}, Pull{"mixed", 1, 2, "gimp"}));
INSTANTIATE_TEST_SUITE_P(PullsFull, Adhesion,
                         testing::Values(Pull{"normal", 1, 0, "linear"}, Pull{"normal", 1, 0, "bspline"}, Pull{"mixed", 1, 1, "linear"},
                                         Pull{"tangential", 0, 1, "gimp"}, Pull{"mixed", 1, 1, "bspline", 0.09}));

struct Onset {
  double at_rest, sliding;  ///< coefficients
  const char* shape_functions;
};
void PrintTo(const Onset& c, std::ostream* out) { *out << c.at_rest << " at rest, " << c.sliding << " sliding, " << c.shape_functions; }
class StaticFriction : public testing::TestWithParam<Onset> {};

/// Under 200 Pa a shear that grows slowly sets the block sliding at mu_s, and then meets mu_d, 1 %. The time of the onset follows from the
/// speed at the end. Within 3 %: the node that slips first, at an end, sheds its load to the next, so that the block goes early, the more
/// so the further mu_d is below mu_s.
TEST_P(StaticFriction, HoldsUntilItsOwnCoefficient) {
  const Onset& c = GetParam();
  constexpr double start = 0.01, rise = 0.04, pressure = 200;
  const double rate = 1.2 * c.at_rest * pressure / rise;  // of the shear, Pa/s
  OnFloor s = stressed_block(fmt::format("{{ law = \"coulomb\", friction = {}, static_friction = {} }}", c.sliding, c.at_rest),
                             fmt::format("{}*{}", -pressure, eased(start)), fmt::format("(t < {0} ? 0 : {1}*(t - {0}))", start, rate));
  s.shape_functions = c.shape_functions;
  s.damping = fmt::format("{{ times = [0, {}, {}], values = [2000, 2000, 0] }}", start, 1.2 * start);
  s.end = start + rise;
  const Motion m = follow(s);
  double most = 0;  // of what the floor bears
  for (std::size_t i = m.first(1.2 * start); i < m.t.size(); ++i) most = std::fmax(most, -m.reaction_x[i] / (pressure * s.width));
  // From its onset at t_0 the block has v = (rate/2 (t^2 - t_0^2) - mu_d p (t - t_0))/(rho H), t from the start of the push.
  const double a = 0.5 * rate, b = c.sliding * pressure, t = m.t.back() - start, per_area = m.mass / s.width;
  const double t_0 = (b + std::sqrt(b * b - 4 * a * (per_area * m.v.back() - a * t * t + b * t))) / (2 * a);
  const double found = rate * t_0 / pressure;
  double N = 0, S = 0;
  for (std::size_t i = m.first(start + t_0 + 0.003); i < m.t.size(); ++i) N += m.reaction_y[i], S -= m.reaction_x[i];
  RecordProperty("onset", fmt::format("{:.4f}", found));
  RecordProperty("most", fmt::format("{:.4f}", most));
  RecordProperty("sliding", fmt::format("{:.4f}", S / N));
  RecordProperty("v_end", fmt::format("{:.4f}", m.v.back()));
  EXPECT_NEAR(found, c.at_rest, 0.03 * c.at_rest);
  EXPECT_NEAR(S / N, c.sliding, 0.01 * c.sliding);
}
INSTANTIATE_TEST_SUITE_P(Coefficients, StaticFriction, testing::Values(Onset{0.4, 0.2, "linear"}));
INSTANTIATE_TEST_SUITE_P(CoefficientsFull, StaticFriction, testing::Values(Onset{0.4, 0.2, "bspline"}, Onset{0.3, 0.25, "gimp"}));

}  // namespace
}  // namespace crampon::test
