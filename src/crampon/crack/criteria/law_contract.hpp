#pragma once
/// What a struct must have to be a criterion of growth. A member that is missing or has another form is named by the first error of the compiler.

#include <concepts>

#include "crampon/core/declared.hpp"
#include "crampon/crack/criteria/tip_state.hpp"

namespace crampon {

namespace criterion_contract {

template <class Criterion>
concept has_drive = requires(const Criterion criterion, const TipState tip) {
  { criterion.drive(tip) } -> std::same_as<double>;
};
template <class Criterion>
concept has_angle = requires(const Criterion criterion, const TipState tip) {
  { criterion.angle(tip) } -> std::same_as<double>;
};
template <class Criterion>
concept has_speed = requires(const Criterion criterion, const TipState tip) {
  { criterion.speed(tip) } -> std::same_as<double>;
};
template <class Criterion>
concept says_whether_it_needs_intensities = requires {
  requires std::same_as<decltype(Criterion::needs_intensities), const bool>;
};
template <class Criterion>
concept says_whether_it_looks_ahead = requires {
  requires std::same_as<decltype(Criterion::looks_ahead), const bool>;
};

}  // namespace criterion_contract

/// Compiles for a struct that is a criterion.
template <class Criterion>
struct GrowthCriterionContract {
  static_assert(declared::has_name<Criterion>, "a criterion needs: static constexpr const char* name = \"...\";");
  static_assert(declared::has_declaration<Criterion>,
                "a criterion needs: static const Declaration<Criterion>& declaration(); it says which parameters the input may give");
  static_assert(declared::has_examples<Criterion>,
                "a criterion needs: static std::vector<Criterion> examples(); parameters of real materials, with which tests check it");
  static_assert(
      criterion_contract::has_drive<Criterion>,
      "a criterion needs: double drive(const TipState&) const; energy that drives the tip over what growth takes: it grows from 1 on");
  static_assert(criterion_contract::has_angle<Criterion>,
                "a criterion needs: double angle(const TipState&) const; where it grows, rad, from the direction of the crack to the left");
  static_assert(criterion_contract::has_speed<Criterion>,
                "a criterion needs: double speed(const TipState&) const; m/s, no_limit_of_speed for one that does not say");
  static_assert(criterion_contract::says_whether_it_needs_intensities<Criterion>,
                "a criterion needs: static constexpr bool needs_intensities; true if it cannot do with J alone");
  static_assert(criterion_contract::says_whether_it_looks_ahead<Criterion>,
                "a criterion needs: static constexpr bool looks_ahead; true if it asks for the stress ahead of the tip");
  static constexpr bool complete = true;
};

}  // namespace crampon
