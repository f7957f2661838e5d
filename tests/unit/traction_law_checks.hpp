#pragma once
/// What every traction law must do, as checks of one law: traction_family_test applies them to all that are registered, and
/// toy_traction_test shows that checks find laws that break them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "crampon/crack/traction/law.hpp"

namespace crampon::test {

/// An opening at which the law is far along: its final one where it has one, m.
inline double size_of(const TractionLaw& law) {
  const double G = law.toughness().normal, k = law.largest_stiffness();
  return std::isfinite(G) && G > 0 && k > 0 ? 10 * std::sqrt(2 * G / k) : 1e-5;
}

/// A path that wanders, opens and closes, and grows with t from 0 to about twice the size of the law.
inline PerMode wandering(double t, double size) {
  return {size * t * (0.8 + 1.3 * std::sin(31 * t)), size * t * (0.3 + 1.4 * std::sin(17 * t + 1) - 0.5 * std::cos(47 * t))};
}

inline void check_starts_whole(const TractionLaw& law) {
  TractionHistory history;
  const Traction T = update_traction(law, {0, 0}, 0, {}, history);
  EXPECT_EQ(T.shear, 0);
  EXPECT_EQ(T.stored, 0);
  if (!law.from_outside()) {
    EXPECT_EQ(T.normal, 0) << "pulls on faces that have not moved";
  }
  EXPECT_EQ(history.damage, 0);
  EXPECT_EQ(history.failed, 0);
  EXPECT_EQ(history.dissipated_normal + history.dissipated_shear, 0);
  EXPECT_GE(law.largest_stiffness(), 0);
  EXPECT_TRUE(std::isfinite(law.largest_stiffness()));
}

/// Along a path that wanders to failure and beyond: tractions resist, damage and dissipation never fall, faces that press bear nothing unless the law says
/// so, and what has failed bears nothing.
inline void check_resists(const TractionLaw& law) {
  const double size = size_of(law), k = law.largest_stiffness();
  TractionHistory history;
  constexpr int steps = 3000;
  for (int step = 1; step <= steps; ++step) {
    const TractionHistory last = history;
    const PerMode u = wandering(1.5 * step / steps, size);
    const Traction T = update_traction(law, u, 0, {}, history);
    ASSERT_TRUE(std::isfinite(T.normal) && std::isfinite(T.shear) && std::isfinite(T.stored));
    EXPECT_GE(T.stored, 0);
    EXPECT_GE(T.shear * u.shear, 0) << "shear drives sliding";
    EXPECT_GE(history.damage, last.damage * (1 - 1e-14)) << "damage heals";
    EXPECT_LE(history.damage, 1);
    EXPECT_GE(history.dissipated_normal, last.dissipated_normal * (1 - 1e-14)) << "gives back what is spent";
    EXPECT_GE(history.dissipated_shear, last.dissipated_shear * (1 - 1e-14)) << "gives back what is spent";
    if (!law.from_outside()) {
      EXPECT_GE(T.normal, 0) << "pushes faces apart";
      EXPECT_LE(T.normal, k * std::max(u.normal, 0.) * (1 + 1e-12)) << "is stiffer than it says";
    }
    EXPECT_LE(std::abs(T.shear), k * std::abs(u.shear) * (1 + 1e-12)) << "is stiffer than it says";
    if (!law.acts_closed() && u.normal <= 0) {
      EXPECT_EQ(T.normal, 0) << "acts on faces that press";
    }
    if (history.failed != 0) {
      EXPECT_EQ(T.normal + T.shear + T.stored, 0) << "bears after failure";
    }
    if (testing::Test::HasFailure()) return;
  }
}

/// Work is stored or dissipated, to the second order of the step, and to the first in the one step in which the law gives way; pressure does work from
/// outside.
inline void check_accounts_for_work(const TractionLaw& law) {
  if (law.from_outside()) return;
  const double size = size_of(law);
  for (const bool to_failure : {false, true}) {
    const double part = to_failure ? 1 : 0.03;
    for (const int steps : {4000, 16000}) {
      TractionHistory history;
      double error = 0, most = 0;
      for (int step = 1; step <= steps; ++step) {
        const PerMode path = wandering(1.5 * step / steps, size);
        const Traction T = update_traction(law, {part * path.normal, part * path.shear}, 0, {}, history);
        const double spent = T.stored + history.dissipated_normal + history.dissipated_shear;
        most = std::max(most, spent);
        error = std::max(error, std::abs(history.work_normal + history.work_shear - spent));
      }
      EXPECT_LE(error, (history.failed != 0 ? 200. : 1e4 / steps) / steps * most) << "work is lost or made";
    }
  }
}

/// A law that fails takes its toughness in each mode alone, however long the steps; sliding either way is the same.
inline void check_toughness(const TractionLaw& law) {
  const PerMode G = law.toughness();
  const double far = 100 * size_of(law);
  for (const bool in_shear : {false, true}) {
    const double toughness = in_shear ? G.shear : G.normal;
    for (const int steps : {1, 10, 1000}) {
      for (const double sign : {1., -1.}) {
        if (!in_shear && sign < 0) continue;
        TractionHistory history;
        for (int step = 1; step <= steps; ++step) {
          const double u = sign * far * step / steps;
          update_traction(law, in_shear ? PerMode{0, u} : PerMode{u, 0}, 0, {}, history);
        }
        const bool fails = std::isfinite(toughness) && toughness > 0;
        EXPECT_EQ(history.failed != 0, fails);
        EXPECT_NEAR(history.dissipated_normal + history.dissipated_shear, fails ? toughness : 0, 1e-9 * (fails ? toughness : 1))
            << "takes another energy than its toughness";
      }
    }
  }
}

}  // namespace crampon::test
