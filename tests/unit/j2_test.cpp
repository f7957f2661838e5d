/// J2 plasticity: closed forms, and the same law written once more as a flow rule on F_p with explicit steps (docs/theory/materials.md).

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "crampon/material/j2_plasticity.hpp"
#include "crampon/material/material.hpp"
#include "unit/material_points.hpp"

namespace crampon::test {
namespace {

constexpr StressState all_states[] = {StressState::plane_strain, StressState::plane_stress, StressState::three_dimensional};

/// Parameters in units in which the yield stress is of the order of 1.
J2Plasticity steel(double H = 20) { return {1000, 0.3, 2, H, 2}; }
MaterialSpec made(const J2Plasticity& law) { return std::make_shared<LawKernel<J2Plasticity>>(law); }

double equivalent(const Matrix3d& stress) {
  const Matrix3d s = stress - stress.trace() / 3 * Matrix3d::Identity();
  return std::sqrt(1.5) * s.norm();
}

/// L of one step of 1 s that multiplies F by diag(exp(e)).
Matrix3d log_stretching(double x, double y, double z) { return stretching(std::exp(x), std::exp(y), std::exp(z)); }

template <class F>
Matrix3d of_symmetric(const Matrix3d& a, F f) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(a);
  return eigen.eigenvectors() * eigen.eigenvalues().unaryExpr(f).asDiagonal() * eigen.eigenvectors().transpose();
}

/// The law as a rate equation, of F and F_p: d_p = gamma 3/2 s/q in the frame of the stress, gamma from q' = Y'. Forward Euler in very small steps.
class Flow {
 public:
  Flow(const J2Plasticity& law, StressState state) : law_(law), state_(state) {}

  void advance(const Matrix3d& dF) {
    F_ = dF * F_;
    if (state_ == StressState::plane_stress) find_thickness();
    const double mu = law_.E / (2 * (1 + law_.nu));
    const double beyond = equivalent(stress()) - yield();
    if (beyond <= 0) return;
    const Matrix3d tau = stress(), s = tau - tau.trace() / 3 * Matrix3d::Identity();
    // q falls by 3 mu d as the flow is d at fixed F; under plane stress the thickness gives way besides, which the next step sees.
    const double d = beyond / (3 * mu + law_.hardening_modulus), q = equivalent(tau);
    const Matrix3d Fe = F_ * Fp_.inverse();
    const Matrix3d increment = d * 1.5 / q * s;
    Fp_ = Fe.inverse() * of_symmetric(increment, [](double x) { return std::exp(x); }) * Fe * Fp_;
    work_ += d * 0.5 * (q + equivalent(stress()));
    alpha_ += d;
    if (state_ == StressState::plane_stress) find_thickness();
  }
  Matrix3d stress() const {
    const Matrix3d Fe = F_ * Fp_.inverse();
    const Matrix3d e = of_symmetric(Fe * Fe.transpose(), [](double x) { return 0.5 * std::log(x); });
    const double mu = law_.E / (2 * (1 + law_.nu)), lambda = law_.E * law_.nu / ((1 + law_.nu) * (1 - 2 * law_.nu));
    return lambda * e.trace() * Matrix3d::Identity() + 2 * mu * e;
  }
  double yield() const { return law_.yield_stress + law_.hardening_modulus * alpha_; }
  double alpha() const { return alpha_; }
  double work() const { return work_; }
  const Matrix3d& F() const { return F_; }

