#pragma once
/// Short runs for tests: an input as text, stepped in memory.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crampon/input/read_problem.hpp"
#include "crampon/run/simulation.hpp"
#include "crampon/shape/registry.hpp"

namespace crampon::test {

inline std::unique_ptr<Simulation> make(const std::string& text, const std::vector<std::string>& overrides = {}, int threads = 1) {
  return Simulation::create(read_problem_text(text, "test.toml", ".", overrides), threads);
}

/// A [[material]] named "m" of density 1000 kg/m3 and nu = .3, for inputs as text. E: Pa
inline std::string material(const char* law, double E) {
  return fmt::format("[[material]]\nname = \"m\"\nlaw = \"{}\"\nE = {}\nnu = 0.3\ndensity = 1000\n", law, E);
}

/// The words of all shape functions.
inline std::vector<const char*> all_shape_functions() {
  std::vector<const char*> words;
  for_each_shape([&]<class Shape>(std::type_identity<Shape>) { words.push_back(Shape::name); });
  return words;
}
/// Cases of a test, one or more for each of the shape functions: make(word) gives those of one.
template <class Case, class Make>
std::vector<Case> for_all_shape_functions(Make make) {
  std::vector<Case> all;
  for (const char* word : all_shape_functions()) {
    for (const Case& c : make(word)) all.push_back(c);
  }
  return all;
}
inline ShapeFunctionKind kind_of_word(const std::string& word) {
  int kind = -1;
  for_each_shape([&]<class Shape>(std::type_identity<Shape>) {
    if (word == Shape::name) kind = static_cast<int>(kind_of<Shape>);
  });
  if (kind < 0) throw std::runtime_error("no shape function " + word);
  return ShapeFunctionKind{kind};
}
/// Which of a sweep's cases every run makes: of a sweep over places and shape functions each shape function at one place at least, and each place with
/// one shape function at least; the others are for full runs (suites whose first name ends in Full).
enum class Runs { every, full };
template <class Case>
std::vector<Case> cases_for(Runs runs, const std::vector<Case>& all) {
  std::map<std::string, std::size_t> number;  // of the shape functions of the sweep, in the order in which they come
  for (const Case& c : all) number.try_emplace(c.shape_functions, number.size());
  const std::size_t shapes = number.size(), places = (all.size() + shapes - 1) / shapes;
  std::map<std::string, std::size_t> met;  // so far, by shape function
  std::vector<Case> out;
  for (const Case& c : all) {
    const std::size_t shape = number[c.shape_functions], place = met[c.shape_functions]++;
    const bool in_every_run = place == shape % places || shape == place % shapes;
    if (in_every_run == (runs == Runs::every)) out.push_back(c);
  }
  return out;
}
/// Do nodes see particles without size that are more than a cell away? So do B-splines, for bars that depend on it.
inline bool sees_beyond_cell(const std::string& word) { return boxes_of(kind_of_word(word)).reach_of_sums() > 1; }
/// The words of those whose gradients do not jump.
inline std::vector<const char*> smooth_shape_functions() {
  std::vector<const char*> words;
  for (const char* word : all_shape_functions()) {
    if (boxes_of(kind_of_word(word)).smoothness() > 0) words.push_back(word);
  }
  return words;
}

/// One a line.
inline std::string notes_of(const Simulation& s) {
  std::string all;
  for (const std::string& n : s.notes()) all += n + "\n";
  return all;
}

/// Steps to the end; `each` sees the simulation after every step.
inline void run(Simulation& simulation, const std::function<void(Simulation&)>& each = {}) {
  while (!simulation.finished()) {
    simulation.step(simulation.end_time());
    if (each) each(simulation);
  }
}

inline const DataArray& field(const PointFrame& frame, const std::string& name) {
  for (const DataArray& f : frame.fields) {
    if (f.name == name) return f;
  }
  throw std::runtime_error("no field " + name);
}

inline double largest(const Numbers& values) {
  double m = 0;
  for (const double v : values) m = std::fmax(m, std::fabs(v));
  return m;
}

/// Largest difference of two lists; infinite when their lengths differ or a number is bad.
inline double difference(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double m = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::fabs(a[i] - b[i]);
    if (!(d <= m)) m = std::isnan(d) ? HUGE_VAL : d;
  }
  return m;
}

/// A history value by name.
inline double value(const Simulation& simulation, const std::string& name) {
  const auto columns = simulation.history_columns();
  const auto row = simulation.history_row();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == name) return row[i];
  }
  throw std::runtime_error("no column " + name);
}

/// What an event of a crack says, by the names of its columns.
inline double said(const Simulation& simulation, std::size_t event, const std::string& column) {
  const auto columns = simulation.event_columns();
  const auto row = simulation.event_row(event);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == column) return row[i];
  }
  throw std::runtime_error("no column " + column);
}

}  // namespace crampon::test
