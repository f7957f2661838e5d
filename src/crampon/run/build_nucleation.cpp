#include "crampon/run/build_nucleation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace crampon {

namespace {

/// Do cracks of the nucleation start in a body?
bool starts_in(const NucleationInput& in, const BodyInput& body) {
  return !body.ignores_cracks &&
         (in.materials.empty() || std::find(in.materials.begin(), in.materials.end(), body.material) != in.materials.end());
}

}  // namespace

void reserve_cracks(const Problem& problem, const NucleationInput& in, Model<2>& model, State<2>& state, std::vector<Diagnostic>& errors) {
  CrackTraction traction;
  traction.law = in.traction;
  const BodyInput* first = nullptr;
  for (const BodyInput& body : problem.bodies) {
    if (!starts_in(in, body)) continue;
    if (!first) {
      first = &body;
      traction.thickness = body.thickness;
    } else if (traction.acts() && body.thickness != first->thickness) {
      errors.push_back({in.at("traction"), fmt::format("the bodies \"{}\" and \"{}\" differ in thickness", first->name, body.name),
                        "it is not clear on which the traction acts", "give each material a [[nucleation]] of its own, by materials"});
      break;
    }
  }
  if (!first)
    errors.push_back({in.at("materials"), fmt::format("no crack of the nucleation \"{}\" can start", in.name),
                      "no body that cracks part is made of these materials", "add a material, or remove materials"});
  for (std::int64_t k = 1; k <= in.most; ++k) {
    Crack<2> crack;
    crack.name = fmt::format("{}.{}", in.name, k);
    model.contact.crack_laws.push_back(in.contact);
    model.tractions.push_back(traction);
    state.observed.cracked.emplace_back();
    state.cracks.list.push_back(std::move(crack));
  }
}

NucleationModel build_nucleation(const Problem& problem, const NucleationInput& in, const BuiltBodies<2>& bodies, const Model<2>& model,
                                 double interval, std::uint32_t first) {
  const double h = model.grid.largest_cell();
  NucleationModel out;
  out.name = in.name;
  out.materials.resize(model.materials.size());
  for (const NewParticle<2>& p : bodies.particles) {
    if (p.body < problem.bodies.size() && starts_in(in, problem.bodies[p.body])) out.materials[p.material] = true;
  }
  out.region = in.region;
  out.strength = in.strength;
  out.radius = in.radius * h;
  out.length = in.length * h;
  out.distance = in.least_distance() * h;
  out.interval = interval;
  out.first = first;
  out.most = in.most;
  return out;
}

}  // namespace crampon
