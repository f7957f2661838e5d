#pragma once
/// The door to criteria of growth: whether a tip grows, where to, and how fast (docs/theory/fracture.md, growth). A criterion itself is a plain
/// struct in its own file (crack/criteria/critical_j.hpp); crack/criteria/registry.cpp lists it.

#include <memory>
#include <string>
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/crack/criteria/law_contract.hpp"

namespace crampon {

class GrowthCriterion {
 public:
  virtual ~GrowthCriterion() = default;
  virtual std::string name() const = 0;
  /// Energy that drives the tip over what growth takes: it grows from 1 on.
  virtual double drive(const TipState& tip) const = 0;
  /// Where it grows, rad, from the direction of the crack to the left.
  virtual double angle(const TipState& tip) const = 0;
  virtual double speed(const TipState& tip) const = 0;  ///< m/s
  virtual bool needs_intensities() const = 0;
  virtual bool looks_ahead() const = 0;
};

/// Makes a criterion of a plain struct; GrowthCriterionContract says what the struct provides.
template <class Criterion>
class GrowthCriterionOf final : public GrowthCriterion {
  static_assert(GrowthCriterionContract<Criterion>::complete);

 public:
  explicit GrowthCriterionOf(const Criterion& is) : is_(is) {}
  std::string name() const override { return Criterion::name; }
  double drive(const TipState& tip) const override { return is_.drive(tip); }
  double angle(const TipState& tip) const override { return is_.angle(tip); }
  double speed(const TipState& tip) const override { return is_.speed(tip); }
  bool needs_intensities() const override { return Criterion::needs_intensities; }
  bool looks_ahead() const override { return Criterion::looks_ahead; }
  const Criterion& parameters() const { return is_; }

 private:
  Criterion is_;
};

/// A criterion with its parameters. Empty: none.
class GrowthCriterionSpec {
 public:
  GrowthCriterionSpec() = default;
  template <class Criterion>
  requires criterion_contract::says_whether_it_looks_ahead<Criterion> GrowthCriterionSpec(const Criterion& is)
      : criterion_(std::make_shared<GrowthCriterionOf<Criterion>>(is)) {}
  explicit operator bool() const { return criterion_ != nullptr; }
  const GrowthCriterion& operator*() const { return *criterion_; }
  const GrowthCriterion* operator->() const { return criterion_.get(); }
  /// The struct, if it is this criterion; else null.
  template <class Criterion>
  requires criterion_contract::says_whether_it_looks_ahead<Criterion>
  const Criterion* as() const {
    const auto* of = dynamic_cast<const GrowthCriterionOf<Criterion>*>(criterion_.get());
    return of ? &of->parameters() : nullptr;
  }

 private:
  std::shared_ptr<const GrowthCriterion> criterion_;
};

/// The family as the input sees it: `criterion = { law = "critical_j", toughness = "100 J/m2" }`.
Family<GrowthCriterionSpec>& growth_criteria();

/// Every criterion with the parameters of each of its examples: for what goes through all of them.
std::vector<GrowthCriterionSpec> growth_criterion_examples();

/// The one line by which a criterion joins the family.
template <class Criterion>
void add_growth_criterion(Family<GrowthCriterionSpec>& family) {
  static_assert(GrowthCriterionContract<Criterion>::complete);
  for (const Criterion& example : Criterion::examples()) examples_of_family<GrowthCriterionSpec>().push_back(example);
  family.add<Criterion>(Criterion::declaration(), [](Criterion criterion) -> GrowthCriterionSpec { return criterion; });
}

}  // namespace crampon
