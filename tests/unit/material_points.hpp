#pragma once
/// Material points for tests of constitutive laws: packs as the time step hands them to a law, with plain matrices outside.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <random>
#include <string_view>
#include <vector>

#include "crampon/material/material.hpp"

namespace crampon::test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// What is stored on a particle and reported of it.
struct Answer {
  Matrix3d stress = Matrix3d::Zero();  ///< as stored: Kirchhoff (small strain: of Eq. 35)
  Matrix3d cauchy = Matrix3d::Zero();
  double energy = 0, volume_ratio = 1;
};

/// Particles of the engine: `packs` packs of four, with room between their histories as in a run of mixed materials.
class Points {
 public:
  Points(MaterialSpec law, StressState state, int packs = 1) : law_(std::move(law)), state_(state), packs_(packs) {
    dimension_ = state == StressState::three_dimensional ? 3 : 2;
    stress_size_ = dimension_ == 2 ? stress_size<2> : stress_size<3>;
    stride_ = law_->history_size(dimension_) + 1;
    stress_.resize(static_cast<std::size_t>(packs_ * stress_size_));
    history_.resize(static_cast<std::size_t>(packs_ * stride_), splat(guard));
    for (int q = 0; q < packs_; ++q) law_->initialise(dimension_, stress(q), history(q));
  }

  int size() const { return packs_ * lanes; }
  Pack* stress(int pack) { return &stress_[static_cast<std::size_t>(pack * stress_size_)]; }
  Pack* history(int pack) { return &history_[static_cast<std::size_t>(pack * stride_)]; }

  bool update(const std::function<Matrix3d(int)>& L, double dt) {
    std::vector<Pack> packed(static_cast<std::size_t>(packs_ * dimension_ * dimension_));
    for (int p = 0; p < size(); ++p) {
      const Matrix3d of_point = L(p);
      for (int d = 0; d < dimension_; ++d) {
        for (int k = 0; k < dimension_; ++k) {
          packed[static_cast<std::size_t>((p / lanes * dimension_ + d) * dimension_ + k)][p % lanes] = of_point(d, k);
        }
      }
    }
    bool good = false;
    if (dimension_ == 2) {
      good = law_->update(state_, StressBatch<2>{packs_, dt, packed.data(), stress_.data(), history_.data(), stride_});
    } else {
      good = law_->update(state_, StressBatch<3>{packs_, dt, packed.data(), stress_.data(), history_.data(), stride_});
    }
    for (int q = 0; q < packs_; ++q) EXPECT_EQ(history(q)[stride_ - 1][0], guard) << "wrote beyond its history";
    return good;
  }

  Answer answer(int p) {
    const int l = p % lanes, q = p / lanes;
    const PackReport report = law_->report(state_, dimension_, stress(q), history(q));
    Answer a;
    const Pack* s = stress(q);
    a.stress(0, 0) = s[0][l];
    a.stress(1, 1) = s[1][l];
    if (dimension_ == 2) {
      a.stress(0, 1) = a.stress(1, 0) = s[2][l];
      a.stress(2, 2) = s[3][l];
    } else {
      a.stress(2, 2) = s[2][l];
      a.stress(0, 1) = a.stress(1, 0) = s[3][l];
      a.stress(1, 2) = a.stress(2, 1) = s[4][l];
      a.stress(0, 2) = a.stress(2, 0) = s[5][l];
    }
    a.cauchy = a.stress * report.to_cauchy[l];
    a.energy = report.energy[l];
    a.volume_ratio = report.volume_ratio[l];
    return a;
  }
  double variable(int p, std::string_view name, int component = 0) {
    const LawVariable* v = law_->find_variable(dimension_, name);
    return v ? history(p / lanes)[v->at + component][p % lanes] : std::nan("");
  }
  /// Energy taken per initial volume.
  double dissipated(int p) {
    const LawVariable* v = law_->dissipated(dimension_);
    return v ? history(p / lanes)[v->at][p % lanes] : 0;
  }
  double wave_speed(int p) { return law_->wave_speed(state_, dimension_, stress(p / lanes), history(p / lanes))[p % lanes]; }

 private:
  static constexpr double guard = 12345;
  MaterialSpec law_;
  StressState state_;
  int packs_, dimension_, stress_size_, stride_;
  std::vector<Pack> stress_, history_;
};

class Random {
 public:
  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Matrix3d gradient(StressState state, double size) {
    Matrix3d L = Matrix3d::Zero();
    const int n = state == StressState::three_dimensional ? 3 : 2;
    for (int d = 0; d < n; ++d) {
      for (int k = 0; k < n; ++k) L(d, k) = draw(-size, size);
    }
    return L;
  }

 private:
  std::mt19937_64 engine_{51};
};

/// Velocity gradient that multiplies F by diag(f) in one step of 1 s: 1 + x + x^2/2 = f.
inline Matrix3d stretching(double x, double y, double z) {
  const auto rate = [](double f) { return std::sqrt(2 * f - 1) - 1; };
  return Vector3d(rate(x), rate(y), rate(z)).asDiagonal();
}

}  // namespace crampon::test
