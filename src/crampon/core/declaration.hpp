#pragma once
/// One declaration per parameter: key, member, unit, bounds and help are said once; the default is what a default-constructed
/// struct holds. Parser, checks, JSON Schema, reference page and resolved input are derived from it (core/record.hpp).
///
///   const Declaration<NeoHookean>& NeoHookean::declaration() {
///     static const auto d = Declaration<NeoHookean>("neo_hookean", "Compressible neo-Hookean solid.")
///         .quantity("E", &NeoHookean::E, "Pa", Bounds::positive(), "Young's modulus", Presence::required)
///         .quantity("nu", &NeoHookean::nu, "1", Bounds::from_below(0, 0.5), "Poisson's ratio", Presence::required);
///     return d;
///   }
///
/// Every method returns *this. Sub-records and families are given as functions that return them, called when first needed:
/// so a family may contain itself (a union of shapes is a shape).

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "crampon/core/record.hpp"

namespace crampon {

template <class R>
class Family;

template <class T>
class Declaration : public Record {
 public:
  using Kind = Entry::Kind;

  /// name: of the record, or of the alternative when it is added to a family.
  Declaration(std::string name, std::string help) : Record(std::move(name), std::move(help)) {}

  /// A number with a unit: 2.5 (SI) or "2.5 mm".
  Declaration& quantity(std::string key, double T::*m, std::string unit, Bounds bounds, std::string help, Presence presence = {}) {
    return plain<double>(Kind::quantity, std::move(key), m, std::move(help), presence, std::move(unit), bounds);
  }
  Declaration& quantity(std::string key, std::optional<double> T::*m, std::string unit, Bounds bounds, std::string help,
                        Presence presence = {}) {
    return plain<double>(Kind::quantity, std::move(key), m, std::move(help), presence, std::move(unit), bounds);
  }
  /// A list of numbers with a unit; a single number is read as a list of one where `length` allows it.
  Declaration& quantities(std::string key, std::vector<double> T::*m, std::string unit, Bounds bounds, std::string help,
                          Presence presence = {}, Length length = {}) {
    return plain<std::vector<double>>(Kind::quantities, std::move(key), m, std::move(help), presence, std::move(unit), bounds, length);
  }
  /// A list of points; `length` is that of each point.
  Declaration& points(std::string key, std::vector<std::vector<double>> T::*m, std::string unit, std::string help, Presence presence = {},
                      Length length = Length::between(2, 3)) {
    return plain<std::vector<std::vector<double>>>(Kind::points, std::move(key), m, std::move(help), presence, std::move(unit), {}, length);
  }

  Declaration& integer(std::string key, std::int64_t T::*m, Bounds bounds, std::string help, Presence presence = {}) {
    return plain<std::int64_t>(Kind::integer, std::move(key), m, std::move(help), presence, "1", bounds);
  }
  Declaration& integer(std::string key, std::optional<std::int64_t> T::*m, Bounds bounds, std::string help, Presence presence = {}) {
    return plain<std::int64_t>(Kind::integer, std::move(key), m, std::move(help), presence, "1", bounds);
  }
  /// The bounds are narrowed to what an int holds.
  Declaration& integer(std::string key, int T::*m, Bounds bounds, std::string help, Presence presence = {}) {
    bounds.low = std::max(bounds.low, double(std::numeric_limits<int>::min()));
    bounds.high = std::min(bounds.high, double(std::numeric_limits<int>::max()));
    return plain<std::int64_t>(Kind::integer, std::move(key), m, std::move(help), presence, "1", bounds);
  }
  Declaration& integers(std::string key, std::vector<std::int64_t> T::*m, Bounds bounds, std::string help, Presence presence = {},
                        Length length = {}) {
    return plain<std::vector<std::int64_t>>(Kind::integers, std::move(key), m, std::move(help), presence, "1", bounds, length);
  }