 private:
  void find_thickness() {
    for (int k = 0; k < 20; ++k) {
      const double stiffness = law_.E * (1 - law_.nu) / ((1 + law_.nu) * (1 - 2 * law_.nu));
      F_(2, 2) *= std::exp(-stress()(2, 2) / stiffness);
    }
  }
  J2Plasticity law_;
  StressState state_;
  Matrix3d F_ = Matrix3d::Identity(), Fp_ = Matrix3d::Identity();
  double alpha_ = 0, work_ = 0;
};

/// Takes a point from its state to axial logarithmic strain `to` in one step, its sides free: the side strain is sought.
/// before: the side strain so far.
struct Bar {
  explicit Bar(const J2Plasticity& of, StressState in) : law(of), state(in), points(made(of), in) {}
  void stretch(double by) {
    double low = -std::fabs(by), high = std::fabs(by);
    const Points start = points;
    for (int k = 0; k < 80; ++k) {
      const double side = 0.5 * (low + high);
      points = start;
      points.update([&](int) { return log_stretching(by, side, state == StressState::three_dimensional ? side : 0); }, 1);
      (points.answer(0).stress(1, 1) > 0 ? high : low) = side;
    }
  }
  J2Plasticity law;
  StressState state;
  Points points;
};

// In uniaxial stress the direction of flow stays, so that the step size does not enter: e = tau/E + alpha, tau = Y + H alpha.
TEST(J2Plasticity, BarInTensionAndBack) {
  for (const StressState state : {StressState::plane_stress, StressState::three_dimensional}) {
    for (const double H : {0., 20., 100.}) {
      const J2Plasticity law = steel(H);
      const double E = law.E, Y = law.yield_stress;
      Bar bar(law, state);
      bar.stretch(0.9 * Y / E);
      EXPECT_NEAR(bar.points.answer(0).stress(0, 0), 0.9 * Y, 1e-10 * Y);
      EXPECT_EQ(bar.points.variable(0, "plastic_strain"), 0);
      bar.stretch(0.02 - 0.9 * Y / E);
      const double first = (E * 0.02 - Y) / (E + H), top = Y + H * first;
      EXPECT_NEAR(bar.points.answer(0).stress(0, 0), top, 1e-9 * Y) << H;
      EXPECT_NEAR(bar.points.variable(0, "plastic_strain"), first, 1e-11);
      EXPECT_NEAR(bar.points.dissipated(0), Y * first + 0.5 * H * first * first, 1e-9 * Y * first);
      EXPECT_NEAR(bar.points.answer(0).energy, top * top / (2 * E), 1e-9 * top * top / E);
      // Volume changes by elasticity alone: J = exp(tr e).
      EXPECT_NEAR(std::log(bar.points.answer(0).volume_ratio), (1 - 2 * law.nu) * top / E, 1e-11);
      // Back to no strain: elastic over 2 top / E, then flow in compression.
      bar.stretch(-2 * top / E * 0.999);
      EXPECT_NEAR(bar.points.variable(0, "plastic_strain"), first, 1e-11) << "the elastic range has grown with the yield stress";
      bar.stretch(-0.02 + 2 * top / E * 0.999);
      const double second = first + (E * 0.02 - 2 * top) / (E + H);
      EXPECT_NEAR(bar.points.answer(0).stress(0, 0), -(Y + H * second), 1e-9 * Y) << H;
      EXPECT_NEAR(bar.points.variable(0, "plastic_strain"), second, 1e-11);
    }
  }
}

// Pure shear: q = sqrt(3) tau = 3 mu (2/sqrt(3) e - alpha) in every state of stress.
TEST(J2Plasticity, PureShearInEveryStateOfStress) {
  const J2Plasticity law = steel();
  const double mu = law.E / (2 * (1 + law.nu));
  for (const StressState state : all_states) {
    Points points(made(law), state);
    for (int step = 1; step <= 4; ++step) {
      points.update([](int) { return log_stretching(0.002, -0.002, 0); }, 1);
      const double e = 0.002 * step,
                   alpha = std::fmax(0, (3 * mu * 2 / std::sqrt(3.) * e - law.yield_stress) / (3 * mu + law.hardening_modulus));
      const double tau = alpha > 0 ? (law.yield_stress + law.hardening_modulus * alpha) / std::sqrt(3.) : 2 * mu * e;
      EXPECT_NEAR(points.answer(0).stress(0, 0), tau, 1e-9 * law.yield_stress);
      EXPECT_NEAR(points.answer(0).stress(1, 1), -tau, 1e-9 * law.yield_stress);
      EXPECT_NEAR(points.answer(0).stress(2, 2), 0, 1e-9 * law.yield_stress);
      EXPECT_NEAR(points.variable(0, "plastic_strain"), alpha, 1e-11);
    }
  }
}

// Uniaxial strain (the plate of an impact): yields at Y (lambda + 2 mu)/(2 mu), then rises with the bulk modulus where H = 0.
TEST(J2Plasticity, UniaxialStrainYieldsAtTheHugoniotElasticLimit) {
  const J2Plasticity law{200e9, 0.3, 400e6, 0, 8000};
  const double K = law.E / (3 * (1 - 2 * law.nu)), mu = law.E / (2 * (1 + law.nu)), limit = law.yield_stress * (K + 4 * mu / 3) / (2 * mu);
  EXPECT_NEAR(limit, 700e6, 1e-3);
  for (const StressState state : {StressState::plane_strain, StressState::three_dimensional}) {
    Points points(made(law), state);
    const double at_limit = limit / (K + 4 * mu / 3);
    points.update([&](int) { return log_stretching(-0.999999 * at_limit, 0, 0); }, 1);
    EXPECT_EQ(points.dissipated(0), 0);
    points.update([&](int) { return log_stretching(-at_limit, 0, 0); }, 1);
    EXPECT_NEAR(points.answer(0).stress(0, 0), -(limit + K * 0.999999 * at_limit), 1e-5 * limit);
  }
}

// Explicit steps of the rate equation, against the engine's steps: both are of first order where the direction of flow turns.
TEST(J2Plasticity, FollowsTheFlowRuleInShearAndTurns) {
  const J2Plasticity law = steel();
  for (const StressState state : all_states) {
    Random random;
    for (int path = 0; path < 4; ++path) {
      const Matrix3d first = random.gradient(state, 0.03), second = random.gradient(state, 0.03), turn = random.gradient(state, 1);
      const Matrix3d spin = turn - turn.transpose();
      const auto L = [&](double t) { return Matrix3d((t < 0.5 ? first : Matrix3d(second - 0.3 * first)) + spin); };
      const auto run = [&](int steps) {
        Points points(made(law), state);
        for (int k = 0; k < steps; ++k) points.update([&](int) { return L((k + 0.5) / steps); }, 1. / steps);
        return points;
      };
      constexpr int fine = 16000;
      Flow flow(law, state);
      for (int k = 0; k < fine; ++k) {
        const Matrix3d A = L((k + 0.5) / fine) / fine;
        flow.advance(Matrix3d::Identity() + A + 0.5 * A * A);
      }
      ASSERT_GT(flow.alpha(), 0.005);
      Points coarse = run(200), finer = run(1600);
      // A step of the path is 200 or 1600th of a strain of some 4 per cent, ten to twenty yield strains: the stress turns by less than .1 (.0125) a step
      // and lags by some tenths of that.
      const double of_coarse = (coarse.answer(0).stress - flow.stress()).norm(), of_finer = (finer.answer(0).stress - flow.stress()).norm();
      EXPECT_LT(of_coarse, 0.02 * law.yield_stress);
      EXPECT_LT(of_finer, 0.0025 * law.yield_stress);
      EXPECT_NEAR(finer.variable(0, "plastic_strain"), flow.alpha(), 2e-3 * flow.alpha());
      EXPECT_NEAR(finer.dissipated(0), flow.work(), 2e-3 * flow.work());
      EXPECT_NEAR(finer.answer(0).volume_ratio, flow.F().determinant(), 1e-4);
    }
  }
}

// Whatever the step: q = Y after flow, alpha and the plastic work rise together, and the work is that of the yield stress on its way.
TEST(J2Plasticity, EndsOnTheYieldSurface) {
  Random random;
  for (const StressState state : all_states) {
    for (const double nu : {-0.9, 0., 0.3, 0.499}) {
      for (const double H : {0., 20., 3000.}) {
        J2Plasticity law = steel(H);
        law.nu = nu;
        Points points(made(law), state);
        std::vector<double> alpha(static_cast<std::size_t>(points.size()), 0);
        for (int step = 0; step < 40; ++step) {
          // From a tenth of the yield strain to some hundred times it in one step.
          const double size = 2e-4 * std::pow(10, random.draw(0, 3));
          std::vector<Matrix3d> L;
          for (int p = 0; p < points.size(); ++p) L.push_back(random.gradient(state, size));
          ASSERT_TRUE(points.update([&](int p) { return L[static_cast<std::size_t>(p)]; }, 1));
          for (int p = 0; p < points.size(); ++p) {
            double& before = alpha[static_cast<std::size_t>(p)];
            const double now = points.variable(p, "plastic_strain"), Y = law.yield_stress + H * now,
                         q = equivalent(points.answer(p).stress);
            // The deviator is a difference of logarithms of numbers near 1, with 1e-16 of round-off beside a yield strain of 2e-3 and a stretch of up to 2;
            // the modulus at nu = -.9 is 13 times that at .3.
            ASSERT_LT(q, Y + 1e-11 * law.E / (1 + nu)) << nu << " " << H;
            if (now > before) {
              ASSERT_GT(q, Y - 1e-11 * law.E / (1 + nu)) << nu << " " << H;
            }
            ASSERT_GE(now, before);
            ASSERT_NEAR(points.dissipated(p), law.yield_stress * now + 0.5 * H * now * now, 1e-12 * Y * (now + 1e-3));
            if (state == StressState::plane_stress) {
              ASSERT_EQ(points.answer(p).stress(2, 2), 0);
            }
            before = now;
          }
        }
        EXPECT_GT(alpha[0], 0.04) << "twenty yield strains";
      }
    }
  }
}

// Plane strain and plane stress are cases of the law in space.
TEST(J2Plasticity, PlanesAreCasesOfSpace) {
  const J2Plasticity law = steel();
  Random random;
  for (int path = 0; path < 5; ++path) {
    Points strain(made(law), StressState::plane_strain), stress(made(law), StressState::plane_stress);
    Points in_space(made(law), StressState::three_dimensional), free(made(law), StressState::three_dimensional);
    double thickness = 1, plane = 1;
    for (int step = 0; step < 20; ++step) {
      const Matrix3d L = random.gradient(StressState::plane_strain, 0.01);
      for (Points* points : {&strain, &stress, &in_space}) points->update([&](int) { return L; }, 1);
      EXPECT_LT((strain.answer(0).stress - in_space.answer(0).stress).norm(), 1e-10 * law.E);
      EXPECT_NEAR(strain.variable(0, "plastic_strain"), in_space.variable(0, "plastic_strain"), 1e-12);
      EXPECT_NEAR(strain.answer(0).energy, in_space.answer(0).energy, 1e-10 * law.E);
      // The thickness that plane stress finds, given to the law in space.
      const double J = stress.answer(0).volume_ratio;
      const Matrix3d A = Matrix3d::Identity() + L + 0.5 * L * L;
      plane *= A.topLeftCorner<2, 2>().determinant();
      Matrix3d with_thickness = L;
      with_thickness(2, 2) = std::sqrt(2 * (J / plane / thickness) - 1) - 1;
      thickness = J / plane;
      free.update([&](int) { return with_thickness; }, 1);
      EXPECT_LT((stress.answer(0).stress - free.answer(0).stress).norm(), 1e-9 * law.E) << step;
      EXPECT_NEAR(stress.variable(0, "plastic_strain"), free.variable(0, "plastic_strain"), 1e-9);
    }
    EXPECT_GT(strain.variable(0, "plastic_strain"), 0.02);
  }
}

// Seen from a turned frame everything is turned, to round-off.
TEST(J2Plasticity, KnowsNoDirection) {
  const J2Plasticity law = steel();
  Random random;
  for (const StressState state : all_states) {
    Matrix3d Q = Eigen::AngleAxisd(0.7, Vector3d::UnitZ()).toRotationMatrix();
    if (state == StressState::three_dimensional) Q = Q * Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized());
    Points straight(made(law), state), turned(made(law), state);
    for (int step = 0; step < 30; ++step) {
      const Matrix3d L = random.gradient(state, 0.02);
      straight.update([&](int) { return L; }, 1);
      turned.update([&](int) { return Matrix3d(Q * L * Q.transpose()); }, 1);
      EXPECT_LT((turned.answer(0).stress - Q * straight.answer(0).stress * Q.transpose()).norm(), 1e-10 * law.E);
      EXPECT_NEAR(turned.variable(0, "plastic_strain"), straight.variable(0, "plastic_strain"), 1e-11);
    }
  }
}

