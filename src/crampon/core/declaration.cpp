#include "crampon/core/declaration.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace crampon {

bool Bounds::contains(double x) const {
  if (std::isnan(x) || (std::isinf(x) && !infinite)) return false;
  return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Bounds::text() const {
  std::string out;
  if (std::isfinite(low)) out += fmt::format("{} {}", low_open ? ">" : ">=", low);
  if (std::isfinite(high)) out += fmt::format("{}{} {}", out.empty() ? "" : " and ", high_open ? "<" : "<=", high);
  return out;
}

std::string Length::text() const {
  const bool limited = most != std::numeric_limits<std::size_t>::max();
  if (!limited) return least == 0 ? "" : fmt::format("at least {}", least);
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

void Diagnostics::add(Location location, std::string what, std::string why, std::string remedy) {
  // A Diagnostic is one sentence; help texts and libraries end theirs.
  for (std::string* part : {&what, &why})
    if (part->ends_with('.')) part->pop_back();
  list_.push_back({std::move(location), std::move(what), std::move(why), std::move(remedy)});
}

void Diagnostics::add(const std::string& key, std::string what, std::string why, std::string remedy) {
  add(here_.at(key), std::move(what), std::move(why), std::move(remedy));
}

void Diagnostics::throw_if_any() const {
  if (list_.empty()) return;
  std::vector<Diagnostic> sorted = list_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.location.line, a.location.column) < std::tie(b.location.line, b.location.column);
  });
  throw InputError(std::move(sorted));
}

bool Entry::list() const {
  switch (kind) {
    case Kind::quantities:
    case Kind::points:
    case Kind::integers:
    case Kind::texts:
    case Kind::functions:
    case Kind::records:
    case Kind::one_of_list:
      return true;
    default:
      return false;
  }
}

const Entry* Record::find(const std::string& key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

const Entry* Record::name_entry() const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [](const Entry& e) { return e.name; });
  return found == entries_.end() ? nullptr : &*found;
}

std::string Record::unit_of(const Entry& entry, const void* object) const {
  if (entry.unit_key.empty()) return entry.unit;
  const EntryValue chosen = find(entry.unit_key)->get(object);
  for (const auto& [word, unit] : entry.units)
    if (std::holds_alternative<std::string>(chosen) && std::get<std::string>(chosen) == word) return unit;
  return entry.unit;
}

void Record::add_entry(Entry entry) {
  if (find(entry.key)) throw std::logic_error("record " + name_ + " declares the key " + entry.key + " twice");
  entries_.push_back(std::move(entry));
}

const Alternative* AnyFamily::find(const std::string& name) const {
  const auto found = std::find_if(alternatives_.begin(), alternatives_.end(), [&](const Alternative& a) { return a.name() == name; });
  return found == alternatives_.end() ? nullptr : &*found;
}

const Alternative* AnyFamily::holding(const void* value) const {
  const auto found = std::find_if(alternatives_.begin(), alternatives_.end(), [&](const Alternative& a) { return a.view(value); });
  return found == alternatives_.end() ? nullptr : &*found;
}

void AnyFamily::add_alternative(Alternative alternative) {
  if (find(alternative.name())) throw std::logic_error("family " + name_ + " has " + alternative.name() + " already");
  alternatives_.push_back(std::move(alternative));
}

}  // namespace crampon
