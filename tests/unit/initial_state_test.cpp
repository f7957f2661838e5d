/// Particles that start with a given stress: the law itself says so, and its energy is the work done on the way there.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "crampon/material/elastic_large_rotation.hpp"
#include "crampon/material/elastic_small_strain.hpp"
#include "crampon/material/initial_state.hpp"
#include "crampon/material/j2_plasticity.hpp"
#include "crampon/material/neo_hookean.hpp"

namespace crampon {
namespace {

template <class Law>
std::shared_ptr<const MaterialLaw> make_law() {
  Law law;
  law.E = 3e6, law.nu = 0.3, law.density = 1000;
  return std::make_shared<LawKernel<Law>>(law);
}
const std::vector<std::shared_ptr<const MaterialLaw>>& laws() {
  static const std::vector<std::shared_ptr<const MaterialLaw>> list{make_law<ElasticSmallStrain>(), make_law<ElasticLargeRotation>(),
                                                                    make_law<NeoHookean>()};
  return list;
}

/// Random stresses of four sizes, from 1 Pa (strains of 3e-7) to a fifth of Young's modulus; the stress of the law, turned into the Cauchy stress,
/// is what was asked for to 1e-9 of its size, and no better than the round-off of 1 + strain allows (1e-15 E).
template <int Dim>
void check_stress(StressState state) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr std::array<int, 6> stored = Dim == 2 ? std::array<int, 6>{0, 1, 2} : std::array<int, 6>{0, 1, 2, 3, 4, 5};
  for (const auto& law : laws()) {
    for (int trial = 0; trial < 20; ++trial) {
      Pack wanted[chosen_stress_size<Dim>], stress[stress_size<Dim>], history[16];
      for (Pack& w : wanted) {
        for (int l = 0; l < lanes; ++l) w[l] = uniform(random) * std::array<double, 4>{1, 1e3, 1e5, 2e5}[static_cast<std::size_t>(l)];
      }
      ASSERT_TRUE(find_initial_state<Dim>(*law, state, wanted, stress, history)) << law->name();
      const PackReport report = law->report(state, Dim, stress, history);
      for (int l = 0; l < lanes; ++l) {
        double size = 0;
        for (const Pack& w : wanted) size = std::fmax(size, std::fabs(w[l]));
        for (std::size_t c = 0; c < std::size(wanted); ++c) {
          EXPECT_NEAR(stress[stored[c]][l] * report.to_cauchy[l], wanted[c][l], 1e-9 * size + 3e-15 * 3e6 * 10) << law->name();
        }
        EXPECT_GT(report.energy[l], 0) << law->name();
      }
    }
  }
}

TEST(InitialState, HasTheStressThatWasAskedFor) {
  check_stress<2>(StressState::plane_strain);
  check_stress<2>(StressState::plane_stress);
  check_stress<3>(StressState::three_dimensional);
}

TEST(InitialState, OfNoStressIsThatOfTheUndeformedLaw) {
  for (const auto& law : laws()) {
    const Pack wanted[3] = {};
    Pack stress[4], history[16], plain_stress[4], plain_history[16];
    ASSERT_TRUE(find_initial_state<2>(*law, StressState::plane_strain, wanted, stress, history));
    law->initialise(2, plain_stress, plain_history);
    for (int c = 0; c < law->history_size(2); ++c) EXPECT_EQ(history[c][1], plain_history[c][1]) << law->name();
    for (int c = 0; c < 4; ++c) EXPECT_EQ(stress[c][2], 0) << law->name();
  }
}

/// A stress of a million times Young's modulus: laws may have no state for it. The search then says so; where it finds one, the stress is right.
TEST(InitialState, SaysSoWhereTheLawHasNoSuchState) {
  const Pack wanted[3] = {splat(-1e12), splat(1e12), splat(0.)};
  for (const auto& law : laws()) {
    Pack stress[4], history[16];
    if (!find_initial_state<2>(*law, StressState::plane_strain, wanted, stress, history)) continue;
    const PackReport report = law->report(StressState::plane_strain, 2, stress, history);
    EXPECT_NEAR(stress[0][0] * report.to_cauchy[0], -1e12, 1e3) << law->name();
  }
}

/// A metal bears stress below yield from the start; a stress beyond it took flow on a way that nobody has told.
TEST(InitialState, OfAMetalLiesBelowYield) {
  const LawKernel<J2Plasticity> steel({200e9, 0.3, 250e6, 1e9, 7850});
  for (const double stress : {-249e6, 100e6, 249e6, 251e6, 400e6}) {
    const bool below = std::fabs(stress) < 250e6;
    Pack plane[3] = {splat(stress), splat(0.), splat(0.)},
         space[6] = {splat(stress), splat(0.), splat(0.), splat(0.), splat(0.), splat(0.)};
    Pack found[6], history[17];
    EXPECT_EQ(find_initial_state<2>(steel, StressState::plane_stress, plane, found, history), below) << stress;
    EXPECT_EQ(find_initial_state<3>(steel, StressState::three_dimensional, space, found, history), below) << stress;
    if (!below) continue;
    EXPECT_NEAR(found[0][0] / steel.report(StressState::three_dimensional, 3, found, history).volume_ratio[0], stress,
                1e-9 * std::fabs(stress));
    EXPECT_EQ(history[steel.find_variable(3, "plastic_strain")->at][0], 0);
  }
}

}  // namespace
}  // namespace crampon
