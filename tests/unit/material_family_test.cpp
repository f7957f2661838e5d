/// What every law of the family must do, for every law that is registered: a new one is tested without a list (material_examples()).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "crampon/run/quantities.hpp"
#include "unit/material_points.hpp"

namespace crampon::test {
namespace {

struct Member {
  MaterialSpec law;
  StressState state;
};

constexpr const char* state_names[] = {"plane_strain", "plane_stress", "three_dimensional"};

std::vector<Member> members() {
  std::vector<Member> all;
  for (const MaterialSpec& law : material_examples()) {
    for (const StressState state : {StressState::plane_strain, StressState::plane_stress, StressState::three_dimensional})
      all.push_back({law, state});
  }
  return all;
}
void PrintTo(const Member& m, std::ostream* out) { *out << m.law->name() << " in " << state_names[static_cast<int>(m.state)]; }

class EveryLaw : public testing::TestWithParam<Member> {
 protected:
  MaterialSpec law = GetParam().law;
  StressState state = GetParam().state;
  int dimension = state == StressState::three_dimensional ? 3 : 2;
  bool turns = law->follows_deformation();
  /// Of a strain of 1.
  double modulus = law->density() * law->wave_speed(state) * law->wave_speed(state);

  /// Rate of deformation at a time from 0 to 1: a strain of some per cent goes on, bends and partly returns. The body turns where the law allows for it.
  struct Path {
    Matrix3d first, second, spin;
    Matrix3d operator()(double t) const { return first * std::cos(4 * t) + second * std::sin(3 * t) + spin; }
  };
  Path path(Random& random) const {
    Path p;
    const auto strain = [&] {
      const Matrix3d a = random.gradient(state, 1);
      return Matrix3d(0.02 * (a + a.transpose()) / (a + a.transpose()).norm());
    };
    p.first = strain(), p.second = strain();
    const Matrix3d a = random.gradient(state, 1);
    p.spin = turns ? Matrix3d(0.5 * (a - a.transpose())) : Matrix3d(Matrix3d::Zero());
    return p;
  }
};

INSTANTIATE_TEST_SUITE_P(Materials, EveryLaw, testing::ValuesIn(members()), [](const testing::TestParamInfo<Member>& of) {
  return of.param.law->name() + "_" + state_names[static_cast<int>(of.param.state)];
});

TEST_P(EveryLaw, StartsAtRest) {
  Points points(law, state);
  const Answer a = points.answer(0);
  EXPECT_EQ(a.stress.norm(), 0);
  EXPECT_EQ(a.energy, 0);
  EXPECT_EQ(a.volume_ratio, 1);
  for (const LawVariable& v : law->variables(dimension)) {
    for (int c = 0; c < v.size(dimension); ++c) EXPECT_TRUE(std::isfinite(points.variable(0, v.name, c))) << v.name;
  }
  EXPECT_EQ(points.dissipated(0), 0);
  EXPECT_GT(law->density(), 0);
  EXPECT_GT(law->wave_speed(state), 0);
  EXPECT_NEAR(points.wave_speed(0), law->wave_speed(state), 1e-12 * law->wave_speed(state));
  Pack F[9];
  law->deformation(state, dimension, points.stress(0), points.history(0), F);
  for (int c = 0; c < dimension * dimension; ++c) EXPECT_EQ(F[c][0], c % (dimension + 1) == 0 ? 1 : 0);

  // A step without motion changes nothing.
  ASSERT_TRUE(points.update([](int) { return Matrix3d(Matrix3d::Zero()); }, 1e-3));
  EXPECT_LT(points.answer(0).stress.norm(), 1e-14 * modulus);
  EXPECT_LT(std::fabs(points.answer(0).energy), 1e-14 * modulus);
  EXPECT_EQ(points.dissipated(0), 0);
}

/// What the law stores and what it takes are together the work done on it; what it takes never comes back.
TEST_P(EveryLaw, AccountsForTheWorkDoneOnIt) {
  Random random;
  for (int trial = 0; trial < 3; ++trial) {
    const Path L = path(random);
    const auto error = [&](int steps) {
      Points points(law, state);
      double work = 0, total = 0, taken = 0;
      Matrix3d before = Matrix3d::Zero();
      for (int step = 0; step < steps; ++step) {
        Matrix3d now = L((step + 0.5) / steps);
        points.update([&](int) { return now; }, 1. / steps);
        const Matrix3d stress = points.answer(0).stress;
        const double power = (0.5 * (before + stress).array() * now.array()).sum() / steps;
        work += power, total += std::fabs(power);
        EXPECT_GE(points.dissipated(0), taken);
        taken = points.dissipated(0);
        before = stress;
      }
      return std::fabs(work - points.answer(0).energy - points.dissipated(0)) / total;
    };
    // The rule of trapezoids is of second order where the stress is smooth, of first order in the steps in which a law begins to flow.
    const double coarse = error(500), fine = error(4000);
    EXPECT_LT(fine, 2e-4);
    EXPECT_TRUE(fine < 0.5 * coarse || fine < 1e-9) << coarse << " " << fine;
  }
}

/// A law that follows the deformation gradient gives a body that turns as one no stress, and turns the stress that it bears.
TEST_P(EveryLaw, TurnsWithTheBodyWhereItFollowsItsDeformation) {
  if (!turns) GTEST_SKIP() << law->name() << " adds up small strains";
  Random random;
  const Path L = path(random);
  Points points(law, state);
  for (int step = 0; step < 100; ++step) points.update([&](int) { return L((step + 0.5) / 100); }, 0.01);
  const Matrix3d strained = points.answer(0).stress;
  const double energy = points.answer(0).energy, taken = points.dissipated(0);
  Vector3d axis = Vector3d::UnitZ();
  if (dimension == 3) axis = Vector3d(1, -2, 3).normalized();
  Matrix3d spin;
  spin << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const int steps = 2000;
  const double turn = 2.5, per_step = turn / steps;
  for (int step = 0; step < steps; ++step) ASSERT_TRUE(points.update([&](int) { return spin; }, per_step));
  // I + A + A^2/2 turns by w - w^3/6 and stretches by w^4/8 in a step.
  const Matrix3d R = Eigen::AngleAxisd(turn - steps * std::pow(per_step, 3) / 6, axis).toRotationMatrix();
  const double stretch = steps * std::pow(per_step, 4) / 8;
  EXPECT_LT((points.answer(0).stress - R * strained * R.transpose()).norm(), modulus * (4 * stretch + 1e-11) + 1e-6 * strained.norm());
  EXPECT_NEAR(points.answer(0).energy, energy, strained.norm() * 2 * stretch + 1e-6 * energy);
  EXPECT_NEAR(points.dissipated(0), taken, strained.norm() * 4 * stretch);
}

TEST_P(EveryLaw, KeepsToTheStateOfStress) {
  Random random;
  const Path L = path(random);
  Points points(law, state), in_space(law, StressState::three_dimensional);
  for (int step = 0; step < 200; ++step) {
    Matrix3d now = L((step + 0.5) / 200);
    points.update([&](int) { return now; }, 1. / 200);
    if (state == StressState::plane_stress) {
      ASSERT_EQ(points.answer(0).stress(2, 2), 0);
    } else {
      in_space.update([&](int) { return now; }, 1. / 200);
      ASSERT_LT((points.answer(0).stress - in_space.answer(0).stress).norm(), 1e-11 * modulus);
      ASSERT_NEAR(points.answer(0).energy, in_space.answer(0).energy, 1e-11 * modulus);
      ASSERT_NEAR(points.answer(0).volume_ratio, in_space.answer(0).volume_ratio, 1e-11);
      ASSERT_NEAR(points.dissipated(0), in_space.dissipated(0), 1e-11 * modulus);
    }
  }
}

/// A particle's numbers are its own: they do not depend on which others share its pack.
TEST_P(EveryLaw, LanesAreParticlesOfTheirOwn) {
  Random random;
  std::array<Path, lanes> paths;
  for (Path& p : paths) p = path(random);
  Points together(law, state);
  std::vector<Points> apart;
  for (int l = 0; l < lanes; ++l) apart.emplace_back(law, state);
  for (int step = 0; step < 100; ++step) {
    const double t = (step + 0.5) / 100;
    // The others of a pack rest, so that no decision is taken for them.
    together.update([&](int p) { return paths[static_cast<std::size_t>(p)](t); }, 0.01);
    for (int l = 0; l < lanes; ++l)
      apart[static_cast<std::size_t>(l)].update(
          [&](int p) { return p == l ? paths[static_cast<std::size_t>(l)](t) : Matrix3d(Matrix3d::Zero()); }, 0.01);
  }
  for (int l = 0; l < lanes; ++l) {
    EXPECT_EQ((together.answer(l).stress - apart[static_cast<std::size_t>(l)].answer(l).stress).norm(), 0);
    EXPECT_EQ(together.dissipated(l), apart[static_cast<std::size_t>(l)].dissipated(l));
  }
}

TEST(MaterialFamily, EveryLawHasAnExample) {
  std::set<std::string> with_example, listed;
  for (const MaterialSpec& law : material_examples()) EXPECT_TRUE(with_example.insert(law->name()).second) << law->name() << " twice";
  for (const Alternative& of : materials().alternatives()) listed.insert(of.record->name());
  EXPECT_EQ(with_example, listed);
}

TEST(MaterialFamily, NoVariableBearsTheNameOfAnotherThing) {
  std::vector<const MaterialLaw*> laws;
  const std::vector<MaterialSpec> examples = material_examples();
  for (const MaterialSpec& law : examples) laws.push_back(law.get());
  EXPECT_NO_THROW(quantities_of_laws(laws));
}

}  // namespace
}  // namespace crampon::test