// A body that has flowed and bears stress turns with it.
TEST(J2Plasticity, StressTurnsWithTheBody) {
  const J2Plasticity law = steel();
  for (const StressState state : all_states) {
    Points points(made(law), state);
    points.update([&](int) { return Matrix3d(0.01 * Vector3d(1, -0.2, 0).asDiagonal()); }, 1);
    points.update([&](int) { return Matrix3d(-0.0005 * Vector3d(1, -0.2, 0).asDiagonal()); }, 1);  // off the yield surface
    const Matrix3d start = points.answer(0).stress;
    const double alpha = points.variable(0, "plastic_strain");
    const int steps = 2000;
    const double turn = 2.5, per_step = turn / steps;
    Matrix3d spin = Matrix3d::Zero();
    spin(0, 1) = -1, spin(1, 0) = 1;
    for (int step = 0; step < steps; ++step) points.update([&](int) { return spin; }, per_step);
    const Matrix3d R = Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
    // I + A + A^2/2 turns by w - w^3/6 and stretches by w^4/8 a step.
    const double lag = steps * std::pow(per_step, 3) / 6, stretch = steps * std::pow(per_step, 4) / 8;
    EXPECT_LT((points.answer(0).stress - R * start * R.transpose()).norm(), 2 * lag * start.norm() + 4 * law.E * stretch + 1e-10 * law.E);
    EXPECT_EQ(points.variable(0, "plastic_strain"), alpha);
  }
}

