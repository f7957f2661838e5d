#pragma once
/// What a struct must have to be a traction law. A member that is missing or has another form is named by the first error of the compiler.

#include <concepts>

#include "crampon/core/declared.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/response.hpp"

namespace crampon {

namespace traction_contract {

// One concept a member, so that an error can name it. Nothing has a default, as with contact laws (contact/law_contract.hpp).
template <class Law>
concept has_input = requires {
  typename Law::Input;
};
template <class Law>
concept can_be_made = requires(const typename Law::Input input) {
  { Law::make(input) } -> std::same_as<Law>;
};
template <class Law>
concept says_whether_it_acts = requires {
  requires std::same_as<decltype(Law::acts), const bool>;
};
template <class Law>
concept says_whether_it_acts_closed = requires {
  requires std::same_as<decltype(Law::acts_closed), const bool>;
};
template <class Law>
concept says_whether_it_is_from_outside = requires {
  requires std::same_as<decltype(Law::from_outside), const bool>;
};
template <class Law>
concept has_respond = requires(const Law law, const PerMode opening, const Vec<3> x, TractionHistory history) {
  { law.respond(opening, 0., x, history) } -> std::same_as<Traction>;
};
template <class Law>
concept has_largest_stiffness = requires(const Law law) {
  { law.largest_stiffness() } -> std::same_as<double>;
};
template <class Law>
concept has_toughness = requires(const Law law) {
  { law.toughness() } -> std::same_as<PerMode>;
};

}  // namespace traction_contract

/// Compiles for a struct that is a traction law.
template <class Law>
struct TractionLawContract {
  static_assert(declared::has_name<Law>, "a traction law needs: static constexpr const char* name = \"...\";");
  static_assert(
      traction_contract::has_input<Law>,
      "a traction law needs: using Input = ...; the struct of its parameters in the input, the law itself where they are the same");
  static_assert(declared::has_declaration<Law, typename Law::Input>,
                "a traction law needs: static const Declaration<Input>& declaration(); it says which parameters the input may give");
  static_assert(traction_contract::can_be_made<Law>, "a traction law needs: static Law make(const Input&)");
  static_assert(
      declared::has_examples<Law>,
      "a traction law needs: static std::vector<Law> examples(); parameters of real cracks, with which tests check the law, one for each "
      "way in which it acts");
  static_assert(traction_contract::says_whether_it_acts<Law>,
                "a traction law needs: static constexpr bool acts = ...; false only for a law that leaves the faces free");
  static_assert(traction_contract::says_whether_it_acts_closed<Law>,
                "a traction law needs: static constexpr bool acts_closed = ...; false if faces that press on each other bear no normal "
                "traction of it");
  static_assert(
      traction_contract::says_whether_it_is_from_outside<Law>,
      "a traction law needs: static constexpr bool from_outside = ...; true if its work comes from outside, as that of a pressure does");
  static_assert(traction_contract::has_respond<Law>,
                "a traction law needs: Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory&) const");
  static_assert(traction_contract::has_largest_stiffness<Law>,
                "a traction law needs: double largest_stiffness() const; the largest ratio of traction to opening, Pa/m");
  static_assert(traction_contract::has_toughness<Law>,
                "a traction law needs: PerMode toughness() const; G_Ic and G_IIc, J/m2, infinite if it never fails");
  static constexpr bool complete = true;
};

}  // namespace crampon
