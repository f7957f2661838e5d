#pragma once
#include <vector>

#include "crampon/crack/tip_domain.hpp"

namespace crampon {

/// A virtual extension of a crack (Parks, Int. J. Fract. 10 (1974); deLorenzi, Int. J. Fract. 19 (1982)): the field q by which the material about a tip is shifted
/// as if the crack grew by 1 along its first axis. It has the size of the weight of the domain and everywhere the direction of the path at the same
/// distance from the tip, so that it runs along the faces where the path bends. At sharp corners of the path it is 0: their stress has no bound either, and
/// they do not move on with the tip. Corners nearer than 2.5 cells are one with the tip.
class VirtualExtension {
 public:
  /// Of a straight path.
  VirtualExtension(const TipWeight& weight)
      : weight_(weight) {}  // NOLINT(google-explicit-constructor): a weight says all of a straight path
  /// cell: m.
  VirtualExtension(const TipWeight& weight, const TipPath& path, double cell);

  struct Shift {
    Vec<2> q;            ///< 1
    Tensor2 gradient{};  ///< q_k,J, 1/m
  };
  Shift at(const Vec<2>& place) const;
  /// Size of q on the path at a distance from the tip.
  double on_path(double r) const;
  const TipWeight& weight() const { return weight_; }
  /// Does the path turn sharply within the domain?
  bool meets_corners() const;

 private:
  /// 1 but for corners, with its slope, 1/m.
  struct Part {
    double value = 1;
    Vec<2> slope;
  };
  Part beside_corners(const Vec<2>& place) const;
  struct Direction {
    Vec<2> value{{1, 0}}, slope;  ///< 1, 1/m
  };
  Direction direction(double r) const;

  TipWeight weight_;
  std::vector<Vec<2>> path_;     ///< places on the path at multiples of spacing_, m
  std::vector<Vec<2>> along_;    ///< directions of the path at multiples of spacing_; empty: it is straight
  double spacing_ = 0;           ///< m
  std::vector<Vec<2>> corners_;  ///< m
  double around_corner_ = 0;     ///< radius in which q falls to 0, m
};

}  // namespace crampon
