#include <algorithm>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

/// What [contact] says about bodies that meet, as opposed to the faces of a crack.
constexpr const char* keys_about_bodies[] = {"default", "material_detection", "position_cutoff",
                                             "normal",  "rigid_bias",         "several_materials"};

std::string motion_text(const BodyInput& body) {
  std::string out;
  for (const ValueFunction& v : body.velocity) out += v.text() + ";";
  for (const double s : body.spin) out += s != 0 ? fmt::format("{};", s) : "";
  return out;
}

/// Bodies that are glued to each other begin beside each other and with one motion.
template <int Dim>
bool seem_to_meet(const Start<Dim>& start, std::size_t a, std::size_t b) {
  if (motion_text(start.problem.bodies[a]) != motion_text(start.problem.bodies[b])) return true;
  for (int k = 0; k < Dim; ++k) {
    const double gap = std::max(start.bodies[a].low()[k] - start.bodies[b].high()[k], start.bodies[b].low()[k] - start.bodies[a].high()[k]);
    if (gap > 1e-6 * start.model.grid.cell[k]) return true;
  }
  return false;
}

template <int Dim>
bool any_seem_to_meet(const Start<Dim>& start) {
  for (std::size_t b = 1; b < start.problem.bodies.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (seem_to_meet(start, a, b)) return true;
    }
  }
  return false;
}

}  // namespace

template <int Dim>
void note_contact_without_fields(const Start<Dim>& start, Notes& notes) {
  const Problem& problem = start.problem;
  if (problem.contact.fields == FieldsOf::bodies && !problem.contact.keys.contains("fields")) {
    notes.push_back({problem.contact.at("default"), "each body has a velocity field of its own",
                     "contact.fields is not given, and in one field for all this law would hold nowhere",
                     "set contact.fields = \"bodies\", or \"single\" for bodies that stick where they meet"});
    return;
  }
  std::vector<std::string> stated;
  for (const char* key : keys_about_bodies) {
    if (problem.contact.keys.contains(key)) stated.emplace_back(key);
  }
  const auto& fields = start.model.contact.fields;
  const auto deformable = std::count_if(fields.begin(), fields.end(), [](const MaterialField& f) { return !f.rigid; });
  if (stated.empty() || deformable > 1) return;
  const bool any_rigid = std::any_of(start.model.rigid_bodies.begin(), start.model.rigid_bodies.end(),
                                     [](const RigidBody<Dim>& body) { return !body.prescribes(); });
  const bool several = problem.bodies.size() > 1;
  if (any_rigid && (stated.front() != "default" || !several || !any_seem_to_meet(start))) return;
  std::string names;
  for (const BodyInput& body : problem.bodies) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", body.name);
  const std::string what = any_rigid           ? "the law holds at rigid bodies and walls only"
                           : stated.size() > 1 ? fmt::format("{} have no effect", fmt::join(stated, ", "))
                                               : stated.front() + " has no effect";
  if (several) {
    notes.push_back({problem.contact.at(stated.front()), what,
                     fmt::format("the bodies {} share one velocity field and stick where they meet", names),
                     "set contact.fields = \"bodies\", or give bodies a field of their own"});
  } else {
    notes.push_back({problem.contact.at(stated.front()), what, fmt::format("there is nothing that the body {} could meet", names),
                     problem.cracks.empty() ? "remove it, or add a body, a [[rigid]] or a [[wall]]"
                                            : "the law between the faces of a crack is its own: [[crack]] contact"});
  }
}

template void note_contact_without_fields(const Start<2>&, Notes&);
template void note_contact_without_fields(const Start<3>&, Notes&);

}  // namespace crampon
