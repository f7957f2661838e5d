#include "crampon/input/check_problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/core/units.hpp"
#include "crampon/geometry/arc.hpp"

namespace crampon {
namespace {

// Coordinates that are meant to lie on a grid line or on the grid's edge may miss it by the round-off of their decimal
// numbers; problem.hpp promises 1e-6 of a cell.
constexpr double slack_cells = 1e-6;
// Cell indices are 32-bit in the engine; half of that leaves room for stencils and block margins.
constexpr double most_cells = 1 << 30;

class ProblemChecker {
 public:
  ProblemChecker(const Problem& problem, Diagnostics& diagnostics) : problem_(problem), diagnostics_(diagnostics) {
    for (const Diagnostic& d : diagnostics.list()) broken_.push_back(d.location.where);
  }

  void run() {
    if (broken("analysis")) return;
    if (!broken("grid")) check_grid();
    if (!broken("method")) check_length(problem_.method, "body_force", problem_.method.body_force.size());
    if (!broken("method") && !broken("time")) {
      check_damping("damping", problem_.method.damping);
      check_damping("particle_damping", problem_.method.particle_damping);
    }
    if (!broken("method")) check_transfer(), check_domains();
    for (const BodyInput& body : problem_.bodies) check_body(body);
    for (const RigidInput& rigid : problem_.rigids) check_rigid(rigid);
    for (const WallInput& wall : problem_.walls) check_wall(wall);
    for (const ContactPairInput& pair : problem_.contact_pairs) {
      if (!broken(pair)) check_length(pair, "normal", pair.normal.size());
    }
    check_names();
    for (const CrackInput& crack : problem_.cracks) check_crack(crack);
    for (const NucleationInput& nucleation : problem_.nucleations) check_nucleation(nucleation);
    for (const BoundaryInput& boundary : problem_.boundaries) check_boundary(boundary);
    for (const SymmetryInput& symmetry : problem_.symmetries) check_symmetry(symmetry);
    for (const LoadInput& load : problem_.loads) check_load(load);
    for (const ProbeInput& probe : problem_.probes) check_probe(probe);
    if (!broken("output") && !broken("time")) check_output();
    for (const ExpectInput& expect : problem_.expects) check_expect(expect);
  }

 private:
  const Problem& problem_;
  Diagnostics& diagnostics_;
  std::vector<std::string> broken_;  // where earlier errors stand
  bool grid_known_ = false;

  bool broken(const std::string& where) const {
    return std::any_of(broken_.begin(), broken_.end(), [&](const std::string& b) {
      return b.starts_with(where) && (b.size() == where.size() || b[where.size()] == '.' || b[where.size()] == '[');
    });
  }
  bool broken(const Located& record) const { return broken(record.location.where); }
  std::size_t dimension() const { return static_cast<std::size_t>(problem_.dimension()); }
  std::string words() const { return fmt::format("the problem has {} dimensions", dimension()); }

  void add(const Located& record, const std::string& key, std::string what, std::string why, std::string remedy) {
    diagnostics_.add(record.at(key), std::move(what), std::move(why), std::move(remedy));
  }

  // A list with one value per dimension, or empty.
  bool check_length(const Located& record, const std::string& key, std::size_t length) {
    if (length == 0 || length == dimension()) return true;
    add(record, key, fmt::format("{} values", length), words(), fmt::format("give {}", dimension()));
    return false;
  }

  double cell(std::size_t axis) const { return problem_.grid.cell[problem_.grid.cell.size() == 1 ? 0 : axis]; }
  double slack(std::size_t axis) const { return slack_cells * cell(axis); }

  void check_grid() {
    const GridInput& g = problem_.grid;
    if (g.origin.empty() || g.size.empty() || g.cell.empty()) return;  // [grid] is missing: told already
    const bool origin = check_length(g, "origin", g.origin.size()), size = check_length(g, "size", g.size.size());
    const bool cells = g.cell.size() == 1 || check_length(g, "cell", g.cell.size());
    if (!origin || !size || !cells) return;
    grid_known_ = true;
    for (std::size_t k = 0; k < dimension(); ++k) {
      const double count = g.size[k] / cell(k);
      const std::string key = fmt::format("size[{}]", k);
      if (count > most_cells) {
        add(g, key, fmt::format("{:.3g} cells along {}", count, "xyz"[k]), "no more than 2^30 can be counted", "use a larger cell");
        grid_known_ = false;
      } else if (std::abs(count - std::round(count)) > slack_cells || std::round(count) < 1) {
        add(g, key, fmt::format("the size along {} is {:.9g} cells", "xyz"[k], count), "it must be a whole number of cells",
            fmt::format("make it {:.9g} m", std::max(1., std::round(count)) * cell(k)));
      }
    }
  }