  Declaration& flag(std::string key, bool T::*m, std::string help, Presence presence = {}) {
    return plain<bool>(Kind::flag, std::move(key), m, std::move(help), presence);
  }
  Declaration& flag(std::string key, std::optional<bool> T::*m, std::string help, Presence presence = {}) {
    return plain<bool>(Kind::flag, std::move(key), m, std::move(help), presence);
  }
  Declaration& text(std::string key, std::string T::*m, std::string help, Presence presence = {}) {
    return plain<std::string>(Kind::text, std::move(key), m, std::move(help), presence);
  }
  Declaration& text(std::string key, std::optional<std::string> T::*m, std::string help, Presence presence = {}) {
    return plain<std::string>(Kind::text, std::move(key), m, std::move(help), presence);
  }
  Declaration& text(std::string key, std::vector<std::string> T::*m, std::string help, Presence presence = {}) {
    return plain<std::vector<std::string>>(Kind::texts, std::move(key), m, std::move(help), presence);
  }

  /// What others call this record; unique in its list. Left out where optional: numbered, "crack1", "crack2".
  Declaration& name(std::string key, std::string T::*m, std::string help, Presence presence = {}) {
    text(std::move(key), m, std::move(help), presence);
    last_entry().name = true;
    return *this;
  }
  using Record::name;
  /// The path of a file that must exist, relative to the input.
  Declaration& file(std::string key, std::optional<std::string> T::*m, std::string help, Presence presence = {}) {
    text(std::move(key), m, std::move(help), presence);
    last_entry().file = true;
    return *this;
  }

  /// One of a few words; E is an enum, or any type with == (int for an axis, std::string).
  template <class E>
  Declaration& choice(std::string key, E T::*m, std::vector<std::pair<std::string, std::type_identity_t<E>>> words, std::string help,
                      Presence presence = {}) {
    return choice_of<E>(std::move(key), m, std::move(words), std::move(help), presence);
  }
  template <class E>
  Declaration& choice(std::string key, std::optional<E> T::*m, std::vector<std::pair<std::string, std::type_identity_t<E>>> words,
                      std::string help, Presence presence = {}) {
    return choice_of<E>(std::move(key), m, std::move(words), std::move(help), presence);
  }

  /// A function of time and place: a number, "2 mm/s", {expression, unit}, {times, values} or {file}.
  Declaration& function(std::string key, ValueFunction T::*m, std::string unit, std::string help, Presence presence = {}) {
    return plain<ValueFunction>(Kind::function, std::move(key), m, std::move(help), presence, std::move(unit));
  }
  Declaration& function(std::string key, std::optional<ValueFunction> T::*m, std::string unit, std::string help, Presence presence = {}) {
    return plain<ValueFunction>(Kind::function, std::move(key), m, std::move(help), presence, std::move(unit));
  }
  Declaration& function(std::string key, std::vector<ValueFunction> T::*m, std::string unit, std::string help, Presence presence = {},
                        Length length = {}) {
    return plain<std::vector<ValueFunction>>(Kind::functions, std::move(key), m, std::move(help), presence, std::move(unit), {}, length);
  }

  /// A table of its own: [key], or key = { ... }.
  template <class Sub>
  Declaration& record(std::string key, Sub T::*m, std::type_identity_t<std::function<const Declaration<Sub>&()>> declaration,
                      std::string help, Presence presence = {}) {
    Entry e = entry(Kind::record, std::move(key), std::move(help), presence);
    e.record = [declaration]() -> const Record& { return declaration(); };
    e.emplace = [m](void* o) -> void* { return &(of(o).*m); };
    e.parts = [m](const void* o) { return std::vector<const void*>{&(of(o).*m)}; };
    return add(std::move(e));
  }
  template <class Sub>
  Declaration& record(std::string key, std::optional<Sub> T::*m, std::type_identity_t<std::function<const Declaration<Sub>&()>> declaration,
                      std::string help, Presence presence = {}) {
    Entry e = entry(Kind::record, std::move(key), std::move(help), presence);
    e.record = [declaration]() -> const Record& { return declaration(); };
    e.emplace = [m](void* o) -> void* { return &(of(o).*m).emplace(); };
    e.parts = [m](const void* o) {
      const auto& sub = of(o).*m;
      return sub ? std::vector<const void*>{&*sub} : std::vector<const void*>{};
    };
    return add(std::move(e));
  }
  /// An array of tables: [[key]]. Required: at least one.
  template <class Sub>
  Declaration& records(std::string key, std::vector<Sub> T::*m, std::type_identity_t<std::function<const Declaration<Sub>&()>> declaration,
                       std::string help, Presence presence = {}) {
    Entry e = entry(Kind::records, std::move(key), std::move(help), presence);
    e.record = [declaration]() -> const Record& { return declaration(); };
    e.emplace = [m](void* o) -> void* { return &(of(o).*m).emplace_back(); };
    e.parts = [m](const void* o) { return addresses(of(o).*m); };
    return add(std::move(e));
  }

