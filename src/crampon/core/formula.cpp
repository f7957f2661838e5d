#include "crampon/core/formula.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <muParser.h>

namespace crampon {

// muParser keeps pointers to the variables it reads.
struct Formula::Parser {
  std::vector<double> values;
  mu::Parser muparser;
};

namespace {

constexpr const char* name_characters = "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

// Longer expressions than a page are a table in disguise; the limit also bounds muParser's work on hostile input.
constexpr std::size_t longest_expression = 2000;

void refuse_other_than_one_value(const std::string& text) {
  if (text.find_first_not_of(" \t\n\r") == std::string::npos) throw std::invalid_argument("the expression is empty");
  if (text.size() > longest_expression)
    throw std::invalid_argument(fmt::format("the expression has more than {} characters", longest_expression));
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e || c == '"' || c == '\\' || c == '\'')
      throw std::invalid_argument(fmt::format("unexpected character at position {}", k));
    // muParser would assign to t.
    const bool comparison = (k > 0 && std::string("=!<>").find(text[k - 1]) != std::string::npos) || text.substr(k + 1, 1) == "=";
    if (c == '=' && !comparison) throw std::invalid_argument(fmt::format("unexpected \"=\" at position {}: compare with ==", k));
  }
}

}  // namespace

bool is_formula_name(const std::string& name) {
  return !name.empty() && name.find_first_not_of(name_characters) == std::string::npos &&
         std::string("0123456789.").find(name[0]) == std::string::npos;
}

Formula::Formula(const std::string& expression, const std::vector<std::string>& variables) : parser_(std::make_unique<Parser>()) {
  refuse_other_than_one_value(expression);
  parser_->values.resize(variables.size());
  mu::Parser& muparser = parser_->muparser;
  try {
    muparser.DefineNameChars(name_characters);
    muparser.DefineConst("pi", M_PI);
    muparser.DefineFun("if", [](double condition, double yes, double no) { return condition != 0 ? yes : no; });
    for (std::size_t k = 0; k < variables.size(); ++k) muparser.DefineVar(variables[k], &parser_->values[k]);
    muparser.SetExpr(expression);
    int results = 0;
    muparser.Eval(results);
    if (results != 1) throw std::invalid_argument("the expression has several values");
  } catch (const mu::ParserError& error) {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && is_formula_name(error.GetToken()))
      throw UnknownVariable(error.GetMsg(), error.GetToken());
    throw std::invalid_argument(error.GetMsg());
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::operator()(std::span<const double> values) {
  std::copy(values.begin(), values.end(), parser_->values.begin());
  return parser_->muparser.Eval();
}

bool Formula::uses(const std::string& variable) const { return parser_->muparser.GetUsedVar().count(variable) > 0; }

}  // namespace crampon