/// Fastest elastic wave by finite differences: the acoustic tensor of Hencky's law at F, as in material_test.cpp.
double fastest_elastic_wave(const J2Plasticity& law, StressState state, const Matrix3d& F) {
  const double mu = law.E / (2 * (1 + law.nu)), lambda = law.E * law.nu / ((1 + law.nu) * (1 - 2 * law.nu));
  const bool three = state == StressState::three_dimensional;
  const auto first_piola = [&](Matrix3d at) {
    Matrix3d tau;
    for (int k = 0; k < 12; ++k) {
      const Matrix3d e = of_symmetric(at * at.transpose(), [](double x) { return 0.5 * std::log(x); });
      tau = lambda * e.trace() * Matrix3d::Identity() + 2 * mu * e;
      if (state == StressState::plane_stress) at(2, 2) *= std::exp(-tau(2, 2) / (lambda + 2 * mu));
    }
    return Matrix3d(tau * at.inverse().transpose());
  };
  double fastest = 0;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < (three ? 12 : 1); ++j) {
      const double a = M_PI * i / 24, b = three ? M_PI * j / 12 : M_PI / 2;
      const Vector3d n(std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b));
      Matrix3d Q = Matrix3d::Zero();
      for (int k = 0; k < (three ? 3 : 2); ++k) {
        const Matrix3d dF = Vector3d::Unit(k) * n.transpose() * F * 1e-5;
        Q.col(k) = (first_piola(F + dF) - first_piola(F - dF)) * F.transpose() * n / 2e-5;
      }
      if (!three) Q.row(2).setZero();
      fastest = std::fmax(fastest, Eigen::SelfAdjointEigenSolver<Matrix3d>(0.5 * (Q + Q.transpose())).eigenvalues()[2]);
    }
  }
  return std::sqrt(fastest / law.density);
}

