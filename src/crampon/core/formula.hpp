#pragma once
/// Arithmetic expressions of named variables.

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace crampon {

/// Whether a formula can have a variable of this name: letters, digits, underscores and dots, beginning with a letter or an underscore.
bool is_formula_name(const std::string& name);

/// A formula has a name that stands for nothing.
class UnknownVariable : public std::invalid_argument {
 public:
  UnknownVariable(const std::string& message, std::string unknown) : std::invalid_argument(message), name(std::move(unknown)) {}
  std::string name;
};

/// A muParser expression, compiled: arithmetic, comparisons, `if(condition, yes, no)`, pi and the usual functions.
/// Evaluation changes it, so that one formula belongs to one thread.
class Formula {
 public:
  /// variables: names that may occur, all of which are formula names.
  /// Throws std::invalid_argument with the parser's message and position, UnknownVariable where a name is unknown.
  Formula(const std::string& expression, const std::vector<std::string>& variables);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  /// values: one for each variable, in their order.
  double operator()(std::span<const double> values);
  /// Whether the expression names this variable.
  bool uses(const std::string& variable) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace crampon
