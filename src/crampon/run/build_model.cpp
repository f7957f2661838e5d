#include "crampon/run/build_model.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "crampon/geometry/arc.hpp"
#include "crampon/run/build_bodies.hpp"
#include "crampon/run/build_contact.hpp"
#include "crampon/run/build_fracture.hpp"
#include "crampon/run/build_loads.hpp"
#include "crampon/run/build_nucleation.hpp"
#include "crampon/run/crack_ends.hpp"
#include "crampon/run/initial_stress.hpp"
#include "crampon/run/surfaces_at_start.hpp"
#include "crampon/step/crack_tractions.hpp"
#include "crampon/step/face_loads.hpp"

namespace crampon {

namespace {

template <int Dim>
Grid<Dim> build_grid(const GridInput& in) {
  Vec<Dim> origin, cell;
  IndexVector<Dim> cells{};
  for (int k = 0; k < Dim; ++k) {
    origin[k] = in.origin[static_cast<std::size_t>(k)];
    cell[k] = in.cell.size() == 1 ? in.cell[0] : in.cell[static_cast<std::size_t>(k)];
    cells[k] = static_cast<int>(std::lround(in.size[static_cast<std::size_t>(k)] / cell[k]));
  }
  return Grid<Dim>(origin, cell, cells);
}

/// f(node number, position) for nodes within a box, as far out as stencils reach beyond the grid.
template <int Dim, class F>
void for_nodes(const Grid<Dim>& grid, const Bounds3& box, F f) {
  constexpr int beyond = 2;
  IndexVector<Dim> low{}, high{};
  for (int k = 0; k < Dim; ++k) {
    const auto index = [&](double x) {
      return std::fmin(std::fmax((x - grid.origin[k]) * grid.inverse_cell[k], -beyond), grid.cells[k] + beyond);
    };
    low[k] = static_cast<int>(std::floor(index(box.low[k]) - 1e-6));
    high[k] = static_cast<int>(std::ceil(index(box.high[k]) + 1e-6));
    low[k] = std::max(low[k], -beyond);
    high[k] = std::min(high[k], grid.cells[k] + beyond);
    if (low[k] > high[k]) return;
  }
  IndexVector<Dim> node = low;
  for (;;) {
    f(grid.node_number(node), grid.node_position(node));
    int k = 0;
    while (k < Dim && ++node[k] > high[k]) node[k] = low[k], ++k;
    if (k == Dim) return;
  }
}

/// A time at which `a` prescribes another value than `b`, which is stated later, holds at all its nodes, from its start to its end, on the
/// same axis, and so leaves nothing of it. Values that depend on the place are not compared.
template <int Dim>
std::optional<double> overruled_at(const VelocityCondition<Dim>& a, const ValueFunction& of_a, const VelocityCondition<Dim>& b,
                                   const ValueFunction& of_b) {
  if (b.start > a.start || b.end < a.end || !(a.start < a.end) || of_a.depends_on_position() || of_b.depends_on_position()) return {};
  const double span = std::isfinite(a.end) ? a.end - a.start : 1.;
  for (const double t : {a.start, a.start + 0.37 * span, a.start + 0.81 * span}) {  // unlikely to be where two curves cross
    if (of_a(t, {}) != of_b(t, {})) return t;
  }
  return {};
}

/// Of several values for one component at a node the last one stated holds, so that a part of a region can differ from the rest.
/// A condition that another overrules everywhere and all the time with another value is a contradiction.
template <int Dim>
void check_contradictions(const Model<Dim>& model, const std::vector<const Located*>& stated, std::vector<Diagnostic>& errors) {
  const auto compare = [&](std::size_t i, const VelocityCondition<Dim>& b) {
    const VelocityCondition<Dim>& a = model.conditions[i];
    if (a.nodes.empty() || !std::includes(b.nodes.begin(), b.nodes.end(), a.nodes.begin(), a.nodes.end())) return;
    for (const auto& of_a : a.components) {
      for (const auto& of_b : b.components) {
        const auto t = of_a.axis == of_b.axis ? overruled_at(a, of_a.value, b, of_b.value) : std::nullopt;
        if (!t) continue;
        errors.push_back({stated[i]->location,
                          fmt::format("\"{}\" prescribes v{} = {:g} m/s where \"{}\" prescribes {:g} m/s, at t = {:g} s", a.name,
                                      "xyz"[of_a.axis], of_a.value(*t, {}), b.name, of_b.value(*t, {}), *t),
                          b.symmetry ? "material stays on a symmetry plane" : "the one stated last holds, and leaves nothing of the first",
                          "remove one of them, or part their regions or times"});
        return;
      }
    }
  };
  for (std::size_t i = 0; i < model.conditions.size(); ++i) {
    for (std::size_t j = i + 1; j < model.conditions.size(); ++j) compare(i, model.conditions[j]);
  }
}

template <int Dim>
void build_conditions(const Problem& problem, Model<Dim>& model, std::vector<Diagnostic>& errors) {
  std::vector<const Located*> stated;
  for (const BoundaryInput& in : problem.boundaries) {
    VelocityCondition<Dim> c;
    c.name = in.name;
    c.start = in.start;
    c.end = in.end;
    const std::optional<ValueFunction>* components[3] = {&in.vx, &in.vy, &in.vz};
    for (int k = 0; k < Dim; ++k) {
      if (*components[k]) c.components.push_back({k, **components[k]});
    }
    const double slack = 1e-9 * model.grid.smallest_cell();
    Bounds3 box = in.region->bounds();
    for (int k = 0; k < 3; ++k) box.low[k] -= slack, box.high[k] += slack;
    for_nodes(model.grid, box, [&](std::int64_t number, const Vec<Dim>& x) {
      if (in.region->contains(in_space(x), slack)) c.nodes.push_back(number);
    });
    if (c.nodes.empty()) {
      errors.push_back({in.at("region"), fmt::format("no node of the grid lies in the region of \"{}\"", in.name),
                        "the condition would do nothing", "let the region pass through grid lines or enlarge it"});
    }
    model.conditions.push_back(std::move(c));
    stated.push_back(&in);
  }
  for (const SymmetryInput& in : problem.symmetries) {
    SymmetryPlane plane;
    plane.axis = in.axis;
    plane.side = in.side;
    const auto index = std::lround((in.at - model.grid.origin[in.axis]) * model.grid.inverse_cell[in.axis]);
    plane.at = model.grid.node_coordinate(in.axis, static_cast<int>(index));  // the very coordinate of the nodes there
    for (std::size_t k = 0; k < in.from.size(); ++k) plane.from[k] = in.from[k];
    for (std::size_t k = 0; k < in.to.size(); ++k) plane.to[k] = in.to[k];
    VelocityCondition<Dim> c;
    c.name = in.name;
    c.symmetry = true;
    c.end = std::numeric_limits<double>::infinity();
    c.components.push_back({in.axis, ValueFunction()});
    Bounds3 box{{{-1e300, -1e300, -1e300}}, {{1e300, 1e300, 1e300}}};
    box.low[in.axis] = box.high[in.axis] = plane.at;
    for_nodes(model.grid, box, [&](std::int64_t number, const Vec<Dim>& x) {
      if (on_plane<Dim>(plane, x)) c.nodes.push_back(number);
    });
    plane.condition = static_cast<std::uint16_t>(model.conditions.size());
    model.symmetries.push_back(plane);
    model.conditions.push_back(std::move(c));
    stated.push_back(&in);
  }
  check_contradictions(model, stated, errors);
}

CrackTraction build_traction(const Problem& problem, const CrackInput& in, Crack<2>& crack, const Material2D& material, double slack,
                             std::vector<Diagnostic>& errors) {
  CrackTraction out;
  out.law = in.traction;
  if (!out.acts()) return out;
  out.thickness = in.thickness.value_or(problem.bodies.empty() ? 1. : problem.bodies.front().thickness);
  for (const BodyInput& body : problem.bodies) {
    if (in.thickness || body.thickness == out.thickness) continue;
    errors.push_back(
        {in.at("traction"), "the bodies differ in thickness", "it is not clear on which the traction acts", "add thickness to the crack"});
    break;
  }
  std::vector<bool> bears;
  for (const Vec<2>& x : crack.plane) bears.push_back(!in.traction_region || in.traction_region->contains(in_space(x), slack));
  if (std::find(bears.begin(), bears.end(), true) == bears.end()) {
    errors.push_back({in.at("traction_region"), fmt::format("no vertex of the crack \"{}\" lies in the region", in.name),
                      "the traction would act nowhere", "enlarge the region"});
  }
  crack.traction.area = areas_between(crack, bears, material);
  for (double& area : crack.traction.area) area *= out.thickness;
  return out;
}

void build_cracks(const Problem& problem, const BuiltBodies<2>& bodies, BuiltModel<2>& out, std::vector<Diagnostic>& errors) {
  Model<2>& model = out.model;
  const Grid<2>& grid = model.grid;
  const Material2D material(problem, bodies, grid);
  for (const CrackInput& in : problem.cracks) {
    const double longest = in.max_segment.value_or(0.5 * grid.smallest_cell());
    Crack<2> crack;
    crack.name = in.name;
    crack.fixed = in.fixed;
    if (in.arc) {
      const int segments =
          in.arc->segments > 0 ? static_cast<int>(in.arc->segments) : count_arc_segments(in.arc->radius, in.arc->from, in.arc->to, longest);
      crack.plane = divide_arc({{in.arc->centre[0], in.arc->centre[1]}}, in.arc->radius, in.arc->from, in.arc->to, segments);
    } else {
      std::vector<Vec<2>> points;
      for (const auto& p : in.points) points.push_back({{p[0], p[1]}});
      crack.plane = divide_polyline(points, longest);
    }
    for (const Vec<2>& v : crack.plane) {
      if (grid.contains(v)) continue;
      errors.push_back({in.at(in.arc ? "arc" : "points"),
                        fmt::format("the crack \"{}\" reaches out of the grid at ({:.6g}, {:.6g}) m", in.name, v[0], v[1]), "",
                        "enlarge the grid or move the crack"});
      break;
    }
    crack.closed = crack.plane.size() > 3 && crack.plane.front() == crack.plane.back();
    crack.upper = crack.lower = crack.original = crack.plane;
    for (VertexId v = 0; v + 1 < crack.plane.size(); ++v) crack.facets.push_back({v, v + 1});
    model.contact.crack_laws.push_back(in.contact);
    crack.extension = extensions(crack, material);
    crack.mirrored = mirrored_ends(crack, model);
    model.tractions.push_back(build_traction(problem, in, crack, material, 1e-9 * grid.smallest_cell(), errors));
    out.state.observed.cracked.push_back(between_material(crack, material));
    out.state.cracks.list.push_back(std::move(crack));
  }
  for (const NucleationInput& in : problem.nucleations) reserve_cracks(problem, in, model, out.state, errors);
}

template <int Dim>
void place_particles(const BuiltBodies<Dim>& bodies, const Model<Dim>& model, State<Dim>& state) {
  int history = 0;
  for (const auto& m : model.materials) history = std::max(history, m.law->history_size(Dim));
  // One run per material in the order of creation; the first step re-orders them by block.
  std::vector<std::vector<std::uint32_t>> by_material(model.materials.size());
  for (std::size_t i = 0; i < bodies.particles.size(); ++i)
    by_material[bodies.particles[i].material].push_back(static_cast<std::uint32_t>(i));
  std::uint32_t packs = 0;
  for (std::size_t m = 0; m < by_material.size(); ++m) {
    const auto count = static_cast<std::uint32_t>((by_material[m].size() + lanes - 1) / lanes);
    state.order.runs.push_back({packs, packs + count, static_cast<std::uint32_t>(m)});
    packs += count;
  }
  Particles<Dim>& particles = state.particles;
  const bool has_domains = crampon::has_domains(model.shape_functions);
  particles.packs = packs;
  particles.history_size = history;
  particles.remembers_contact = model.contact.remembers_contact();
  particles.has_domains = has_domains;
  particles.keeps_turn = model.fracture.on && std::any_of(model.materials.begin(), model.materials.end(),
                                                          [](const Material<Dim>& m) { return !m.law->follows_deformation(); });
  particles.allocate();
  std::fill(particles.turn.begin(), particles.turn.end(), splat(0.));
  for (std::size_t m = 0; m < by_material.size(); ++m) {
    const Run& run = state.order.runs[m];
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      Pack* law_history = particles.history.data() + k * static_cast<std::size_t>(history);
      for (int c = 0; c < history; ++c) law_history[c] = splat(0.);
      model.materials[m].law->initialise(Dim, &particles.stress[k * stress_size<Dim>], law_history);
      for (int c = 0; has_domains && c < domain_size<Dim>; ++c) {
        const auto axis = static_cast<std::size_t>(c / Dim);
        const bool along = c / Dim == c % Dim;
        particles.domain[k * domain_size<Dim> + static_cast<std::size_t>(c)] =
            splat(along ? model.materials[m].half_size[axis] * model.grid.cell[c / Dim] : 0.);
      }
      for (int l = 0; l < lanes; ++l) {
        const std::size_t slot = k * lanes + l, i = slot - std::size_t{run.first_pack} * lanes;
        const bool real = i < by_material[m].size();
        const NewParticle<Dim>& p = bodies.particles[by_material[m][real ? i : by_material[m].size() - 1]];
        const MaterialField& field = model.contact.fields[model.materials[m].field];
        particles.set_motion(slot, p.x, field.rigid ? state.rigid[static_cast<std::size_t>(field.body)].start.velocity_at(p.x) : p.v);
        particles.mass_volume[2 * k][l] = real ? p.mass : 0.;
        particles.mass_volume[2 * k + 1][l] = real ? p.volume : 0.;
        particles.original[slot] = p.x;
        if (model.contact.remembers_contact()) particles.contact[slot] = 0;
        particles.id[slot] = real ? by_material[m][i] : padding_id;
        particles.body[slot] = p.body;
      }
    }
  }
  state.order.particle_count = bodies.particles.size();
}

}  // namespace

