#include "crampon/core/function.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>
#include <muParser.h>

namespace crampon {

struct ValueFunction::Expression {
  std::string text;
  double scale = 1;
  bool in_time = false, in_space = false;
  std::uint64_t id = 0;

  double evaluate(double t, const Vec<3>& x) const;
};

namespace {

// muParser keeps pointers to the variables it reads, so one compiled parser belongs to one thread.
struct Compiled {
  double t = 0, x = 0, y = 0, z = 0;
  mu::Parser parser;

  explicit Compiled(const std::string& text) {
    parser.DefineConst("pi", M_PI);
    parser.DefineVar("t", &t);
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    parser.DefineVar("z", &z);
    parser.DefineFun("if", [](double condition, double yes, double no) { return condition != 0 ? yes : no; });
    parser.SetExpr(text);
  }
};

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

double ValueFunction::Expression::evaluate(double t, const Vec<3>& x) const {
  // Compiled once per thread; dropped together when there are far more than any one problem has.
  thread_local std::unordered_map<std::uint64_t, std::unique_ptr<Compiled>> compiled;
  auto found = compiled.find(id);
  if (found == compiled.end()) {
    if (compiled.size() >= 512) compiled.clear();
    found = compiled.emplace(id, std::make_unique<Compiled>(text)).first;
  }
  Compiled& c = *found->second;
  c.t = t;
  c.x = x[0];
  c.y = x[1];
  c.z = x[2];
  return scale * c.parser.Eval();
}

ValueFunction ValueFunction::constant(double value) {
  ValueFunction f;
  f.values_ = {value};
  return f;
}

ValueFunction ValueFunction::table(std::vector<double> times, std::vector<double> values) {
  if (times.empty()) throw std::invalid_argument("the table is empty");
  if (times.size() != values.size())
    throw std::invalid_argument(fmt::format("the table has {} times and {} values", times.size(), values.size()));
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw std::invalid_argument(fmt::format("the times do not increase: {} s is followed by {} s", times[k - 1], times[k]));
  ValueFunction f;
  f.times_ = std::move(times);
  f.values_ = std::move(values);
  return f;
}

ValueFunction ValueFunction::expression(const std::string& text, double scale) {
  refuse_other_than_one_value(text);
  static std::atomic<std::uint64_t> next_id{1};
  auto e = std::make_shared<Expression>();
  e->text = text;
  e->scale = scale;
  e->id = next_id++;
  try {
    Compiled compiled(text);
    int results = 0;
    compiled.parser.Eval(results);
    if (results != 1) throw std::invalid_argument("the expression has several values");
    for (const auto& [name, address] : compiled.parser.GetUsedVar()) (name == "t" ? e->in_time : e->in_space) = true;
  } catch (const mu::ParserError& error) {
    throw std::invalid_argument(error.GetMsg());
  }
  ValueFunction f;
  f.expression_ = std::move(e);
  return f;
}

double ValueFunction::operator()(double t, const Vec<3>& x) const {
  if (expression_) return expression_->evaluate(t, x);
  if (times_.empty() || t <= times_.front()) return values_.front();
  if (t >= times_.back()) return values_.back();
  const std::size_t k = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
  const double w = (t - times_[k - 1]) / (times_[k] - times_[k - 1]);
  return (1 - w) * values_[k - 1] + w * values_[k];
}

bool ValueFunction::depends_on_position() const { return expression_ && expression_->in_space; }
bool ValueFunction::depends_on_time() const { return expression_ ? expression_->in_time : times_.size() > 1; }

std::string ValueFunction::text() const {
  if (expression_) {
    const double s = expression_->scale;
    return s == 1 ? fmt::format("{{ expression = \"{}\" }}", expression_->text)
                  : fmt::format("{{ expression = \"{}\", scale = {} }}", expression_->text, s);
  }
  if (times_.empty()) return fmt::format("{}", values_.front());
  return fmt::format("{{ times = [{}], values = [{}] }}", fmt::join(times_, ", "), fmt::join(values_, ", "));
}

}  // namespace crampon
