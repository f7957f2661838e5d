/// How laws resist sliding (contact/laws), against an oracle that knows nothing but mu(v): the impulse S is where
/// g(S) = S - mu((d_t - S)/m) N - S_a changes its sign, found by halving an interval.

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <random>

#include "crampon/contact/law.hpp"
#include "crampon/contact/laws/adhesive.hpp"
#include "crampon/contact/laws/bonded.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/frictionless.hpp"
#include "crampon/contact/laws/interface.hpp"
#include "crampon/contact/laws/rate_weakening.hpp"
#include "crampon/contact/laws/slip_weakening.hpp"
#include "crampon/contact/laws/speed_friction.hpp"
#include "crampon/contact/laws/stick.hpp"
#include "crampon/contact/laws/viscous.hpp"

namespace crampon::test {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  double decades(double low, double high) { return std::pow(10., draw(low, high)); }

 private:
  std::mt19937_64 engine_;
};

/// Impulses of all ratios, masses from a gram to a tonne, steps and areas as in practice.
Sliding random_sliding(Random& random) {
  Sliding s;
  s.mass = random.decades(-3, 3);
  s.dt = random.decades(-8, -3);
  s.area = random.decades(-8, 0);
  s.normal = s.mass * random.decades(-6, 2);
  s.full = s.normal * random.decades(-2, 2);
  s.slip = random.decades(-6, -1);
  return s;
}

/// The tangential impulse that acts, kg m/s.
double impulse(const ContactLawSpec& law, const Sliding& s) {
  const SlidingLimit limit = law->limit(s);
  return limit.sticks ? s.full : limit.per_normal * s.normal + limit.rest;
}

