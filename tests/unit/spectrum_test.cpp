// Eigenvalues and functions of symmetric tensors, four at once, against Eigen's.

#include "crampon/material/spectrum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

namespace crampon {
namespace {

using Eigen::Matrix3d;

/// Tensors near the identity, with equal and nearly equal eigenvalues, diagonal, and of eigenvalues some powers of ten apart.
std::vector<Matrix3d> tensors(bool plane) {
  std::mt19937_64 engine(3);
  const auto draw = [&](double size) { return std::uniform_real_distribution<double>(-size, size)(engine); };
  std::vector<Matrix3d> all{Matrix3d::Identity(), 3 * Matrix3d::Identity(), Eigen::Vector3d(1, 2, 3).asDiagonal(),
                            Eigen::Vector3d(2, 1, 1).asDiagonal()};
  for (int k = 0; k < 400; ++k) {
    Matrix3d A;
    for (int c = 0; c < 9; ++c) A(c / 3, c % 3) = draw(1);
    const double spread = std::pow(10, draw(8) - 8);  // 1e-16 to 1
    Matrix3d F = Matrix3d::Identity() + spread * A;
    if (k % 4 == 1) F = Eigen::Vector3d(std::pow(10, draw(1)), std::pow(10, draw(1)), 1).asDiagonal() * F;
    if (plane) F(0, 2) = F(2, 0) = F(1, 2) = F(2, 1) = 0;
    all.push_back(F * F.transpose());
  }
  while (all.size() % lanes != 0) all.push_back(Matrix3d::Identity());
  return all;
}

/// Of four tensors.
Pack component(const Matrix3d* A, int row, int column) {
  return Pack{A[0](row, column), A[1](row, column), A[2](row, column), A[3](row, column)};
}

Matrix3d log_of(const Matrix3d& a) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(a);
  return eigen.eigenvectors() * eigen.eigenvalues().array().log().matrix().asDiagonal() * eigen.eigenvectors().transpose();
}

TEST(Spectrum, LogarithmsOfTensorsInSpace) {
  const std::vector<Matrix3d> all = tensors(false);
  for (std::size_t first = 0; first < all.size(); first += lanes) {
    Pack a[6], back[6], log[6];
    const int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int c = 0; c < 6; ++c) a[c] = component(&all[first], row[c], column[c]);
    const SpaceSpectrum of(a);
    of.compose(of.value, back);
    const Pack logs[3] = {lane_log(of.value[0]), lane_log(of.value[1]), lane_log(of.value[2])};
    of.compose(logs, log);
    for (int l = 0; l < lanes; ++l) {
      const Matrix3d& A = all[first + static_cast<std::size_t>(l)];
      const Matrix3d expected = log_of(A);
      // Eigenvalues are exact to round-off of the largest; the smallest is up to 1e4 times less here.
      const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Matrix3d>(A).eigenvalues();
      const double conditioned = 4e-15 * values[2] / values[0];
      for (int c = 0; c < 6; ++c) {
        EXPECT_NEAR(back[c][l], A(row[c], column[c]), 4e-15 * values[2]);
        EXPECT_NEAR(log[c][l], expected(row[c], column[c]), conditioned) << A;
      }
    }
  }
}

TEST(Spectrum, LogarithmsOfTensorsInThePlane) {
  const std::vector<Matrix3d> all = tensors(true);
  for (std::size_t first = 0; first < all.size(); first += lanes) {
    Pack back[3], log[3];
    const PlaneSpectrum of(component(&all[first], 0, 0), component(&all[first], 1, 1), component(&all[first], 0, 1));
    of.compose(of.value[0] + of.value[1], of.value[0] - of.value[1], back);
    of.compose(lane_log(of.value[0]) + lane_log(of.value[1]), lane_log(of.value[0]) - lane_log(of.value[1]), log);
    for (int l = 0; l < lanes; ++l) {
      const Matrix3d& A = all[first + static_cast<std::size_t>(l)];
      const Matrix3d expected = log_of(A);
      const Eigen::Vector2d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(Eigen::Matrix2d(A.topLeftCorner<2, 2>())).eigenvalues();
      const double conditioned = 4e-15 * values[1] / values[0];
      EXPECT_NEAR(back[0][l], A(0, 0), 4e-15 * values[1]);
      EXPECT_NEAR(back[2][l], A(0, 1), 4e-15 * values[1]);
      EXPECT_NEAR(log[0][l], expected(0, 0), conditioned) << A;
      EXPECT_NEAR(log[1][l], expected(1, 1), conditioned) << A;
      EXPECT_NEAR(log[2][l], expected(0, 1), conditioned) << A;
    }
  }
}

}  // namespace
}  // namespace crampon