  bool in_grid(const std::vector<double>& x) const {
    for (std::size_t k = 0; k < dimension(); ++k)
      if (x[k] < problem_.grid.origin[k] - slack(k) || x[k] > problem_.grid.origin[k] + problem_.grid.size[k] + slack(k)) return false;
    return true;
  }
  std::string grid_text() const {
    std::string out = "the grid reaches from (";
    for (std::size_t k = 0; k < dimension(); ++k) out += fmt::format("{}{:g}", k ? ", " : "", problem_.grid.origin[k]);
    out += ") to (";
    for (std::size_t k = 0; k < dimension(); ++k)
      out += fmt::format("{}{:g}", k ? ", " : "", problem_.grid.origin[k] + problem_.grid.size[k]);
    return out + ") m";
  }

  template <class Named>
  void check_reference(const Located& record, const std::string& key, const std::string& name, const std::vector<Named>& list,
                       const std::string& kind) {
    std::vector<std::string> names;
    for (const Named& item : list) names.push_back(item.name);
    if (name.empty() || list.empty() || std::find(names.begin(), names.end(), name) != names.end()) return;
    // A name that could not be read may be the one that is meant.
    for (std::size_t k = 0; k < list.size(); ++k)
      if (broken(fmt::format("{}[{}].name", kind, k)) || broken(list[k].location.where + ".name") || names[k].empty()) return;
    add(record, key, fmt::format("there is no {} \"{}\"", kind, name), fmt::format("it is the name of a [[{}]]", kind),
        suggest_from(name, names));
  }

  /// Particles that a series moves must be strained by the same velocities (docs/theory/step.md, positions and transfers).
  void check_transfer() {
    const MethodInput& method = problem_.method;
    if (std::holds_alternative<FlipTransfer>(method.transfer)) return;
    if (method.positions == PositionUpdate::n03)
      add(method, "positions", "positions by N03 Eq. 30 with a series for velocities",
          "Eq. 30 moves particles with a velocity that does not strain them", "leave positions out, or use transfer = \"flip\"");
  }

  /// Domains go with the nodes, and so must their particles.
  void check_domains() {
    const MethodInput& method = problem_.method;
    if (has_domains(method.shape_functions) && method.positions == PositionUpdate::n03)
      add(method, "positions", "positions by N03 Eq. 30 with domains that stretch",
          "Eq. 30 moves particles with a velocity that does not strain them", "leave positions out, or use shape_functions = \"gimp\"");
  }

  // At a thousand times, when it varies; what falls between them stops the run (step/verbs/check_prescribed.cpp).
  void check_damping(const char* key, const ValueFunction& damping) {
    const double end = problem_.time.end.value_or(1);
    constexpr int samples = 1000;
    for (int k = 0; k <= (damping.depends_on_time() ? samples : 0); ++k) {
      const double t = end * k / samples, value = damping(t, {});
      if (!(value < 0)) continue;
      const std::string when = damping.depends_on_time() ? fmt::format(" at t = {:.4g} s", t) : "";
      add(problem_.method, key, fmt::format("the damping is {:.4g} 1/s{}", value, when),
          "below zero it drives the motion that it is to take from", "make it zero or more");
      return;
    }
  }

  void check_shape(const Located& record, const std::string& key, const RegionPtr& shape) {
    if (!shape || shape->dimension() == 0 || shape->dimension() == problem_.dimension()) return;
    if (shape->dimension() == 3) add(record, key, "a shape in space", words(), "use a plane shape");
  }

  void check_body(const BodyInput& body) {
    check_reference(body, "material", body.material, problem_.materials, "material");
    if (broken(body)) return;
    check_shape(body, "shape", body.shape);
    check_in_grid(body);
    check_length(body, "velocity", body.velocity.size());
    check_length(body, "spin_centre", body.spin_centre.size());
    check_spin(body, body.spin.size());
    check_initial_stress(body);
    if (body.particles_per_cell.size() > 1) check_length(body, "particles_per_cell", body.particles_per_cell.size());
    if (dimension() == 3 && body.thickness != 1) add(body, "thickness", "a body in space has no thickness", words(), "remove thickness");
  }