// Elastic shear strains of up to 2 %, beside changes of volume of up to a third: what a body may bear between yield and a hard impact.
TEST(J2Plasticity, BoundsItsWaveSpeed) {
  Random random;
  for (const StressState state : all_states) {
    J2Plasticity law = steel();
    law.yield_stress = 1e3;  // it stays elastic: then its waves are fastest
    EXPECT_NEAR(law.wave_speed(state), fastest_elastic_wave(law, state, Matrix3d::Identity()), 1e-6 * law.wave_speed(state));
    for (int trial = 0; trial < 20; ++trial) {
      Points points(made(law), state);
      const double volume = state == StressState::plane_stress ? 0 : random.draw(-0.1, 0.05);
      const Matrix3d shear = random.gradient(state, 0.02);
      const Matrix3d L = log_stretching(volume, volume, state == StressState::three_dimensional ? volume : 0) + shear;
      points.update([&](int) { return L; }, 1);
      const Matrix3d F = Matrix3d::Identity() + L + 0.5 * L * L;
      const double exact = fastest_elastic_wave(law, state, F), bound = points.wave_speed(0);
      // Of the step that the bound costs: twice the size of tau over lambda + 2 mu.
      EXPECT_GT(bound, exact * (1 - 1e-6)) << F;
      EXPECT_LT(bound, 1.25 * exact) << F;
    }
  }
}

}  // namespace
}  // namespace crampon::test
