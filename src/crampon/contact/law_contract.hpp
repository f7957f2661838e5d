#pragma once
/// What a struct must have to be a contact law. A member that is missing or has another form is named by the first error of the compiler.

#include <concepts>

#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declared.hpp"

namespace crampon {

namespace contact_contract {

// One concept a member, so that an error can name it. Nothing has a default: with one, a law that forgets to ask for the area or to say that it
// remembers slip would build without a word and be frictionless.
template <class Law>
concept says_how_faces_meet = requires {
  requires std::same_as<decltype(Law::meeting), const Meeting>;
};
template <class Law>
concept says_whether_it_adheres = requires {
  requires std::same_as<decltype(Law::adheres), const bool>;
};
template <class Law>
concept says_whether_it_needs_area = requires(const Law law) {
  { law.needs_area() } -> std::same_as<bool>;
};
template <class Law>
concept says_what_it_remembers = requires(const Law law) {
  { law.remembers() } -> std::same_as<Remembered>;
};
template <class Law>
concept has_limit = requires(const Law law, const Sliding sliding) {
  { law.limit(sliding) } -> std::same_as<SlidingLimit>;
};
template <class Law>
concept has_strictness = requires(const Law law) {
  { law.strictness() } -> std::same_as<Strictness>;
};
template <class Law>
concept has_holds = requires(const Law law, const Pull pull) {
  { law.holds(pull) } -> std::same_as<bool>;
};
template <class Law>
concept has_springs = requires(const Law law) {
  { law.springs() } -> std::same_as<ContactSprings>;
};

/// Does the law say when faces that have met hold, if it says that they adhere?
template <class Law>
constexpr bool holds_if_it_adheres() {
  if constexpr (says_whether_it_adheres<Law>) {
    if constexpr (Law::adheres) return has_holds<Law>;
  }
  return true;
}
template <class Law>
constexpr bool has_springs_if_it_meets_by_them() {
  if constexpr (says_how_faces_meet<Law>) {
    if constexpr (Law::meeting == Meeting::springs) return has_springs<Law>;
  }
  return true;
}
/// Only faces that press on each other adhere: springs and joined faces hold without it.
template <class Law>
constexpr bool adheres_only_where_it_presses() {
  if constexpr (says_whether_it_adheres<Law> && says_how_faces_meet<Law>) return !Law::adheres || Law::meeting == Meeting::pressing;
  return true;
}

}  // namespace contact_contract

/// Compiles for a struct that is a contact law.
template <class Law>
struct ContactLawContract {
  static_assert(declared::has_name<Law>, "a contact law needs: static constexpr const char* name = \"...\";");
  static_assert(declared::has_declaration<Law>,
                "a contact law needs: static const Declaration<Law>& declaration(); it says which parameters the input may give");
  static_assert(
      declared::has_examples<Law>,
      "a contact law needs: static std::vector<Law> examples(); parameters of real contacts, with which tests check the law, one for each "
      "way in which it acts");
  static_assert(contact_contract::says_how_faces_meet<Law>,
                "a contact law needs: static constexpr Meeting meeting = ...; Meeting::pressing for a law of friction");
  static_assert(contact_contract::says_whether_it_adheres<Law>,
                "a contact law needs: static constexpr bool adheres = ...; true if faces that have met bear tension");
  static_assert(contact_contract::says_whether_it_needs_area<Law>,
                "a contact law needs: bool needs_area() const; true if limit() or holds() reads the area");
  static_assert(contact_contract::says_what_it_remembers<Law>,
                "a contact law needs: Remembered remembers() const; Remembered::slip if limit() reads the distance slipped");
  static_assert(contact_contract::has_limit<Law>,
                "a contact law needs: SlidingLimit limit(const Sliding&) const; the tangential impulse with which it resists");
  static_assert(contact_contract::has_strictness<Law>,
                "a contact law needs: Strictness strictness() const; which law rules where several lie between two faces");
  static_assert(contact_contract::holds_if_it_adheres<Law>(),
                "a contact law that adheres needs: bool holds(const Pull&) const; do faces that have met stay together?");
  static_assert(contact_contract::has_springs_if_it_meets_by_them<Law>(),
                "a contact law whose meeting is Meeting::springs needs: ContactSprings springs() const");
  static_assert(contact_contract::adheres_only_where_it_presses<Law>(), "only a contact law whose meeting is Meeting::pressing may adhere");
  static constexpr bool complete = true;
};

}  // namespace crampon
