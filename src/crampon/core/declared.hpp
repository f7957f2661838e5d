#pragma once
/// What every law of a family has: a name, a declaration of its parameters for the input, and examples for the tests.

#include <concepts>
#include <string_view>
#include <vector>

#include "crampon/core/declaration.hpp"

namespace crampon::declared {

template <class Law>
concept has_name = requires {
  std::string_view(Law::name);
};
/// Input: the struct of the parameters in the input.
template <class Law, class Input = Law>
concept has_declaration = requires {
  { Law::declaration() } -> std::same_as<const Declaration<Input>&>;
};
template <class Law>
concept has_examples = requires {
  { Law::examples() } -> std::same_as<std::vector<Law>>;
};

}  // namespace crampon::declared

namespace crampon {

/// The examples of all members of the family whose values are Spec: members put theirs here as they join.
template <class Spec>
std::vector<Spec>& examples_of_family() {
  static std::vector<Spec> all;
  return all;
}

}  // namespace crampon