/// g at S = d_t is what is wanting of standstill: not above zero, the contact sticks. Above it, the sign changes between 0 and d_t.
double by_bisection(const std::function<double(double)>& mu, double cohesion, const Sliding& s) {
  const auto g = [&](double S) { return S - mu((s.full - S) / s.mass) * s.normal - cohesion; };
  if (g(s.full) <= 0) return s.full;
  if (g(0) >= 0) return 0;
  double low = 0, high = s.full;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (g(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// A law with random constants, and mu(v) and S_a A dt of it as the theory page has them.
struct Known {
  ContactLawSpec law;
  std::function<double(double)> mu;
  double cohesion = 0;
};
using MakeLaw = std::function<Known(Random&, const Sliding&)>;

/// Cohesion of the size of the other impulses, as a strength.
double strength(Random& random, const Sliding& s) { return random.draw(0, 1) * s.full / (s.area * s.dt); }

const std::vector<std::pair<const char*, MakeLaw>> laws = {
    {"coulomb",
     [](Random& random, const Sliding&) {
       const double mu = random.draw(0, 2);
       return Known{CoulombContact{mu}, [mu](double) { return mu; }};
     }},
    {"adhesive",
     [](Random& random, const Sliding& s) {
       const double mu = random.draw(0, 2), S_a = strength(random, s);
       return Known{AdhesiveContact{mu, S_a, 1e6}, [mu](double) { return mu; }, S_a * s.area * s.dt};
     }},
    {"speed_friction",
     [](Random& random, const Sliding& s) {
       const double mu = random.draw(0, 2), S_a = strength(random, s), v = s.full / s.mass;
       // Up to losing all friction at the speed without contact, or to tripling it.
       const double k = random.draw(-mu, 2 * mu) / v;
       return Known{SpeedFrictionContact{mu, k, S_a}, [=](double w) { return mu + k * w; }, S_a * s.area * s.dt};
     }},
    {"rate_weakening",
     [](Random& random, const Sliding& s) {
       const double mu = random.draw(0, 1), more = random.draw(0, 1), v_h = s.full / s.mass * random.decades(-4, 4);
       const double S_a = strength(random, s);
       return Known{RateWeakeningContact{mu, mu + more, v_h, S_a}, [=](double v) { return mu + more / (1 + v / v_h); },
                    S_a * s.area * s.dt};
     }},
    {"slip_weakening_exponential",
     [](Random& random, const Sliding& s) {
       const double mu = random.draw(0, 1), more = random.draw(0, 1), d_c = s.slip * random.decades(-2, 2), S_a = strength(random, s);
       return Known{SlipWeakeningContact{mu, mu + more, d_c, S_a}, [=](double) { return mu + more * std::exp(-s.slip / d_c); },
                    S_a * std::max(1 - s.slip / d_c, 0.) * s.area * s.dt};
     }},
    {"slip_weakening_linear",
     [](Random& random, const Sliding& s) {
       const double mu = random.draw(0, 1), more = random.draw(0, 1), d_c = s.slip * random.decades(-2, 2), S_a = strength(random, s);
       const double left = s.slip < d_c ? 1 - s.slip / d_c : 0;
       return Known{SlipWeakeningContact{mu, mu + more, d_c, S_a, SlipWeakeningContact::Decay::linear},
                    [=](double) { return mu + more * left; }, S_a * left * s.area * s.dt};
     }},
    {"viscous",
     [](Random& random, const Sliding& s) {
       const double drag = random.decades(-6, 6);  // eta A dt/(m h_l)
       const double eta = drag * s.mass / (s.area * s.dt) * 1e-5;
       return Known{ViscousContact{eta, 1e-5}, [=](double v) { return eta * s.area * s.dt / 1e-5 * v / s.normal; }};
     }},
    {"failed_interface", [](Random& random, const Sliding&) {
       InterfaceContact law;
       law.friction = random.draw(0, 2);
       const double mu = law.friction;
       return Known{law, [mu](double) { return mu; }};
     }}};

TEST(FrictionLaw, ImpulseSolvesItsLaw) {
  for (const auto& [name, make] : laws) {
    Random random(7);
    int stuck = 0, slid = 0;
    double worst = 0;
    for (int trial = 0; trial < 20000; ++trial) {
      const Sliding s = random_sliding(random);
      const Known known = make(random, s);
      const double S = impulse(known.law, s), oracle = by_bisection(known.mu, known.cohesion, s);
      const double error = std::fabs(S - oracle) / s.full;
      worst = std::fmax(worst, error);
      // Round-off of a few operations, times what a nearly unstable law (k N/m close to -1) makes of it.
      ASSERT_LT(error, 1e-9) << name << ": N " << s.normal << ", d_t " << s.full << ", m " << s.mass;
      ASSERT_GE(S, 0) << name;
      ASSERT_LE(S, s.full * (1 + 1e-15)) << name;
      ++(known.law->limit(s).sticks ? stuck : slid);
    }
    RecordProperty(name, testing::PrintToString(worst));
    EXPECT_GT(slid, 2000) << name;
    if (std::string(name) != "viscous") {
      EXPECT_GT(stuck, 500) << name;  // a film never stops all slip
    }
  }
}

/// Sliding starts at static_friction and goes on with friction; no shear above `strength`.
TEST(FrictionLaw, CoulombStartsLateAndIsCapped) {
  Random random(8);
  int stuck = 0, capped = 0, slid = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Sliding s = random_sliding(random);
    const double mu = random.draw(0, 1), mu_s = mu + random.draw(0, 1), most = random.decades(-2, 2) * s.normal;
    const CoulombContact law{mu, mu_s, most / (s.area * s.dt)};
    const SlidingLimit limit = law.limit(s);
    const double bears = std::min(mu_s * s.normal, most);
    if (std::fabs(bears - s.full) < 1e-12 * s.full) continue;
    ASSERT_EQ(limit.sticks, bears > s.full);
    const double S = impulse(law, s);
    ASSERT_LE(S, s.full);
    if (limit.sticks) {
      ++stuck;
    } else if (mu * s.normal > most) {
      ++capped;
      ASSERT_NEAR(S, most, 1e-14 * most);
    } else {
      ++slid;
      ASSERT_NEAR(S, mu * s.normal, 1e-14 * S);
    }
  }
  EXPECT_GT(stuck, 2000);
  EXPECT_GT(capped, 1000);
  EXPECT_GT(slid, 2000);
}

/// Every law at the ends of its constants is a simpler one.
TEST(FrictionLaw, Limits) {
  Random random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    const Sliding s = random_sliding(random);
    const double mu = random.draw(0, 1), mu_s = mu + random.draw(0, 1), S_a = strength(random, s), v = s.full / s.mass;
    const double close = 1e-6 * s.full;  // what the constant is away from its end
    const auto same = [&](const ContactLawSpec& a, const ContactLawSpec& b) { ASSERT_NEAR(impulse(a, s), impulse(b, s), close); };
    same(SpeedFrictionContact{mu, 1e-8 * mu / v, 0}, CoulombContact{mu});
    same(SpeedFrictionContact{mu, 1e9 / v, S_a}, mu * s.normal + S_a * s.area * s.dt + 1e9 * s.normal >= s.full * 1e7
                                                     ? ContactLawSpec(StickContact{})
                                                     : ContactLawSpec(SpeedFrictionContact{mu, 1e9 / v, S_a}));
    for (const double v_h : {1e8, 1e15, 1e25, 1e60}) same(RateWeakeningContact{mu, mu_s, v_h * v, S_a}, AdhesiveContact{mu_s, S_a, 1});
    same(RateWeakeningContact{mu, mu, v, S_a}, AdhesiveContact{mu, S_a, 1});
    if (mu_s * s.normal + S_a * s.area * s.dt < s.full) {
      const double slides = s.full - mu_s * s.normal - S_a * s.area * s.dt;  // there is a speed to weaken at
      same(RateWeakeningContact{mu, mu_s, 1e-8 * v * slides / s.full, S_a}, AdhesiveContact{mu, S_a, 1});
    }
    same(SlipWeakeningContact{mu, mu_s, 1e9 * s.slip, S_a}, AdhesiveContact{mu_s, S_a, 1});
    same(SlipWeakeningContact{mu, mu_s, 1e-3 * s.slip, S_a}, CoulombContact{mu});
    same(ViscousContact{1e9 * s.mass / (s.area * s.dt), 1}, StickContact{});
    same(ViscousContact{1e-9 * s.mass / (s.area * s.dt), 1}, FrictionlessContact{});
    same(CoulombContact{mu, std::nullopt, 1e-9 * s.full / (s.area * s.dt)}, FrictionlessContact{});
    same(CoulombContact{0}, FrictionlessContact{});
    same(BondedContact{}, StickContact{});
  }
}

/// Friction that falls faster with speed than slip can grow within the step holds the two together; friction that would turn negative is
/// none.
TEST(FrictionLaw, StrongWeakeningWithSpeed) {
  Sliding s;
  s.mass = 2, s.normal = 3, s.full = 4, s.dt = 1e-4, s.area = 1e-3;
  EXPECT_TRUE((SpeedFrictionContact{0.5, -1, 0}.limit(s).sticks));  // 1 + k N/m = -.5
  EXPECT_EQ(impulse(SpeedFrictionContact{0.1, -0.5, 0}, s), 0);     // mu at 2 m/s would be -.9
  EXPECT_FALSE((SpeedFrictionContact{0.1, -0.5, 0}.limit(s).sticks));
}

TEST(FrictionLaw, AdhesionEndsOnAnEllipse) {
  Random random(10);
  for (int trial = 0; trial < 5000; ++trial) {
    const double S_a = random.decades(0, 9), N_a = random.decades(0, 9), area = random.decades(-8, 0), dt = random.decades(-8, -3);
    const ContactLawSpec law = AdhesiveContact{0.3, S_a, N_a};
    const double angle = random.draw(0, 1.5707), full = S_a * area * dt * std::cos(angle), pull = N_a * area * dt * std::sin(angle);
    EXPECT_TRUE(law->holds({pull * (1 - 1e-9), full * (1 - 1e-9), dt, area}));
    EXPECT_FALSE(law->holds({pull * (1 + 1e-9), full * (1 + 1e-9), dt, area}));
    // Pressure does not help the glue.
    EXPECT_FALSE(law->holds({-pull, S_a * area * dt * (1 + 1e-9), dt, area}));
    EXPECT_TRUE(law->holds({-pull, S_a * area * dt * (1 - 1e-9), dt, area}));
    EXPECT_FALSE(law->holds({pull, full, dt, 0}));
    EXPECT_FALSE(ContactLawSpec(CoulombContact{0.3})->holds({0, 0, dt, area}));
  }
}

TEST(FrictionLaw, AsksForWhatItNeeds) {
  for (const auto& [law, area, history] :
       std::initializer_list<std::tuple<ContactLawSpec, bool, bool>>{{FrictionlessContact{}, false, false},
                                                                     {StickContact{}, false, false},
                                                                     {BondedContact{}, false, false},
                                                                     {CoulombContact{0.3}, false, false},
                                                                     {CoulombContact{0.3, 0.4, {}}, false, false},
                                                                     {CoulombContact{0.3, {}, 1e6}, true, false},
                                                                     {AdhesiveContact{0.3, 1, 1}, true, false},
                                                                     {SpeedFrictionContact{0.3, 1, 0}, true, false},
                                                                     {RateWeakeningContact{0.3, 0.4, 1, 0}, true, false},
                                                                     {SlipWeakeningContact{0.3, 0.4, 1, 0}, true, true},
                                                                     {ViscousContact{1, 1}, true, false}}) {
    EXPECT_EQ(law->needs_area(), area) << law->name();
    EXPECT_EQ(law->needs_history(), history) << law->name();
  }
}

}  // namespace
}  // namespace crampon::test
