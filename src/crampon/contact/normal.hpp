#pragma once
/// Unit normals between two materials a and b that meet at a grid node: docs/theory/contact.md, normals. n points from a to b.

#include <cstdint>
#include <optional>
#include <span>

#include "crampon/core/vector.hpp"

namespace crampon {

/// The value is the label c_p of the regressions.
enum class ContactSide : std::int8_t { a = -1, b = 1 };

/// A particle that the node sees (S_ip != 0).
template <int Dim>
struct LabelledPoint {
  Vec<Dim> x;         ///< position relative to the node over the cell, per axis
  double weight = 1;  ///< in the regressions; only its ratio to that of the other points counts
  ContactSide side = ContactSide::a;
};

/// Normal of the plane that separates the two sets of points best in the sense of least squares on the labels, with the ridge
/// `lambda |beta_x|^2`. `cell` in m. Empty when a side has no point or when the points tell no direction. Off where the plane does not
/// halve the points (5 degrees on straight faces): mainly the start value of logistic_regression_normal.
template <int Dim>
std::optional<Vec<Dim>> linear_regression_normal(std::span<const LabelledPoint<Dim>> points, const Vec<Dim>& cell);

/// Normal by logistic regression: minimises sum w_p (c_p - tanh(beta.X_p/2))^2 + lambda |beta_x|^2 (Nairn, Hammerquist & Smith, CMAME
/// 362 (2020)). Empty with fewer than Dim + 1 points on a side or when the iteration fails: there a gradient is better than the linear
/// regression (docs/theory/contact.md, normals).
template <int Dim>
std::optional<Vec<Dim>> logistic_regression_normal(std::span<const LabelledPoint<Dim>> points, const Vec<Dim>& cell);

/// Which gradient of volume makes the normal.
enum class GradientNormal {
  largest_gradient,  ///< "MVG"; of equal ones that of a
  more_volume,       ///< "MV"; of equal ones that of a
  average,           ///< "AVG", that of g_a - g_b
};

/// What one material sends to a node.
template <int Dim>
struct VolumeGradient {
  Vec<Dim> g;    ///< sum V_p G_ip, out of the material; m^2, in 2D m
  double V = 0;  ///< sum V_p S_ip; m^3, in 2D m^2
  bool rigid = false;
};

/// Normal from gradients of volume. A rigid material's own gradient is taken, whatever the choice, unless it is more than `rigid_bias`
/// times smaller than the other's: beside the edge of a block on a rigid floor the block's gradient may be the larger one, and slants.
/// Zero when no gradient tells a direction: no contact is reckoned at such a node.
template <int Dim>
Vec<Dim> gradient_normal(GradientNormal choice, const VolumeGradient<Dim>& a, const VolumeGradient<Dim>& b, double rigid_bias = 10);

}  // namespace crampon