  void check_initial_stress(const BodyInput& body) {
    if (const auto* stress = std::get_if<ComponentStress>(&body.initial_stress)) {
      const std::pair<const char*, const std::optional<ValueFunction>*> in_space[] = {
          {"zz", &stress->zz}, {"yz", &stress->yz}, {"xz", &stress->xz}};
      for (const auto& [key, value] : in_space) {
        if (dimension() == 2 && *value)
          add(body, "initial_stress", fmt::format("the component {}", key), words() + "; stress across the plane follows from the law",
              "remove it");
      }
      const std::pair<const char*, const ValueFunction*> all[] = {{"xx", &stress->xx}, {"yy", &stress->yy}, {"xy", &stress->xy}};
      for (const auto& [key, value] : all) {
        if (value->depends_on_time())
          add(body, "initial_stress", "the initial stress depends on the time", "it holds at the start only", "use x, y and z");
      }
    }
    if (const auto* stress = std::get_if<GravityStress>(&body.initial_stress)) {
      check_length(body, "initial_stress", stress->surface.size());
      double size = 0;
      for (const ValueFunction& g : problem_.method.body_force) size += std::fabs(g(0, {}));
      if (!(size > 0) && !broken("method"))
        add(body, "initial_stress", "a stress by gravity without a body force at the start", "there is no weight to bear",
            "give method.body_force a value at t = 0, or use kind = \"components\"");
    }
  }

  void check_spin(const Located& record, std::size_t length) {
    const std::size_t turns = dimension() == 2 ? 1 : 3;
    if (length != 0 && length != turns) add(record, "spin", fmt::format("{} values", length), words(), fmt::format("give {}", turns));
  }

  void check_rigid(const RigidInput& rigid) {
    if (broken(rigid)) return;
    check_shape(rigid, "shape", rigid.shape);
    check_in_grid(rigid);
    check_length(rigid, "velocity", rigid.velocity.size());
    check_spin(rigid, rigid.spin.size());
    check_length(rigid, "spin_centre", rigid.spin_centre.size());
    if (rigid.particles_per_cell.size() > 1) check_length(rigid, "particles_per_cell", rigid.particles_per_cell.size());
    if (dimension() == 3 && rigid.thickness != 1) add(rigid, "thickness", "a body in space has no thickness", words(), "remove thickness");
    for (std::size_t k = 0; k < rigid.components.size(); ++k)
      if (dimension() == 2 && rigid.components[k] == "z")
        add(rigid, fmt::format("components[{}]", k), "the component z", words(), "remove it");
  }

  void check_wall(const WallInput& wall) {
    if (broken(wall)) return;
    check_length(wall, "point", wall.point.size());
    check_length(wall, "normal", wall.normal.size());
    check_length(wall, "centre", wall.centre.size());
    check_length(wall, "velocity", wall.velocity.size());
    check_spin(wall, wall.spin.size());
  }

  // Rigid bodies and walls are called by name in contact pairs, as bodies are, and in reaction columns, as conditions are.
  void check_names() {
    std::map<std::string, std::string> known;
    const auto check = [&](const Located& record, const std::string& name, const char* kind) {
      if (name.empty() || broken(record)) return;
      const auto [at, is_new] = known.try_emplace(name, kind);
      if (!is_new && at->second != kind)
        add(record, "name", fmt::format("the name \"{}\" is taken", name), fmt::format("a [[{}]] has it", at->second), "choose another");
    };
    for (const BodyInput& body : problem_.bodies) known.try_emplace(body.name, "body");
    for (const BoundaryInput& boundary : problem_.boundaries) known.try_emplace(boundary.name, "boundary");
    for (const SymmetryInput& symmetry : problem_.symmetries) known.try_emplace(symmetry.name, "symmetry");
    for (const RigidInput& rigid : problem_.rigids) check(rigid, rigid.name, "rigid");
    for (const WallInput& wall : problem_.walls) check(wall, wall.name, "wall");
  }

