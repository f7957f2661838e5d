#include "crampon/run/build_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "crampon/core/closest_name.hpp"
#include "crampon/step/rigid_motion.hpp"

namespace crampon {

namespace {

/// The fields that a name in a contact pair stands for: a field of that name, that of a body, or those of all bodies of a material.
template <int Dim>
std::vector<std::size_t> fields_named(const Problem& problem, const Model<Dim>& model, const std::string& name) {
  std::vector<std::size_t> out;
  const auto add = [&](const std::string& field) {
    for (std::size_t f = 0; f < model.contact.fields.size(); ++f) {
      if (model.contact.fields[f].name == field && std::find(out.begin(), out.end(), f) == out.end()) out.push_back(f);
    }
  };
  add(name);
  for (const BodyInput& body : problem.bodies) {
    if (body.name != name && body.material != name) continue;
    add(body.field                                      ? *body.field
        : problem.contact.fields == FieldsOf::bodies    ? body.name
        : problem.contact.fields == FieldsOf::materials ? body.material
                                                        : "");
  }
  return out;
}

template <int Dim>
std::vector<std::string> names_about(const Problem& problem, const Model<Dim>& model) {
  std::vector<std::string> names;
  for (const MaterialField& field : model.contact.fields) {
    if (!field.name.empty()) names.push_back(field.name);
  }
  for (const BodyInput& body : problem.bodies) names.push_back(body.name), names.push_back(body.material);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

template <int Dim>
void set_pair(const ContactPairInput& in, std::size_t a, std::size_t b, Model<Dim>& model) {
  const std::size_t n = model.contact.fields.size();
  model.contact.field_laws[a * n + b] = model.contact.field_laws[b * n + a] = in.contact;
  Vec<Dim> normal;
  for (std::size_t k = 0; k < in.normal.size() && k < Dim; ++k) normal[k] = in.normal[k];
  model.contact.field_normals[a * n + b] = normalized(normal);
  model.contact.field_normals[b * n + a] = -normalized(normal);
}

template <int Dim>
void add_pair(const Problem& problem, const ContactPairInput& in, Model<Dim>& model, std::vector<Diagnostic>& errors) {
  std::vector<std::size_t> sides[2];
  for (std::size_t k = 0; k < 2; ++k) {
    sides[k] = fields_named(problem, model, in.between[k]);
    if (!sides[k].empty()) continue;
    errors.push_back({in.at(fmt::format("between[{}]", k)), fmt::format("nothing is called \"{}\"", in.between[k]),
                      "a pair names bodies, rigid bodies, walls, materials or fields",
                      suggest_from(in.between[k], names_about(problem, model))});
  }
  bool any = false;
  for (const std::size_t a : sides[0]) {
    for (const std::size_t b : sides[1]) {
      if (a != b) set_pair(in, a, b, model), any = true;
    }
  }
  if (any || sides[0].empty() || sides[1].empty()) return;
  errors.push_back({in.at("between"), fmt::format("\"{}\" and \"{}\" share a velocity field", in.between[0], in.between[1]),
                    "bodies of one field stick to each other",
                    "set contact.fields to \"materials\" or \"bodies\", or give bodies a field"});
}

/// Fields that bonded laws join, in chains, share a velocity where no crack parts them. One after another, bonded pairs are pairs like others.
template <int Dim>
void find_bonds(Model<Dim>& model) {
  const auto bonded = [&](std::uint16_t a, std::uint16_t b) {
    return model.contact.makes_one_group(model.contact.law_between(a, b)) && !model.ignores_cracks(a) && !model.ignores_cracks(b);
  };
  const auto count = static_cast<std::uint16_t>(model.contact.fields.size());
  for (std::uint16_t a = 0; a < count; ++a) {
    model.contact.fields[a].bonded_to = a;
    for (std::uint16_t b = 0; b < a; ++b) {
      const std::uint16_t from = model.contact.fields[a].bonded_to, to = model.contact.fields[b].bonded_to;
      if (!bonded(a, b) || from == to) continue;
      for (std::uint16_t f = 0; f <= a; ++f) {
        std::uint16_t& root = model.contact.fields[f].bonded_to;
        if (root == std::max(from, to)) root = std::min(from, to);
      }
    }
  }
}

/// The condition through which a rigid body prescribes velocities; its nodes are found in every step.
template <int Dim>
void add_condition(const RigidInput& in, std::size_t body, Model<Dim>& model) {
  VelocityCondition<Dim> c;
  c.name = in.name;
  c.rigid_body = static_cast<int>(body);
  c.end = std::numeric_limits<double>::infinity();
  for (int k = 0; k < Dim; ++k) {
    const std::string axis(1, "xyz"[k]);
    if (in.components.empty() || std::find(in.components.begin(), in.components.end(), axis) != in.components.end())
      c.components.push_back({k, ValueFunction()});
  }
  model.rigid_bodies[body].condition = static_cast<std::uint16_t>(model.conditions.size());
  model.conditions.push_back(std::move(c));
}

}  // namespace

template <int Dim>
void build_contact(const Problem& problem, Model<Dim>& model, State<Dim>& state, std::vector<Diagnostic>& errors) {
  const std::size_t n = model.contact.fields.size();
  model.contact.field_laws.assign(n * n, problem.contact.between_fields);
  model.contact.field_normals.assign(n * n, Vec<Dim>{});
  for (const ContactPairInput& in : problem.contact_pairs) add_pair(problem, in, model, errors);
  find_bonds(model);
  for (std::size_t w = 0; w < problem.walls.size(); ++w) {
    const std::uint16_t wall = model.rigid_bodies[problem.rigids.size() + w].field;
    for (std::size_t f = 0; f < n; ++f) {
      if (model.is_rigid(static_cast<int>(f)) || !model.contact.law_between(static_cast<int>(f), wall).has_springs()) continue;
      errors.push_back({problem.walls[w].location,
                        fmt::format("the law between the wall \"{}\" and bodies is an interface", problem.walls[w].name),
                        "a wall has no displacement to hang a spring on",
                        "give the wall another law by a [[contact_pair]], or make it a [[rigid]] body of particles"});
      break;
    }
  }
  for (std::size_t r = 0; r < problem.rigids.size(); ++r) {
    RigidBody<Dim>& body = model.rigid_bodies[r];
    if (body.prescribes()) add_condition(problem.rigids[r], r, model);
    // A spring hangs on a displacement, which a shape does not have.
    bool has_springs = false;
    for (int f = 0; f < static_cast<int>(n); ++f)
      has_springs =
          has_springs || (!model.is_rigid(static_cast<std::uint16_t>(f)) && model.contact.law_between(f, body.field).has_springs());
    if (!has_springs || body.acts != RigidBody<Dim>::Acts::face) continue;
    const RigidInput& in = problem.rigids[r];
    if (in.faces) {
      errors.push_back({in.at("faces"), fmt::format("the law between the rigid body \"{}\" and bodies is an interface", in.name),
                        "the face of a shape has no displacement to hang a spring on",
                        "set faces = \"particles\", or give the body another law by a [[contact_pair]]"});
    } else if (body.is_empty) {
      errors.push_back({in.at("shape"),
                        fmt::format("the rigid body \"{}\" has no particles, and bodies hang on it by an interface", in.name),
                        "no particle's place lies in its shape", "make it thicker, or use smaller cells or more particles_per_cell"});
    }
    body.acts = RigidBody<Dim>::Acts::particles;
  }
  for (const RigidBody<Dim>& body : model.rigid_bodies) {
    model.contact.fields[body.field].meets_at_nodes = body.acts == RigidBody<Dim>::Acts::particles;
  }
  state.rigid.resize(model.rigid_bodies.size());
  for (std::size_t r = 0; r < state.rigid.size(); ++r) {
    state.rigid[r].start.centre = state.rigid[r].start.pivot = model.rigid_bodies[r].centre;
    state.rigid[r].present = state.rigid[r].start;
  }
  start_rigid_motion(state, model, 0);
  for (RigidMotion<Dim>& motion : state.rigid) motion.end = motion.start;
}

template void build_contact<2>(const Problem&, Model<2>&, State<2>&, std::vector<Diagnostic>&);
template void build_contact<3>(const Problem&, Model<3>&, State<3>&, std::vector<Diagnostic>&);

}  // namespace crampon
