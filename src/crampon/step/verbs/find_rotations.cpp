#include "crampon/step/verbs.hpp"

#include <Eigen/LU>
#include <array>

#include "crampon/state/rotation.hpp"

namespace crampon {

namespace {

constexpr std::array<std::size_t, 3> next_axis{1, 2, 0};

/// The rows of the inverse of a moment of inertia about the axes that are free; all zero where particles have no extent across one of them. smallest: a
/// trace below that, kg m2, is round-off of sums over one particle.
std::array<Vec<3>, 3> inverse_of(Eigen::Matrix3d inertia, const std::array<bool, 3>& about, double smallest) {
  const double size = inertia.trace();
  for (int k = 0; k < 3; ++k) {
    if (about[static_cast<std::size_t>(k)]) continue;
    inertia.row(k).setZero();
    inertia.col(k).setZero();
    inertia(k, k) = size;
  }
  std::array<Vec<3>, 3> out{};
  if (!(size > smallest)) return out;
  if (!(inertia.determinant() > 1e-12 * size * size * size)) return out;
  const Eigen::Matrix3d inverse = inertia.inverse();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      if (about[row] && about[column]) out[row][column] = inverse(i, j);
    }
  }
  return out;
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// Moment of inertia about the origin less that of the mass m at the distance c from it.
Eigen::Matrix3d inertia_about_centre(const Vec<3>& squares, const Vec<3>& products, double m, const Vec<3>& c) {
  Eigen::Matrix3d J;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = next_axis[k], j = next_axis[i];
    const auto r = static_cast<int>(k), s = static_cast<int>(i);
    J(r, r) = squares[i] + squares[j] - m * (c[i] * c[i] + c[j] * c[j]);
    J(r, s) = J(s, r) = -(products[k] - m * c[k] * c[i]);
  }
  return J;
}

}  // namespace

template <int Dim>
void find_rotations(State<Dim>& state, StepWork<Dim>& work) {
  std::vector<RotationSums> total(state.pieces.list.size());
  work.rotations.resize(total.size());
  for (const BlockScratch<Dim>& scratch : work.scratch) {
    for (const RotationSums& part : scratch.rotation) {
      RotationSums& sum = total[part.piece];
      sum.held = sum.held || part.held;
      sum.mass += part.mass;
      sum.first += part.first;
      sum.momentum += part.momentum;
      sum.angular += part.angular;
      sum.squares += part.squares;
      sum.products += part.products;
    }
  }
  for (std::size_t i = 0; i < total.size(); ++i) {
    const Piece<Dim>& piece = state.pieces.list[i];
    PieceRotation<Dim>& rotation = work.rotations[i];
    const RotationSums& sum = total[i];
    rotation.inverse_inertia = {};
    rotation.spin = {};
    if (sum.held || !(sum.mass > 0)) continue;
    const Vec<3> to_centre = sum.first * (1 / sum.mass);
    rotation.centre = piece.origin;
    for (std::size_t k = 0; k < Dim; ++k) rotation.centre[k] += to_centre[k];
    rotation.inverse_inertia = inverse_of(inertia_about_centre(sum.squares, sum.products, sum.mass, to_centre), piece.about,
                                          1e-12 * (sum.squares[0] + sum.squares[1] + sum.squares[2]));
    rotation.spin = rotation.rotation_of(sum.angular - cross(to_centre, sum.momentum));
  }
}

template void find_rotations<2>(State<2>&, StepWork<2>&);
template void find_rotations<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