  // A finite shape that reaches out of the grid would be cut off silently.
  template <class Body>
  void check_in_grid(const Body& body) {
    if (!grid_known_ || !body.shape || (body.shape->dimension() != 0 && body.shape->dimension() != problem_.dimension())) return;
    const Bounds3 box = body.shape->bounds();
    for (std::size_t k = 0; k < dimension(); ++k) {
      const double low = problem_.grid.origin[k], high = low + problem_.grid.size[k];
      const bool below = std::isfinite(box.low[k]) && box.low[k] < low - slack(k),
                 above = std::isfinite(box.high[k]) && box.high[k] > high + slack(k);
      if (!below && !above) continue;
      add(body, "shape", fmt::format("the body \"{}\" reaches out of the grid", body.name),
          fmt::format("along {} it spans {:.6g} to {:.6g} m, the grid {:.6g} to {:.6g} m", "xyz"[k], box.low[k], box.high[k], low, high),
          "enlarge the grid or move the body");
      return;
    }
  }

  void check_crack(const CrackInput& crack) {
    if (broken(crack)) return;
    if (dimension() == 3) {
      add(crack, "", "a crack in three dimensions", "cracks are lines in the plane", "remove it, or choose a plane analysis");
      return;
    }
    if (!grid_known_) return;
    if (crack.growth && !problem_.fracture)
      add(crack, "growth", fmt::format("the crack \"{}\" grows, but there is no [fracture]", crack.name),
          "growth follows from J and stress intensities, which [fracture] turns on", "add [fracture]");
    check_segments(crack);
    for (std::size_t k = 0; k < crack.points.size(); ++k)
      if (!in_grid(crack.points[k]))
        add(crack, fmt::format("points[{}]", k),
            fmt::format("the point ({:g}, {:g}) m is outside the grid", crack.points[k][0], crack.points[k][1]), grid_text(),
            "move the point or enlarge the grid");
    if (crack.arc) check_arc(*crack.arc);
  }

  void check_nucleation(const NucleationInput& nucleation) {
    for (std::size_t k = 0; k < nucleation.materials.size(); ++k)
      check_reference(nucleation, fmt::format("materials[{}]", k), nucleation.materials[k], problem_.materials, "material");
    if (broken(nucleation)) return;
    if (dimension() == 3) {
      add(nucleation, "", "cracks that start in three dimensions", "cracks are lines in the plane",
          "remove it, or choose a plane analysis");
      return;
    }
    check_shape(nucleation, "region", nucleation.region);
    if (!problem_.fracture)
      add(nucleation, "", fmt::format("the nucleation \"{}\" makes cracks, but there is no [fracture]", nucleation.name),
          "what tips are and whether they grow follows from [fracture]", "add [fracture]");
    if (!broken("time") && problem_.time.end && nucleation.start >= *problem_.time.end)
      add(nucleation, "start", fmt::format("cracks may start from {:g} s on", nucleation.start),
          fmt::format("the run ends at {:g} s", *problem_.time.end), "let them start earlier");
  }

  // Segments far below a cell show nothing that nodes can tell apart, and each costs time in every step.
  void check_segments(const CrackInput& crack) {
    constexpr double least_cells = 0.01;
    const double least = least_cells * std::min(cell(0), cell(1));
    if (crack.max_segment && *crack.max_segment < least)
      add(crack, "max_segment", fmt::format("{:g} m is less than a hundredth of a cell", *crack.max_segment),
          "so many segments cost time in every step and add nothing", fmt::format("make it {:g} m or more", least));
    if (crack.arc && crack.arc->segments > 0 &&
        crack.arc->radius * std::abs(crack.arc->to - crack.arc->from) < least * static_cast<double>(crack.arc->segments))
      add(*crack.arc, "segments", fmt::format("{} segments are shorter than a hundredth of a cell", crack.arc->segments),
          "so many cost time in every step and add nothing", "use fewer, or leave segments out");
  }

  void check_arc(const ArcInput& arc) {
    const Vec<2> centre{{arc.centre[0], arc.centre[1]}};
    // Degrees: fine enough to see what leaves the grid, independent of the segments chosen later.
    for (const Vec<2>& x : divide_arc(centre, arc.radius, arc.from, arc.to, 360))
      if (!in_grid({x[0], x[1]})) {
        add(arc, "", fmt::format("the arc leaves the grid at ({:g}, {:g}) m", x[0], x[1]), grid_text(), "move the arc or enlarge the grid");
        return;
      }
  }