template <int Dim>
BuiltModel<Dim> build_model(const Problem& problem, int threads) {
  BuiltModel<Dim> out;
  Model<Dim>& model = out.model;
  std::vector<Diagnostic> errors;
  model.threads = threads > 0 ? threads : omp_get_num_procs();
  model.grid = build_grid<Dim>(problem.grid);
  model.stress_state = problem.analysis == Analysis::plane_strain   ? StressState::plane_strain
                       : problem.analysis == Analysis::plane_stress ? StressState::plane_stress
                                                                    : StressState::three_dimensional;
  model.stress_update = problem.method.stress_update;
  model.positions = problem.method.positions;
  model.rotation = problem.method.rotation;
  model.shape_functions = problem.method.shape_functions;
  model.crack_shape_functions = problem.method.crack_shape_functions;
  model.boundary_order = problem.method.boundary_order;
  model.fixed_force = problem.method.fixed_force;
  model.leaving_particle = problem.method.leaving_particle;
  model.body_force = problem.method.body_force;
  model.damping = problem.method.damping;
  model.particle_damping = problem.method.particle_damping;
  model.transfer = problem.method.transfer;
  model.damped = model.damping.depends_on_time() || model.damping(0, {}) != 0;
  const ContactInput& contact = problem.contact;
  static_cast<ContactChoices&>(model.contact) = {contact.scheme,           contact.detection,        contact.pairs,
                                                 contact.reference_volume, contact.volume_separated, contact.volume_contact,
                                                 contact.require_approach, contact.mass_screen,      contact.material_detection,
                                                 contact.position_cutoff,  contact.normal,           contact.rigid_bias,
                                                 contact.several_materials};

  BuiltBodies<Dim> bodies = build_bodies<Dim>(problem, model.grid, errors);
  model.materials = std::move(bodies.materials);
  model.contact.fields = std::move(bodies.fields);
  model.rigid_bodies = std::move(bodies.rigid_bodies);
  model.bodies = bodies.names;
  build_conditions(problem, model, errors);
  build_contact(problem, model, out.state, errors);
  if constexpr (Dim == 2) build_cracks(problem, bodies, out, errors);
  if (errors.empty()) build_loads(problem, bodies, out.state.cracks, model, errors);
  if constexpr (Dim == 2) build_fracture(problem, bodies, model, out.state);
  if (!errors.empty()) throw InputError(std::move(errors));
  place_particles(bodies, model, out.state);
  start_face_loads(out.state, out.work, model);
  bear_initial_stress(problem, model, out.state, errors);
  if (!errors.empty()) throw InputError(std::move(errors));
  keep_surfaces(problem, bodies, out.state, model);
  start_tractions(out.state, model);
  return out;
}

template BuiltModel<2> build_model<2>(const Problem&, int);
template BuiltModel<3> build_model<3>(const Problem&, int);

}  // namespace crampon
