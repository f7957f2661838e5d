#pragma once
/// What is known about one record of the input without knowing its C++ type: the table that parser, checks, JSON Schema,
/// reference page and resolved input all walk. Filled by core/declaration.hpp; nothing here knows the file format.

#include <any>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "crampon/core/error.hpp"
#include "crampon/core/function.hpp"

namespace crampon {

enum class Presence { optional, required };

/// Interval a number must lie in, in the SI unit of its key. NaN is never inside; infinity only where `infinite` says so.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;  ///< open: the end itself is excluded
  bool infinite = false;                     ///< "inf" and "-inf" have a meaning (never, unbounded)

  static Bounds any() { return {}; }
  static Bounds any_or_infinite() { return {.infinite = true}; }
  static Bounds positive() { return above(0); }
  static Bounds non_negative() { return at_least(0); }
  static Bounds above(double a) { return {.low = a, .low_open = true}; }
  static Bounds at_least(double a) { return {.low = a}; }
  static Bounds below(double b) { return {.high = b, .high_open = true}; }
  static Bounds at_most(double b) { return {.high = b}; }
  static Bounds between(double a, double b) { return {.low = a, .high = b}; }          ///< a <= x <= b
  static Bounds inside(double a, double b) { return {a, b, true, true, false}; }       ///< a < x < b
  static Bounds from_below(double a, double b) { return {a, b, false, true, false}; }  ///< a <= x < b
  static Bounds from_above(double a, double b) { return {a, b, true, false, false}; }  ///< a < x <= b

  bool contains(double x) const;
  /// "> 0", ">= 0 and < 0.5"; empty when there are none.
  std::string text() const;
};

/// How many values a list (or each point of a list of points) may have.
struct Length {
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
  static Length any() { return {}; }
  static Length exactly(std::size_t n) { return {n, n}; }
  static Length between(std::size_t a, std::size_t b) { return {a, b}; }
  static Length at_least(std::size_t n) { return {.least = n}; }
  bool contains(std::size_t n) const { return n >= least && n <= most; }
  /// "2", "1 to 3", "at least 2"; empty when any.
  std::string text() const;
};

/// Collects what is wrong with an input. Checks across keys receive one that knows where the record stands.
class Diagnostics {
 public:
  void add(Location location, std::string what, std::string why, std::string remedy);
  /// At a key of the record being checked (the record itself when the key is absent or empty).
  void add(const std::string& key, std::string what, std::string why, std::string remedy);
  void add(const char* key, std::string what, std::string why, std::string remedy) {
    add(std::string(key), std::move(what), std::move(why), std::move(remedy));
  }

  /// The record that add(key, ...) refers to from now on.
  void enter(Located here) { here_ = std::move(here); }
  const std::vector<Diagnostic>& list() const { return list_; }
  bool empty() const { return list_.empty(); }
  /// Throws InputError with all diagnostics in the order of the file, when there are any.
  void throw_if_any() const;

 private:
  std::vector<Diagnostic> list_;
  Located here_;
};

/// A member's value on its way between file and struct, in SI. monostate: nothing given.
using EntryValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::int64_t>,
                                std::vector<std::string>, std::vector<std::vector<double>>, ValueFunction, std::vector<ValueFunction>>;

class Record;
class AnyFamily;

/// One key of a record. Which of the functions are set follows from the kind.
struct Entry {
  enum class Kind {
    quantity,
    quantities,
    points,
    integer,
    integers,
    flag,
    text,
    texts,
    choice,
    function,
    functions,  // plain: set, get
    record,
    records,  // sub-tables: record, emplace, parts
    one_of,
    one_of_list,
    inline_one_of  // chosen by name: family, assign, parts
  };
  std::string key;  ///< inline_one_of: the key that names the alternative
  Kind kind = Kind::quantity;
  std::string unit;      ///< SI unit; "1" for a pure number; "any" when the dimension depends on what is compared
  std::string unit_key;  ///< a choice earlier in the record that decides the unit ...
  std::vector<std::pair<std::string, std::string>> units;  ///< ... by its word
  std::string help;
  Presence presence = Presence::optional;
  Bounds bounds;
  Length length;
  std::vector<std::string> choices;
  std::vector<std::string> excludes;  ///< keys of the record that contradict this one
  std::string words;                  ///< text: the list that knows its words, as json_schema() is told; empty: none
  bool file = false;                  ///< text: the path of a file that must exist, relative to the input
  bool name = false;                  ///< text: unique among its siblings; left out: numbered, "crack1", "crack2"

  std::function<void(void* object, const EntryValue&)> set;
  std::function<EntryValue(const void* object)> get;
  std::function<const Record&()> record;
  std::function<void*(void* object)> emplace;                         ///< the member's sub-record; in lists and optionals a new one
  std::function<std::vector<const void*>(const void* object)> parts;  ///< sub-records or family values that the member holds
  std::function<const AnyFamily&()> family;
  std::function<void(void* object, const std::any&)> assign;  ///< takes (or appends) what an alternative built

  bool plain() const { return kind < Kind::record; }
  bool list() const;
};

/// All keys of one struct. Obtained from a Declaration<T>; objects are handed around as pointers to T.
class Record {
 public:
  virtual ~Record() = default;
  const std::string& name() const { return name_; }
  const std::string& help() const { return help_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// The entry that names the record among its siblings; nullptr when there is none.
  const Entry* name_entry() const;
  /// Unit of an entry of this record, given the choices that `object` holds.
  std::string unit_of(const Entry& entry, const void* object) const;
  /// nullptr when there is no such key.
  const Entry* find(const std::string& key) const;

  /// A default-constructed object.
  virtual std::shared_ptr<void> create() const = 0;
  /// What the parser fills with places; nullptr when the struct does not derive from Located.
  virtual Located* located(void* object) const = 0;
  /// Runs the checks across keys.
  virtual void check(const void* object, Diagnostics& diagnostics) const = 0;

 protected:
  Record(std::string name, std::string help) : name_(std::move(name)), help_(std::move(help)) {}
  Record(const Record&) = default;
  Record& operator=(const Record&) = default;
  /// Throws std::logic_error when the key exists already.
  void add_entry(Entry entry);
  Entry& last_entry() { return entries_.back(); }

 private:
  std::string name_, help_;
  std::vector<Entry> entries_;
};

/// One member of a family: its record, and how a family value is made of it.
struct Alternative {
  const Record* record = nullptr;
  /// From an object of `record` to the family's R. May throw std::invalid_argument: reported at the table.
  std::function<std::any(void* object)> build;
  /// From an R to the alternative's object inside it; nullptr when R holds another one or hides what it holds.
  std::function<const void*(const void* value)> view;
  const std::string& name() const { return record->name(); }
};

/// Things of one kind to choose from by name: materials, shapes, contact laws.
class AnyFamily {
 public:
  const std::string& name() const { return name_; }
  const std::string& tag_key() const { return tag_key_; }
  const std::string& help() const { return help_; }
  const std::vector<Alternative>& alternatives() const { return alternatives_; }
  const Alternative* find(const std::string& name) const;
  /// The alternative that an R holds, where R shows it (std::variant, or as<T>()).
  const Alternative* holding(const void* value) const;

 protected:
  AnyFamily(std::string name, std::string tag_key, std::string help)
      : name_(std::move(name)), tag_key_(std::move(tag_key)), help_(std::move(help)) {}
  /// Throws std::logic_error when the name exists already.
  void add_alternative(Alternative alternative);

 private:
  std::string name_, tag_key_, help_;
  std::vector<Alternative> alternatives_;
};

}  // namespace crampon