  void check_boundary(const BoundaryInput& boundary) {
    if (broken(boundary)) return;
    check_shape(boundary, "region", boundary.region);
    if (!broken("time") && problem_.time.end && boundary.start >= *problem_.time.end)
      add(boundary, "start", fmt::format("the condition starts at {:g} s", boundary.start),
          fmt::format("the run ends at {:g} s", *problem_.time.end), "start it earlier");
    if (dimension() == 2 && boundary.vz) add(boundary, "vz", "vz is given", words(), "remove it");
  }

  void check_symmetry(const SymmetryInput& symmetry) {
    if (broken(symmetry)) return;
    const std::size_t axis = static_cast<std::size_t>(symmetry.axis);
    if (axis >= dimension()) {
      add(symmetry, "axis", "a plane normal to z", words(), "choose x or y");
      return;
    }
    const bool from = check_length(symmetry, "from", symmetry.from.size()), to = check_length(symmetry, "to", symmetry.to.size());
    if (from && to && !symmetry.from.empty() && !symmetry.to.empty())
      for (std::size_t k = 0; k < dimension(); ++k)
        if (k != axis && !(symmetry.to[k] > symmetry.from[k]))
          add(symmetry, fmt::format("to[{}]", k), fmt::format("the part is empty along {}", "xyz"[k]),
              fmt::format("from {:g} m to {:g} m", symmetry.from[k], symmetry.to[k]), "correct from and to");
    if (!grid_known_) return;
    const double lines = (symmetry.at - problem_.grid.origin[axis]) / cell(axis), last = problem_.grid.size[axis] / cell(axis);
    if (lines < -slack_cells || lines > last + slack_cells) {
      add(symmetry, "at", fmt::format("the plane at {:g} m is outside the grid", symmetry.at), grid_text(),
          "move the plane or enlarge the grid");
    } else if (std::abs(lines - std::round(lines)) > slack_cells) {
      add(symmetry, "at", fmt::format("the plane at {:.9g} m is on no grid line", symmetry.at), "a mirror plane is made of nodes",
          fmt::format("the nearest one is at {:.9g} m", problem_.grid.origin[axis] + std::round(lines) * cell(axis)));
    }
  }

  void check_load(const LoadInput& load) {
    check_reference(load, "body", load.body, problem_.bodies, "body");
    if (broken(load)) return;
    check_shape(load, "region", load.region);
    if (load.kind == LoadInput::Kind::pressure) {
      if (load.value.size() != 1)
        add(load, "value", fmt::format("{} values", load.value.size()), "pressure acts along the normal of the face", "give one");
    } else {
      check_length(load, "value", load.value.size());
    }
    if (dimension() == 2 && load.face && load.face->front() == 'z')
      add(load, "face", "a face normal to z", words(), "choose a face normal to x or y");
  }

  void check_point(const Located& record, const std::vector<double>& point) {
    if (point.empty() || !check_length(record, "point", point.size()) || !grid_known_ || in_grid(point)) return;
    add(record, "point", "the point is outside the grid", grid_text(), "move the point");
  }

  void check_probe(const ProbeInput& probe) {
    check_reference(probe, "body", probe.body, problem_.bodies, "body");
    if (!broken(probe)) check_point(probe, probe.point);
  }

  // A time beyond the end of the run, where that is known.
  void check_time(const Located& record, const std::string& key, double time) {
    const auto& end = problem_.time.end;
    if (end && time > *end * (1 + 1e-12))  // decimal round-off of equal times in different units
      add(record, key, fmt::format("{:g} s is after the end of the run", time), fmt::format("it ends at {:g} s", *end), "correct the time");
  }

  void check_output() {
    const OutputInput& output = problem_.output;
    for (std::size_t k = 0; k < output.times.size(); ++k) check_time(output, fmt::format("times[{}]", k), output.times[k]);
  }

  void check_expect(const ExpectInput& expect) {
    if (broken(expect)) return;
    check_point(expect, expect.point);
    if (!expect.unit.empty()) {
      try {
        unit_factor(expect.unit, "any");
      } catch (const UnitError& error) {
        add(expect, "unit", error.what, "it is printed beside the value", "correct the unit");
      }
    }
    if (broken("time")) return;
    if (expect.time) check_time(expect, "time", *expect.time);
    for (std::size_t k = 0; k < expect.range.size(); ++k) check_time(expect, fmt::format("range[{}]", k), expect.range[k]);
  }
};

}  // namespace

void check_problem(const Problem& problem, Diagnostics& diagnostics) { ProblemChecker(problem, diagnostics).run(); }

}  // namespace crampon
