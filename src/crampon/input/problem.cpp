#include "crampon/input/problem.hpp"

#include <cmath>

#include <fmt/format.h>

#include "crampon/geometry/shapes.hpp"
#include "crampon/input/contact_tables.hpp"
#include "crampon/input/crack_tables.hpp"

namespace crampon {
namespace {

constexpr Presence required = Presence::required;
const Length up_to_three = Length::between(1, 3), two_or_three = Length::between(2, 3);

std::vector<std::pair<std::string, ShapeFunctionKind>> words_of_shape_functions() {
  std::vector<std::pair<std::string, ShapeFunctionKind>> words;
  for_each_shape([&]<class Shape>(std::type_identity<Shape>) { words.emplace_back(Shape::name, kind_of<Shape>); });
  return words;
}
std::string help_of_shape_functions() {
  std::string help = "functions by which particles and nodes exchange";
  for_each_shape([&]<class Shape>(std::type_identity<Shape>) {
    help += fmt::format("{} `{}`: {}", kind_of<Shape> == ShapeFunctionKind{} ? ":" : ";", Shape::name, Shape::help);
  });
  return help;
}

const Declaration<GridInput>& grid_declaration() {
  static const auto d =
      Declaration<GridInput>("grid", "The background grid: a uniform Cartesian box that must hold all particles and cracks.")
          .quantities("origin", &GridInput::origin, "m", Bounds::any(), "lowest corner, one coordinate per dimension", required,
                      two_or_three)
          .quantities("size", &GridInput::size, "m", Bounds::positive(), "extent along each axis; a whole number of cells", required,
                      two_or_three)
          .quantities("cell", &GridInput::cell, "m", Bounds::positive(), "cell size; one for all axes or one per axis", required,
                      up_to_three);
  return d;
}

const Declaration<RestInput>& rest_declaration() {
  static const auto d =
      Declaration<RestInput>("stop_at_rest", "When a run that looks for a state of rest may end.")
          .quantity("ratio", &RestInput::ratio, "1", Bounds::from_above(0, 1),
                    "kinetic over strain energy, which is looked at twenty times in a period")
          .quantity("period", &RestInput::period, "s", Bounds::positive(),
                    "time for which the ratio must stay below; longer than the slowest vibration, which passes through small ratios",
                    required);
  return d;
}

const Declaration<TimeInput>& time_declaration() {
  static const auto d =
      Declaration<TimeInput>("time", "How far to compute, and in what steps. Give exactly one of end and steps.")
          .quantity("end", &TimeInput::end, "s", Bounds::positive(), "time at which the run ends")
          .integer("steps", &TimeInput::steps, Bounds::at_least(1), "number of time steps after which the run ends")
          .excludes({"end"})
          .quantity("step", &TimeInput::step, "s", Bounds::positive(), "fixed time step; without it the step follows from courant")
          .quantity("courant", &TimeInput::courant, "1", Bounds::from_above(0, 1),
                    "time step over the time a wave needs to cross a cell, the smallest over materials and axes")
          .excludes({"step"})
          .record("stop_at_rest", &TimeInput::stop_at_rest, rest_declaration, "end before that as soon as all has come to rest")
          .check([](const TimeInput& in, Diagnostics& diagnostics) {
            if (!in.end && !in.steps)
              diagnostics.add("", "neither end nor steps is given", "the run would have no end", "add end or steps");
            if (in.step && in.end && *in.step > *in.end)
              diagnostics.add("step", "the time step is longer than the run", fmt::format("{} s > {} s", *in.step, *in.end), "reduce step");
          });
  return d;
}

const Declaration<MethodInput>& method_declaration() {
  static const auto d =
      Declaration<MethodInput>("method", "Choices of the algorithm.")
          .choice("stress_update", &MethodInput::stress_update,
                  {{"usl", StressUpdate::usl}, {"musl", StressUpdate::musl}, {"usf", StressUpdate::usf}, {"usavg", StressUpdate::usavg}},
                  "when stress is updated: last, last after a second extrapolation, first, or half first and half last")
          .choice("positions", &MethodInput::positions, {{"strain", PositionUpdate::strain}, {"n03", PositionUpdate::n03}},
                  "particles move with the velocity that strains them, or with that of N03 Eq. 30, which tears bodies in tension")
          .choice("rotation", &MethodInput::rotation, {{"carried", RotationTransfer::carried}, {"n03", RotationTransfer::n03}},
                  "momenta of nodes carry the rotation of bodies, which then keep their angular momentum, or are those of N03 Eq. 26")
          .choice("shape_functions", &MethodInput::shape_functions, words_of_shape_functions(), help_of_shape_functions())
          .choice("crack_shape_functions", &MethodInput::crack_shape_functions,
                  {{"linear", CrackShapeFunctions::linear}, {"same", CrackShapeFunctions::same}},
                  "by what crack points are moved: linear functions, or B-splines where particles have them")
          .function("damping", &MethodInput::damping, "1/s", "damping kappa (N03 Eq. 4): a force -kappa m v; may vary in time")
          .function("particle_damping", &MethodInput::particle_damping, "1/s",
                    "damping of the particles' own velocities, which also reaches what nodes do not see; may vary in time")
          .one_of("transfer", &MethodInput::transfer, transfers, "how particles take up what nodes have found; left out: FLIP")
          .function("body_force", &MethodInput::body_force, "m/s2", "acceleration, one per dimension; may vary in time", Presence::optional,
                    two_or_three)
          .choice("boundary_order", &MethodInput::boundary_order,
                  {{"contact_first", BoundaryOrder::contact_first}, {"boundary_first", BoundaryOrder::boundary_first}},
                  "contact before boundary conditions (N13) or after them (N03)")
          .choice("fixed_force", &MethodInput::fixed_force,
                  {{"incremental", FixedForce::incremental}, {"n13", FixedForce::n13}, {"zero", FixedForce::zero}},
                  "force on fixed components: consistent increments, N13 Eq. 1, or none (N03)")
          .choice("leaving_particle", &MethodInput::leaving_particle,
                  {{"error", LeavingParticle::error}, {"remove", LeavingParticle::remove}},
                  "what happens to a particle that leaves the grid")
          .check([](const MethodInput& in, Diagnostics& diagnostics) {
            if (in.damping.depends_on_position())
              diagnostics.add("damping", "damping depends on the position", "it is the same everywhere", "use t alone");
            if (in.particle_damping.depends_on_position())
              diagnostics.add("particle_damping", "damping depends on the position", "it is the same everywhere", "use t alone");
            for (std::size_t k = 0; k < in.body_force.size(); ++k)
              if (in.body_force[k].depends_on_position())
                diagnostics.add(fmt::format("body_force[{}]", k), "the body force depends on the position", "it is the same everywhere",
                                "use t alone");
          });
  return d;
}

const Declaration<MaterialInput>& material_declaration() {
  static const auto d = Declaration<MaterialInput>("material", "A named constitutive law; its parameters stand beside the law.")
                            .name("name", &MaterialInput::name, "what bodies call it", required)
                            .inline_one_of("law", &MaterialInput::law, materials, "the constitutive law");
  return d;
}

const Family<InitialStressInput>& initial_stresses() {
  static const auto none = Declaration<NoInitialStress>("none", "The body starts without stress.");
  static const auto components =
      Declaration<ComponentStress>("components",
                                   "Cauchy stress by components, each a number or an expression of x, y, z; those left out are zero.")
          .function("xx", &ComponentStress::xx, "Pa", "normal stress along x; tension is positive")
          .function("yy", &ComponentStress::yy, "Pa", "normal stress along y")
          .function("zz", &ComponentStress::zz, "Pa", "normal stress along z (3D; in 2D it follows from the law)")
          .function("xy", &ComponentStress::xy, "Pa", "shear stress")
          .function("yz", &ComponentStress::yz, "Pa", "shear stress (3D)")
          .function("xz", &ComponentStress::xz, "Pa", "shear stress (3D)");
  static const auto gravity =
      Declaration<GravityStress>(
          "gravity", "The stress of ground at rest: the weight above, density times body_force times depth, and a part of it sideways.")
          .quantities("surface", &GravityStress::surface, "m", Bounds::any(),
                      "a point of the free surface, which lies across the body force", required, two_or_three)
          .quantity("lateral", &GravityStress::lateral, "1", Bounds::at_least(0),
                    "stress across the body force over that along it; nu/(1 - nu) where the body cannot spread", required);
  static Family<InitialStressInput> family = [] {
    Family<InitialStressInput> f("initial_stress", "kind", "Stress that a body bears from the start.");
    f.add(none).add(components).add(gravity);
    return f;
  }();
  return family;
}

const Declaration<BodyInput>& body_declaration() {
  static const auto d =
      Declaration<BodyInput>("body", "A shape filled with particles, or particles from a file.")
          .name("name", &BodyInput::name, "what loads, probes and output call it", required)
          .text("material", &BodyInput::material, "name of a [[material]]", required)
          .text("field", &BodyInput::field,
                "velocity field: bodies of one name here move as one and meet those of other names; left out: by contact.fields")
          .flag("ignores_cracks", &BodyInput::ignores_cracks,
                "cracks run beside it, not through it: it moves as one and meets the bodies on both of their sides")
          .one_of("shape", &BodyInput::shape, shapes, "the space to fill with particles; either shape or particles")
          .file("particles", &BodyInput::particles,
                "CSV file with the columns x, y[, z], volume[, vx, vy[, vz]] in SI, used exactly as written")
          .excludes({"shape"})
          .integers("particles_per_cell", &BodyInput::particles_per_cell, Bounds::between(1, 64),
                    "particles per cell in each direction; one for all axes or one per axis; also the size of uGIMP particles",
                    Presence::optional, up_to_three)
          .flag("match_mass", &BodyInput::match_mass,
                "each particle has the measure and the middle of the part of the shape that it stands for, or, left out or false, "
                "those of its whole sub-cell")
          .quantity("thickness", &BodyInput::thickness, "m", Bounds::positive(), "extent out of the plane (2D)")
          .function("velocity", &BodyInput::velocity, "m/s", "initial velocity, one per dimension; may depend on x, y, z",
                    Presence::optional, two_or_three)
          .quantities("spin", &BodyInput::spin, "rad/s", Bounds::any(), "initial angular velocity: one number in 2D, three in 3D",
                      Presence::optional, up_to_three)
          .quantities("spin_centre", &BodyInput::spin_centre, "m", Bounds::any(),
                      "point the spin turns about; left out: the centre of mass", Presence::optional, two_or_three)
          .one_of("initial_stress", &BodyInput::initial_stress, initial_stresses,
                  "stress from the start, held by an elastic strain; the body's shape, density and positions are those under stress")
          .check([](const BodyInput& in, Diagnostics& diagnostics) {
            if (!in.shape && !in.particles)
              diagnostics.add("", "neither shape nor particles is given", "the body would be empty", "add shape = { kind = ... }");
            if (in.match_mass && in.particles)
              diagnostics.add("match_mass", "match_mass needs a shape", "particles from a file are used exactly as written",
                              "remove match_mass");
            if (!in.spin_centre.empty() && in.spin.empty())
              diagnostics.add("spin_centre", "spin_centre without spin", "there is nothing to turn", "add spin or remove spin_centre");
            for (std::size_t k = 0; k < in.velocity.size(); ++k)
              if (in.velocity[k].depends_on_time())
                diagnostics.add(fmt::format("velocity[{}]", k), "the initial velocity depends on the time", "it holds at the start only",
                                "use x, y and z; prescribe motion by a [[boundary]]");
          });
  return d;
}

const Declaration<BoundaryInput>& boundary_declaration() {
  static const auto d =
      Declaration<BoundaryInput>("boundary", "Velocity prescribed on the grid nodes in a region; a component left out is free.")
          .name("name", &BoundaryInput::name, "what the reaction columns call it")
          .one_of("region", &BoundaryInput::region, shapes, "nodes in this region or on its edge", required)
          .function("vx", &BoundaryInput::vx, "m/s", "x velocity")
          .function("vy", &BoundaryInput::vy, "m/s", "y velocity")
          .function("vz", &BoundaryInput::vz, "m/s", "z velocity (3D)")
          .quantity("start", &BoundaryInput::start, "s", Bounds::any(), "from this time on")
          .quantity("end", &BoundaryInput::end, "s", Bounds::any_or_infinite(), "until this time; inf: to the end of the run")
          .check([](const BoundaryInput& in, Diagnostics& diagnostics) {
            if (!in.vx && !in.vy && !in.vz)
              diagnostics.add("", "no velocity is given", "the boundary would do nothing", "add vx, vy or vz");
            if (!(in.end > in.start))
              diagnostics.add("end", "end is not after start", fmt::format("{} s and {} s", in.start, in.end), "correct the times");
          });
  return d;
}

const Declaration<SymmetryInput>& symmetry_declaration() {
  static const auto d =
      Declaration<SymmetryInput>("symmetry", "A mirror plane on a grid line: no motion through it, no shear on it.")
          .name("name", &SymmetryInput::name, "what the reaction columns call it")
          .choice("axis", &SymmetryInput::axis, {{"x", 0}, {"y", 1}, {"z", 2}}, "normal of the plane", required)
          .quantity("at", &SymmetryInput::at, "m", Bounds::any(), "coordinate of the plane; on a grid line", required)
          .choice("side", &SymmetryInput::side, {{"above", 1}, {"below", -1}}, "whether the body lies at larger or smaller coordinates")
          .quantities("from", &SymmetryInput::from, "m", Bounds::any_or_infinite(),
                      "lowest corner of the part that is a mirror, one coordinate per dimension (that of axis is ignored); -inf: unbounded",
                      Presence::optional, two_or_three)
          .quantities("to", &SymmetryInput::to, "m", Bounds::any_or_infinite(), "highest corner of that part; inf: unbounded",
                      Presence::optional, two_or_three);
  return d;
}

const Declaration<LoadInput>& load_declaration() {
  using Kind = LoadInput::Kind;
  static const auto d =
      Declaration<LoadInput>("load", "Forces on particles, or stress on faces of bodies.")
          .name("name", &LoadInput::name, "what output calls it")
          .choice("kind", &LoadInput::kind,
                  {{"total_force", Kind::total_force},
                   {"force_each", Kind::force_each},
                   {"traction", Kind::traction},
                   {"pressure", Kind::pressure}},
                  "a force shared by the particles, a force on each of them, or stress on a face: traction per area as it was at the "
                  "start, in a fixed "
                  "direction; pressure per area as it is, against the normal as it is",
                  required)
          .text("body", &LoadInput::body, "only particles of this body; empty: all")
          .one_of("region", &LoadInput::region, shapes,
                  "only particles that start in this region; traction and pressure: their outer faces")
          .function("value", &LoadInput::value, "N", "one per dimension; pressure: one; may vary in time", required, up_to_three)
          .unit_by("kind", {{"total_force", "N"}, {"force_each", "N"}, {"traction", "Pa"}, {"pressure", "Pa"}})
          .choice("face", &LoadInput::face, {{"x-", "x-"}, {"x+", "x+"}, {"y-", "y-"}, {"y+", "y+"}, {"z-", "z-"}, {"z+", "z+"}},
                  "traction and pressure: the part of the body's boundary that looks that way, with nothing of the body in front of it; "
                  "left out: all "
                  "of the boundary (in the region)")
          .check([](const LoadInput& in, Diagnostics& diagnostics) {
            const bool on_face = in.kind == Kind::traction || in.kind == Kind::pressure;
            if (!on_face && in.face)
              diagnostics.add("face", "face is given for a force", "forces act on particles, not on a face",
                              "remove face, or use traction");
            for (std::size_t k = 0; k < in.value.size(); ++k)
              if (in.value[k].depends_on_position())
                diagnostics.add(fmt::format("value[{}]", k), "the load depends on the position", "it may vary in time only", "use t alone");
          });
  return d;
}

const Declaration<ProbeInput>& probe_declaration() {
  static const auto d =
      Declaration<ProbeInput>("probe", "History columns of the particle that is nearest to a point at the start.")
          .name("name", &ProbeInput::name, "what the columns are called")
          .text("quantity", &ProbeInput::quantity, "particle quantity, as in the output", required)
          .words_from("particle quantities")
          .quantities("point", &ProbeInput::point, "m", Bounds::any(), "where the particle is sought", required, two_or_three)
          .text("body", &ProbeInput::body, "only particles of this body; empty: all");
  return d;
}

const Declaration<OutputInput>& output_declaration() {
  static const auto d = Declaration<OutputInput>("output", "What is written, and when. The first and the last state always are.")
                            .quantity("every", &OutputInput::every, "s", Bounds::positive(), "time between frames")
                            .integer("every_steps", &OutputInput::every_steps, Bounds::at_least(1), "steps between frames")
                            .excludes({"every"})
                            .quantities("times", &OutputInput::times, "s", Bounds::non_negative(), "times of further frames, hit exactly")
                            .quantity("history_every", &OutputInput::history_every, "s", Bounds::positive(),
                                      "time between history rows; left out: at most 1000 rows")
                            .integer("history_steps", &OutputInput::history_steps, Bounds::at_least(1), "steps between history rows")
                            .excludes({"history_every"})
                            .text("quantities", &OutputInput::quantities, "particle quantities to write; left out: the common ones")
                            .words_from("particle quantities")
                            .flag("full_precision", &OutputInput::full_precision, "64-bit instead of 32-bit numbers")
                            .flag("grid", &OutputInput::grid, "also write the nodes with mass, momentum and force of each velocity field")
                            .check([](const OutputInput& in, Diagnostics& diagnostics) {
                              for (std::size_t k = 1; k < in.times.size(); ++k)
                                if (!(in.times[k] > in.times[k - 1]))
                                  diagnostics.add(fmt::format("times[{}]", k), "the times do not increase",
                                                  fmt::format("{} s after {} s", in.times[k], in.times[k - 1]), "sort them");
                            });
  return d;
}

const Declaration<ExpectInput>& expect_declaration() {
  using Statistic = ExpectInput::Statistic;
  static const auto d =
      Declaration<ExpectInput>("expect", "A number that the run must reproduce; crampon check compares.")
          .name("name", &ExpectInput::name, "what the table calls it")
          .text("column", &ExpectInput::column, "column of history.csv without its unit; either column or quantity")
          .words_from("history columns")
          .text("quantity", &ExpectInput::quantity, "particle quantity at point, in the last frame or the one nearest to time")
          .words_from("particle quantities")
          .excludes({"column"})
          .quantities("point", &ExpectInput::point, "m", Bounds::any(), "quantity: where", Presence::optional, two_or_three)
          .quantity("time", &ExpectInput::time, "s", Bounds::non_negative(), "when; left out: at the end")
          .quantities("range", &ExpectInput::range, "s", Bounds::non_negative(), "from and to: a statistic over this time",
                      Presence::optional, Length::exactly(2))
          .excludes({"time"})
          .choice("statistic", &ExpectInput::statistic,
                  {{"value", Statistic::value},
                   {"minimum", Statistic::minimum},
                   {"maximum", Statistic::maximum},
                   {"mean", Statistic::mean},
                   {"spread", Statistic::spread}},
                  "what is compared; spread: largest minus smallest")
          .quantity("value", &ExpectInput::value, "any", Bounds::any(), "the expected number", required)
          .quantity("tolerance", &ExpectInput::tolerance, "any", Bounds::non_negative(), "allowed difference")
          .quantity("relative", &ExpectInput::relative, "1", Bounds::non_negative(), "allowed difference as a fraction of value")
          .excludes({"tolerance"})
          .text("unit", &ExpectInput::unit, "unit in the printed table; value and tolerance stay in SI")
          .text("source", &ExpectInput::source, "where the number comes from")
          .check([](const ExpectInput& in, Diagnostics& diagnostics) {
            if (!in.column && !in.quantity)
              diagnostics.add("", "neither column nor quantity is given", "there is nothing to compare", "add column = \"...\"");
            if (in.quantity && in.point.empty())
              diagnostics.add("quantity", "the key \"point\" is missing", "a quantity is compared at a point", "add point = [...]");
            if (in.column && !in.point.empty())
              diagnostics.add("point", "point is given for a column", "a column has no place", "remove point, or use quantity");
            if (in.quantity && !in.range.empty())
              diagnostics.add("range", "range is given for a quantity", "it is compared in one frame",
                              "use time, or a [[probe]] and its column");
            if (in.range.size() == 2 && !(in.range[1] > in.range[0]))
              diagnostics.add("range", "the range does not end after it begins", fmt::format("{} s to {} s", in.range[0], in.range[1]),
                              "swap the times");
            if (!in.range.empty() && in.statistic == Statistic::value)
              diagnostics.add("range", "range needs a statistic", "over a time there is more than one value", "add statistic = \"mean\"");
            if (in.statistic != Statistic::value && (in.time || in.quantity))
              diagnostics.add("statistic", "a statistic of one number", "it is taken over the range of a column", "remove statistic");
            if (!in.keys.contains("tolerance") && !in.relative)
              diagnostics.add("", "neither tolerance nor relative is given", "no computed number is exact", "add one of them");
            if (in.relative && in.value == 0)
              diagnostics.add("relative", "relative to a value of zero", "nothing but zero would pass", "use tolerance");
          });
  return d;
}

}  // namespace

const Declaration<Problem>& problem_declaration() {
  static const auto d = Declaration<Problem>("input", "One problem: what is computed, how, and what comes out.")
                            .text("title", &Problem::title, "a line for pictures and reports")
                            .text("description", &Problem::description, "what the problem is about")
                            .choice("analysis", &Problem::analysis,
                                    {{"plane_strain", Analysis::plane_strain},
                                     {"plane_stress", Analysis::plane_stress},
                                     {"three_dimensional", Analysis::three_dimensional}},
                                    "the dimension, and in 2D what holds out of the plane")
                            .record("grid", &Problem::grid, grid_declaration, "the background grid", required)
                            .record("time", &Problem::time, time_declaration, "how far and in what steps", required)
                            .record("method", &Problem::method, method_declaration, "choices of the algorithm")
                            .record("contact", &Problem::contact, contact_declaration, "contact between bodies and across cracks")
                            .records("material", &Problem::materials, material_declaration, "constitutive laws", required)
                            .records("body", &Problem::bodies, body_declaration, "what is made of them", required)
                            .records("rigid", &Problem::rigids, rigid_declaration, "rigid bodies of particles: tools and moving boundaries")
                            .records("wall", &Problem::walls, wall_declaration, "rigid walls: half-spaces and balls")
                            .records("contact_pair", &Problem::contact_pairs, contact_pair_declaration, "what two bodies do when they meet")
                            .records("crack", &Problem::cracks, crack_declaration, "explicit cracks")
                            .record("fracture", &Problem::fracture, fracture_declaration, "J and stress intensities at tips of cracks")
                            .records("nucleation", &Problem::nucleations, nucleation_declaration, "cracks that start where stress is high")
                            .records("boundary", &Problem::boundaries, boundary_declaration, "prescribed velocities")
                            .records("symmetry", &Problem::symmetries, symmetry_declaration, "mirror planes")
                            .records("load", &Problem::loads, load_declaration, "forces")
                            .records("probe", &Problem::probes, probe_declaration, "points to watch")
                            .record("output", &Problem::output, output_declaration, "what is written")
                            .records("expect", &Problem::expects, expect_declaration, "numbers to reproduce");
  return d;
}

}  // namespace crampon
