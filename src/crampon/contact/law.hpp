#pragma once
/// The door to contact laws: what two bodies, or the faces of a crack, do when they meet, without knowing which law it is. The nodal solve
/// (contact/node_solve.hpp) turns it into impulses. A law itself is a plain struct in its own file (contact/laws/coulomb.hpp). ContactLawOf puts it
/// behind ContactLaw; contact/registry.cpp lists it (docs/decisions/0024-contact-law-family.md).

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "crampon/contact/law_contract.hpp"
#include "crampon/contact/law_questions.hpp"
#include "crampon/core/declaration.hpp"

namespace crampon {

/// A contact law with its parameters. Most answers do not change during a run, and are kept as data: contact asks them for each pair at each node.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;
  virtual std::string name() const = 0;

  Meeting meeting() const { return facts_.meeting; }
  bool ignores() const { return facts_.meeting == Meeting::never; }
  bool bonds() const { return facts_.meeting == Meeting::joined; }
  bool has_springs() const { return facts_.meeting == Meeting::springs; }
  /// Do faces that have met bear tension?
  bool adheres() const { return facts_.adheres; }
  bool needs_area() const { return facts_.needs_area; }
  Remembered remembers() const { return facts_.remembers; }
  bool needs_history() const { return facts_.remembers != Remembered::nothing; }
  const Strictness& strictness() const { return facts_.strictness; }
  /// Where the law has springs.
  const ContactSprings& springs() const { return facts_.springs; }

  /// Whether the law stops all slip, and with what impulse it resists if not.
  virtual SlidingLimit limit(const Sliding& sliding) const = 0;
  /// Do faces that have met stay together? False for laws that do not adhere, and without an area.
  bool holds(const Pull& pull) const { return facts_.adheres && pull.area > 0 && bears(pull); }

 protected:
  struct Facts {
    Meeting meeting;
    bool adheres, needs_area;
    Remembered remembers;
    Strictness strictness;
    ContactSprings springs;
  };
  explicit ContactLaw(const Facts& facts) : facts_(facts) {}

 private:
  virtual bool bears(const Pull& pull) const = 0;
  Facts facts_;
};

/// Makes a law of a plain struct; ContactLawContract says what the struct provides.
template <class Law>
class ContactLawOf final : public ContactLaw {
  static_assert(ContactLawContract<Law>::complete);

 public:
  explicit ContactLawOf(const Law& law) : ContactLaw(facts_of(law)), law_(law) {}
  std::string name() const override { return Law::name; }
  SlidingLimit limit(const Sliding& sliding) const override { return law_.limit(sliding); }
  const Law& parameters() const { return law_; }

 private:
  static Facts facts_of(const Law& law) {
    ContactSprings springs;
    if constexpr (Law::meeting == Meeting::springs) springs = law.springs();
    return {Law::meeting, Law::adheres, law.needs_area(), law.remembers(), law.strictness(), springs};
  }
  bool bears([[maybe_unused]] const Pull& pull) const override {
    if constexpr (Law::adheres) {
      return law_.holds(pull);
    } else {
      return false;
    }
  }
  Law law_;
};

/// A law with its parameters, shared by all that it holds for. Without a law of its own it is the frictionless one; it is never empty.
class ContactLawSpec {
 public:
  ContactLawSpec();
  template <class Law>
  requires contact_contract::says_how_faces_meet<Law> ContactLawSpec(const Law& law) : law_(std::make_shared<ContactLawOf<Law>>(law)) {}

  const ContactLaw& operator*() const { return *law_; }
  const ContactLaw* operator->() const { return law_.get(); }
  /// The struct, if it is this law; else null. For what shows parameters, such as the resolved input.
  template <class Law>
  requires contact_contract::says_how_faces_meet<Law>
  const Law* as() const {
    const auto* of = dynamic_cast<const ContactLawOf<Law>*>(law_.get());
    return of ? &of->parameters() : nullptr;
  }

 private:
  std::shared_ptr<const ContactLaw> law_;
};

/// The family as the input sees it: `contact = { law = "coulomb", friction = 0.3 }`.
Family<ContactLawSpec>& contact_laws();

/// Every law of the family with the parameters of each of its examples: for what goes through all laws.
std::vector<ContactLawSpec> contact_law_examples();

/// The one line by which a law joins the family.
template <class Law>
void add_contact_law(Family<ContactLawSpec>& family) {
  static_assert(ContactLawContract<Law>::complete);
  for (const Law& example : Law::examples()) examples_of_family<ContactLawSpec>().push_back(example);
  family.add<Law>(Law::declaration());
}

}  // namespace crampon