  /// A table whose tag key chooses the alternative: shape = { kind = "disk", ... }.
  template <class R>
  Declaration& one_of(std::string key, R T::*m, std::type_identity_t<std::function<const Family<R>&()>> family, std::string help,
                      Presence presence = {}) {
    return add(family_entry<R>(Kind::one_of, std::move(key), m, std::move(family), std::move(help), presence));
  }
  /// An array of such tables.
  template <class R>
  Declaration& one_of_list(std::string key, std::vector<R> T::*m, std::type_identity_t<std::function<const Family<R>&()>> family,
                           std::string help, Presence presence = {}, Length length = {}) {
    Entry e = entry(Kind::one_of_list, std::move(key), std::move(help), presence, "", {}, length);
    e.family = [family = std::move(family)]() -> const AnyFamily& { return family(); };
    e.assign = [m](void* o, const std::any& built) { (of(o).*m).push_back(std::any_cast<const R&>(built)); };
    e.parts = [m](const void* o) { return addresses(of(o).*m); };
    return add(std::move(e));
  }
  /// The tag and the alternative's keys stand in this record's own table: law = "neo_hookean", E = "1 MPa".
  template <class R>
  Declaration& inline_one_of(std::string tag_key, R T::*m, std::type_identity_t<std::function<const Family<R>&()>> family, std::string help,
                             Presence presence = Presence::required) {
    return add(family_entry<R>(Kind::inline_one_of, std::move(tag_key), m, std::move(family), std::move(help), presence));
  }

  /// The unit of the key just declared follows from the word chosen at `choice_key`, declared before it.
  Declaration& unit_by(const std::string& choice_key, const std::vector<std::pair<std::string, std::string>>& units) {
    last_entry().unit_key = choice_key;
    last_entry().units = units;
    return *this;
  }

  /// The words that the text just declared may hold are listed elsewhere: editors are offered that list (json_schema() in input/schema.hpp).
  Declaration& words_from(const std::string& list) {
    last_entry().words = list;
    return *this;
  }

  /// The key just declared and `keys` contradict each other: giving both is an error.
  Declaration& excludes(const std::vector<std::string>& keys) {
    last_entry().excludes = keys;
    return *this;
  }

  /// A rule across keys of one record; runs when every key by itself was read without error.
  /// Point at a key by diagnostics.add("key", what, why, remedy).
  Declaration& check(std::function<void(const T&, Diagnostics&)> rule) {
    checks_.push_back(std::move(rule));
    return *this;
  }

  std::shared_ptr<void> create() const override { return std::make_shared<T>(); }
  Located* located([[maybe_unused]] void* object) const override {
    if constexpr (std::is_base_of_v<Located, T>)
      return &of(object);
    else
      return nullptr;
  }
  void check(const void* object, Diagnostics& diagnostics) const override {
    for (const auto& rule : checks_) rule(of(object), diagnostics);
  }

 private:
  std::vector<std::function<void(const T&, Diagnostics&)>> checks_;

