#include "crampon/core/function.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

#include "crampon/core/formula.hpp"

namespace crampon {

namespace {
const std::vector<std::string> variables{"t", "x", "y", "z"};
}

struct ValueFunction::Expression {
  std::string text;
  double scale = 1;
  bool in_time = false, in_space = false;
  std::uint64_t id = 0;

  double evaluate(double t, const Vec<3>& x) const;
};

double ValueFunction::Expression::evaluate(double t, const Vec<3>& x) const {
  // Compiled once per thread; dropped together when there are far more than any one problem has.
  thread_local std::unordered_map<std::uint64_t, Formula> compiled;
  auto found = compiled.find(id);
  if (found == compiled.end()) {
    if (compiled.size() >= 512) compiled.clear();
    found = compiled.emplace(id, Formula(text, variables)).first;
  }
  return scale * found->second(std::array<double, 4>{t, x[0], x[1], x[2]});
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
  const Formula formula(text, variables);
  static std::atomic<std::uint64_t> next_id{1};
  auto e = std::make_shared<Expression>();
  e->text = text;
  e->scale = scale;
  e->id = next_id++;
  e->in_time = formula.uses("t");
  e->in_space = formula.uses("x") || formula.uses("y") || formula.uses("z");
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
