#pragma once
/// The door to traction laws: tractions between the faces of a crack that is not yet torn apart, or that a fluid fills: cohesive zones, bridging
/// fibres, pressure (docs/theory/traction.md). A law itself is a plain struct in its own file (crack/traction/linear_elastic.hpp). TractionLawOf
/// puts it behind TractionLaw; crack/traction/registry.cpp lists it (docs/decisions/0024-contact-law-family.md).

#include <memory>
#include <string>
#include <vector>

#include "crampon/core/declaration.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/law_contract.hpp"
#include "crampon/crack/traction/response.hpp"

namespace crampon {

/// A traction law with its parameters.
class TractionLaw {
 public:
  virtual ~TractionLaw() = default;
  virtual std::string name() const = 0;
  /// False: the faces are free.
  virtual bool acts() const = 0;
  /// Does it act on faces that press on each other?
  virtual bool acts_closed() const = 0;
  /// Does its work come from outside, rather than from what the law stores?
  virtual bool from_outside() const = 0;
  /// Tractions at the end of a step in which the faces came to this opening; see update_traction().
  virtual Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const = 0;
  /// Largest ratio of traction to opening, Pa/m: limits the time step.
  virtual double largest_stiffness() const = 0;
  /// G_Ic and G_IIc, J/m2; infinite for laws that never fail, zero without a law.
  virtual PerMode toughness() const = 0;
};

/// Makes a law of a plain struct; TractionLawContract says what the struct provides.
template <class Law>
class TractionLawOf final : public TractionLaw {
  static_assert(TractionLawContract<Law>::complete);

 public:
  explicit TractionLawOf(const Law& law) : law_(law) {}
  std::string name() const override { return Law::name; }
  bool acts() const override { return Law::acts; }
  bool acts_closed() const override { return Law::acts_closed; }
  bool from_outside() const override { return Law::from_outside; }
  Traction respond(const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history) const override {
    return law_.respond(opening, time, x, history);
  }
  double largest_stiffness() const override { return law_.largest_stiffness(); }
  PerMode toughness() const override { return law_.toughness(); }
  const Law& parameters() const { return law_; }

 private:
  Law law_;
};

/// A law with its parameters, shared by all that it holds for. Without a law of its own it leaves the faces free; it is never empty.
class TractionLawSpec {
 public:
  TractionLawSpec();
  template <class Law>
  requires traction_contract::says_whether_it_acts_closed<Law> TractionLawSpec(const Law& law)
      : law_(std::make_shared<TractionLawOf<Law>>(law)) {}

  const TractionLaw& operator*() const { return *law_; }
  const TractionLaw* operator->() const { return law_.get(); }
  /// The struct, if it is this law; else null. For what shows parameters, such as the resolved input.
  template <class Law>
  requires traction_contract::says_whether_it_acts_closed<Law>
  const Law* as() const {
    const auto* of = dynamic_cast<const TractionLawOf<Law>*>(law_.get());
    return of ? &of->parameters() : nullptr;
  }

 private:
  std::shared_ptr<const TractionLaw> law_;
};

/// The family as the input sees it: `traction = { law = "cubic", normal = { ... }, shear = { ... } }`.
Family<TractionLawSpec>& traction_laws();

/// Every law of the family with the parameters of each of its examples: for what goes through all laws.
std::vector<TractionLawSpec> traction_law_examples();

/// The one line by which a law joins the family.
template <class Law>
void add_traction_law(Family<TractionLawSpec>& family) {
  static_assert(TractionLawContract<Law>::complete);
  for (const Law& example : Law::examples()) examples_of_family<TractionLawSpec>().push_back(example);
  family.add<typename Law::Input>(Law::declaration(), [](typename Law::Input input) -> TractionLawSpec { return Law::make(input); });
}

/// Takes one vertex to the end of a step; to be called once for each step. opening: of the faces at its end, m. time (s) and x, the
/// place of the vertex (m), matter to pressure alone. Tractions are those at the end of the step; when the law fails they are zero,
/// history.failed is 1, and what was stored counts as dissipated. Faces that press on each other bear no normal traction here: that
/// is for contact. Conserves energy (work = stored + dissipated) to the second order of the step; pressure does work from outside.
Traction update_traction(const TractionLaw& law, const PerMode& opening, double time, const Vec<3>& x, TractionHistory& history);

}  // namespace crampon