  static T& of(void* object) { return *static_cast<T*>(object); }
  static const T& of(const void* object) { return *static_cast<const T*>(object); }
  template <class Sub>
  static std::vector<const void*> addresses(const std::vector<Sub>& list) {
    std::vector<const void*> out;
    for (const Sub& sub : list) out.push_back(&sub);
    return out;
  }
  static Entry entry(Kind kind, std::string key, std::string help, Presence presence, std::string unit = "", Bounds bounds = {},
                     Length length = {}) {
    Entry e;
    e.kind = kind;
    e.key = std::move(key);
    e.help = std::move(help);
    e.presence = presence;
    e.unit = std::move(unit);
    e.bounds = bounds;
    e.length = length;
    return e;
  }
  Declaration& add(Entry e) {
    add_entry(std::move(e));
    return *this;
  }
  /// V: what the parser hands over; M: the member, V itself, an integer narrower than it, or an optional of it.
  template <class V, class M>
  Declaration& plain(Kind kind, std::string key, M T::*m, std::string help, Presence presence, std::string unit = "", Bounds bounds = {},
                     Length length = {}) {
    Entry e = entry(kind, std::move(key), std::move(help), presence, std::move(unit), bounds, length);
    e.set = [m](void* o, const EntryValue& value) { of(o).*m = static_cast<M>(std::get<V>(value)); };
    e.get = [m](const void* o) -> EntryValue {
      if constexpr (std::is_same_v<M, std::optional<V>>) {
        const auto& held = of(o).*m;
        return held ? EntryValue(*held) : EntryValue();
      } else {
        return EntryValue(static_cast<V>(of(o).*m));
      }
    };
    return add(std::move(e));
  }
  template <class E, class M>
  Declaration& choice_of(std::string key, M T::*m, std::vector<std::pair<std::string, E>> words, std::string help, Presence presence) {
    Entry e = entry(Kind::choice, std::move(key), std::move(help), presence);
    for (const auto& [word, meaning] : words) e.choices.push_back(word);
    e.set = [m, words](void* o, const EntryValue& value) {
      for (const auto& [word, meaning] : words)
        if (word == std::get<std::string>(value)) of(o).*m = meaning;
    };
    e.get = [m, words](const void* o) -> EntryValue {
      for (const auto& [word, meaning] : words)
        if (of(o).*m == meaning) return word;
      return {};
    };
    return add(std::move(e));
  }
  template <class R>
  Entry family_entry(Kind kind, std::string key, R T::*m, std::function<const Family<R>&()> family, std::string help, Presence presence) {
    Entry e = entry(kind, std::move(key), std::move(help), presence);
    e.family = [family = std::move(family)]() -> const AnyFamily& { return family(); };
    e.assign = [m](void* o, const std::any& built) { of(o).*m = std::any_cast<const R&>(built); };
    e.parts = [m](const void* o) { return std::vector<const void*>{&(of(o).*m)}; };
    return e;
  }
};

namespace detail {
template <class T, class R>
struct HoldsAlternative : std::false_type {};
template <class T, class... A>
struct HoldsAlternative<T, std::variant<A...>> : std::bool_constant<(std::is_same_v<T, A> || ...)> {};
}  // namespace detail

/// A family whose values are R: a std::variant of the alternatives, or a pointer to what they have in common; one with as<T>() shows what it holds.
template <class R>
class Family : public AnyFamily {
 public:
  /// tag_key: the key that names the alternative ("law", "kind").
  Family(std::string name, std::string tag_key, std::string help) : AnyFamily(std::move(name), std::move(tag_key), std::move(help)) {}

  /// Adds an alternative under its declaration's name; the declaration must outlive the family. May be called at any time
  /// before an input is read. make may throw std::invalid_argument when the parameters do not fit together.
  template <class T>
  Family& add(
      const Declaration<T>& declaration, std::type_identity_t<std::function<R(T)>> make = [](T t) { return R{std::move(t)}; }) {
    Alternative a;
    a.record = &declaration;
    a.build = [make = std::move(make)](void* object) { return std::any(make(std::move(*static_cast<T*>(object)))); };
    a.view = []([[maybe_unused]] const void* value) -> const void* {
      if constexpr (detail::HoldsAlternative<T, R>::value)
        return std::get_if<T>(static_cast<const R*>(value));
      else if constexpr (requires(const R& held) { held.template as<T>(); })
        return static_cast<const R*>(value)->template as<T>();
      else
        return nullptr;
    };
    add_alternative(std::move(a));
    return *this;
  }
};

}  // namespace crampon
