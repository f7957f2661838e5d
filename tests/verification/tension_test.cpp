/// Bars in tension and compression: particles that move with another velocity than the one that strains them gather, and the bar tears
/// (docs/decisions/0013-positions.md). A bar of rubber (neo-Hookean, nu = 0: the cross section stays) of 1 m x .25 m in cells of 1/16 m.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>
#include <string_view>

#include "crampon/input/read_problem.hpp"
#include "crampon/run/build_model.hpp"
#include "crampon/step/advance.hpp"
#include "run_case.hpp"

namespace crampon::test {
namespace {

constexpr double E = 4e4, cell = 0.0625;  // Pa, m
constexpr double near_end = 0.47;         ///< from the middle of an oblique bar to its probes, m

/// Nominal stress at a stretch, uniaxial: (E/2)(l - 1/l).
double stress_at(double stretch) { return 0.5 * E * (stretch - 1 / stretch); }
/// The stretch at that stress.
double stretch_at(double stress) { return stress / E + std::sqrt(stress * stress / (E * E) + 1); }

enum class Space { along, oblique, three };

struct Pull {
  const char* shape_functions;
  const char* stress_update;
  Space space;
  double courant;
  double stretch;   ///< to be reached, in 100 ms a stress of 30 kPa more; or to be held
  int refined = 1;  ///< cells are shorter by this factor
  double h() const { return cell / refined; }
};
std::ostream& operator<<(std::ostream& out, const Pull& p) {
  static const char* const spaces[] = {"along", "oblique", "three"};
  return out << p.shape_functions << "_" << p.stress_update << "_" << spaces[static_cast<int>(p.space)] << "_courant_"
             << std::lround(100 * p.courant) << "_stretch_" << std::lround(1000 * p.stretch) << (p.refined > 1 ? "_refined" : "");
}

/// The bar is held at x = 0 by a row of nodes and pulled at its other face; oblique to the grid, at 30 degrees, it is pulled at both ends.
/// stress(t) as an expression in Pa, per area as it was at the start.
std::string bar(const Pull& p, const std::string& stress, double end) {
  const bool three = p.space == Space::three;
  const double h = p.h();
  std::string out = fmt::format(R"(analysis = "{}"
[time]
end = {}
courant = {}
[method]
shape_functions = "{}"
stress_update = "{}"
[[material]]
name = "rubber"
law = "neo_hookean"
E = {}
nu = 0
density = 0.1
)",
                                three ? "three_dimensional" : "plane_strain", end, p.courant, p.shape_functions, p.stress_update, E);
  const auto traction = [&](double share) { return fmt::format("{{ expression = \"{}*({})\", unit = \"Pa\" }}", share, stress); };
  if (p.space == Space::oblique) {
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    out += fmt::format(R"([grid]
origin = [-1.5, -1]
size = [3, 2]
cell = {}
[[body]]
name = "bar"
material = "rubber"
shape = {{ kind = "rotated", of = {{ kind = "rectangle", low = [-0.5, -0.125], high = [0.5, 0.125] }}, angle = "30 deg", about = [0, 0] }}
match_mass = true
)",
                       h);
    for (const int sign : {1, -1}) {
      out += fmt::format(R"([[load]]
kind = "traction"
body = "bar"
region = {{ kind = "half_plane", point = [{}, {}], normal = [{}, {}] }}
value = [{}, {}]
[[probe]]
name = "{}"
quantity = "displacement"
point = [{}, {}]
)",
                         sign * (0.5 - h / 100) * c, sign * (0.5 - h / 100) * s, -sign * c, -sign * s, traction(sign * c),
                         traction(sign * s), sign > 0 ? "end" : "start", sign * near_end * c, sign * near_end * s);
    }
    return out;
  }
  out += fmt::format(R"([grid]
origin = {}
size = {}
cell = {}
[[body]]
name = "bar"
material = "rubber"
shape = {{ kind = "{}", low = [0, 0{}], high = [1, 0.25{}] }}
[[boundary]]
name = "held"
region = {{ kind = "{}", low = [-0.25, -0.5{}], high = [0, 0.75{}] }}
vx = 0
[[load]]
kind = "traction"
body = "bar"
face = "x+"
value = [{}, 0{}]
[[probe]]
name = "end"
quantity = "displacement"
point = [1, 0.125{}]
)",
                     three ? "[-0.25, -0.5, -0.5]" : "[-0.25, -0.5]", three ? "[2.25, 1.25, 1.25]" : "[2.25, 1.25]", h,
                     three ? "box" : "rectangle", three ? ", 0" : "", three ? ", 0.25" : "", three ? "box" : "rectangle",
                     three ? ", -0.5" : "", three ? ", 0.75" : "", traction(1), three ? ", 0" : "", three ? ", 0.125" : "");
  return out;
}

/// What a bar does from a time on.
struct Course {
  double kinetic = 0;  ///< most, over strain energy
  double off = 0;      ///< displacement of the end off the closed form, most, over the closed form
  double closure = 0;  ///< at the end, over strain energy
};

/// Along the axis of the oblique bar, of the particle at the start that is nearest to a point of the axis, m.
double along_axis(const Simulation& simulation, double of_point) {
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  const PointFrame frame = simulation.particles();
  double nearest = HUGE_VAL, along = 0;
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p) {
    const double x = frame.positions[3 * p], y = frame.positions[3 * p + 1], away = std::hypot(x - of_point * c, y - of_point * s);
    if (away < nearest) nearest = away, along = x * c + y * s;
  }
  return along;
}

/// Runs the bar; stress(t) as bar() has it. Stops early when it flies apart.
Course follow(const Pull& p, const std::string& expression, const std::function<double(double)>& stress, double from, double end,
              const std::string& more = "") {
  const auto simulation = make(bar(p, expression, end) + more);
  Course course;
  const double between = p.space == Space::oblique ? along_axis(*simulation, near_end) - along_axis(*simulation, -near_end) : 0;
  try {
    run(*simulation, [&](Simulation& s) {
      if (s.time() < from || s.steps_done() % 10 != 0) return;
      const double strain = value(s, "strain_energy"), stretch = stretch_at(stress(s.time()));
      // Particles stand a quarter of a cell from the ends.
      double moved = value(s, "end.displacement_x"), expected = (1 - p.h() / 4) * (stretch - 1);
      if (p.space == Space::oblique) {
        const double c = std::cos(std::numbers::pi / 6), sn = std::sin(std::numbers::pi / 6);
        moved = (moved - value(s, "start.displacement_x")) * c + (value(s, "end.displacement_y") - value(s, "start.displacement_y")) * sn;
        expected = between * (stretch - 1);
      }
      course.kinetic = std::fmax(course.kinetic, value(s, "kinetic_energy") / strain);
      course.off = std::fmax(course.off, std::fabs(moved / expected - 1));
    });
  } catch (const RunError&) {
    course.kinetic = HUGE_VAL;
  }
  course.closure = value(*simulation, "energy_closure") / value(*simulation, "strain_energy");
  testing::Test::RecordProperty("kinetic", fmt::format("{:.4f}", course.kinetic));
  testing::Test::RecordProperty("off", fmt::format("{:.4f}", course.off));
  testing::Test::RecordProperty("closure", fmt::format("{:.5f}", course.closure));
  return course;
}

class Stretched : public testing::TestWithParam<Pull> {};
using StretchedFull = Stretched;

/// The rate of the stress comes up within the first 20 ms, two periods of the bar: else the bar rings by a fifteenth of what it is pulled by.
constexpr double rate = 3e5, starting = 0.02;  // Pa/s, s
double pulled(double t) { return rate * (std::pow(std::fmin(t, starting), 2) / (2 * starting) + std::fmax(t - starting, 0.)); }
const std::string pulled_text = fmt::format("{0}*(min(t,{1})^2/{2}+max(t-{1},0))", rate, starting, 2 * starting);
double pulling_time(double stretch) { return stress_at(stretch) / rate + starting / 2; }

void expect_reached(const Pull& p) {
  const Course course = follow(p, pulled_text, pulled, 0.01, pulling_time(p.stretch));
  EXPECT_LT(course.kinetic, 0.05) << "quasi-static; measured .041, soon after the start";
  EXPECT_LT(course.off, 0.1);
  EXPECT_LT(std::fabs(course.closure), 0.01) << "of the strain energy: forces do their work with the velocities that strain";
}
TEST_P(Stretched, FollowsTheClosedForm) { expect_reached(GetParam()); }
TEST_P(StretchedFull, FollowsTheClosedForm) { expect_reached(GetParam()); }
const auto name_of = [](const auto& info) { return testing::PrintToString(info.param); };

/// Whoever stretches a body that far is told, in the plane (oblique) and in space; not with domains that stretch, nor below.
TEST(LargeStretch, IsTold) {
  const auto notes = [](const Pull& p) {
    const auto simulation = make(bar(p, pulled_text, pulling_time(p.stretch)));
    run(*simulation);
    return simulation->notes();
  };
  for (const char* shape_functions : {"gimp", "bspline", "cubic_bspline"}) {
    for (const Space space : {Space::oblique, Space::three}) {
      if (space == Space::three && shape_functions != std::string_view("gimp")) continue;  // three runs more would ask nothing new
      const std::vector<std::string> told = notes({shape_functions, "usavg", space, 0.5, 1.3});
      ASSERT_EQ(told.size(), 1u) << shape_functions;
      EXPECT_EQ(told[0].find("a particle of the body \"bar\" (number "), 0u) << told[0];
      EXPECT_NE(told[0].find("method.shape_functions = \"cpdi\""), std::string::npos) << told[0];
    }
    EXPECT_TRUE(notes({shape_functions, "usavg", Space::along, 0.5, 1.1}).empty()) << shape_functions;
  }
  EXPECT_TRUE(notes({"cpdi", "usavg", Space::along, 0.5, 1.3}).empty());
  // Stress borne from the start comes without stretch, under rigid faces or not.
  std::string at_rest = bar({"gimp", "usavg", Space::along, 0.5, 1.3}, "0", 1e-3);
  at_rest.insert(at_rest.find("[[boundary]]"), "initial_stress = { kind = \"components\", xx = 20000 }\n");
  for (const char* face : {"", "[[wall]]\nname = \"floor\"\npoint = [0, -0.2]\nnormal = [0, 1]\n"}) {
    const auto simulation = make(at_rest + face);
    run(*simulation);
    for (const std::string& note : simulation->notes()) EXPECT_EQ(note.find("stretched"), std::string::npos) << note;
  }
}

INSTANTIATE_TEST_SUITE_P(Bars, Stretched,
                         testing::Values(Pull{"gimp", "usavg", Space::along, 0.5, 1.5}, Pull{"bspline", "usavg", Space::along, 0.5, 1.4},
                                         Pull{"gimp", "usavg", Space::oblique, 0.5, 1.5},
                                         Pull{"bspline", "usavg", Space::oblique, 0.5, 1.4},
                                         Pull{"cubic_bspline", "usavg", Space::along, 0.5, 1.4},
                                         Pull{"cubic_bspline", "usavg", Space::oblique, 0.5, 1.4}),
                         name_of);

// Domains that stretch leave no gaps between particles: no stress update gains or loses energy, and oblique bars hold.
INSTANTIATE_TEST_SUITE_P(Domains, Stretched,
                         testing::Values(Pull{"cpdi", "usavg", Space::along, 0.5, 1.5}, Pull{"cpdi", "musl", Space::along, 0.5, 1.5},
                                         Pull{"cpdi", "usf", Space::along, 0.5, 1.5}, Pull{"cpdi", "usl", Space::along, 0.5, 1.5},
                                         Pull{"cpdi", "usavg", Space::oblique, 0.5, 1.5},
                                         Pull{"cpdi", "usavg", Space::oblique, 0.5, 1.5, 2}),
                         name_of);

/// Held at a stretch from 30 to 200 ms, that is 110 periods of the bar; kept straight, so that compression does not bend it. The load comes up along a
/// cosine: a ramp with corners leaves the bar ringing by 6 % for ever, and what rings makes bars of uGIMP and B-splines tear (docs/theory/step.md).
class Held : public testing::TestWithParam<Pull> {};
using HeldFull = Held;
void expect_rest(const Pull& p) {
  const double stress = stress_at(p.stretch);
  const Course course = follow(
      p, fmt::format("{}*0.5*(1-cos({}*min(t,0.03)))", stress, std::numbers::pi / 0.03),
      [&](double t) { return stress * 0.5 * (1 - std::cos(std::numbers::pi / 0.03 * std::fmin(t, 0.03))); }, 0.03, 0.2,
      "[[boundary]]\nname = \"straight\"\nregion = { kind = \"rectangle\", low = [-0.25, -0.5], high = [2, 0.75] }\nvy = 0\n");
  EXPECT_LT(course.kinetic, sees_beyond_cell(p.shape_functions) ? 0.15 : 0.05);
  EXPECT_LT(course.off, 0.1);
  EXPECT_LT(std::fabs(course.closure), 0.01) << "of the strain energy: forces do their work with the velocities that strain";
}
TEST_P(Held, StaysAtRest) { expect_rest(GetParam()); }
TEST_P(HeldFull, StaysAtRest) { expect_rest(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Bars, Held,
                         testing::Values(Pull{"gimp", "usavg", Space::along, 0.5, 1.25}, Pull{"gimp", "usavg", Space::along, 0.5, 0.8},
                                         Pull{"bspline", "usavg", Space::along, 0.5, 1.105},
                                         Pull{"bspline", "usavg", Space::along, 0.5, 0.8},
                                         Pull{"cubic_bspline", "usavg", Space::along, 0.5, 1.105},
                                         Pull{"cubic_bspline", "usavg", Space::along, 0.5, 0.8}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Domains, Held,
                         testing::Values(Pull{"cpdi", "usavg", Space::along, 0.5, 1.25}, Pull{"cpdi", "musl", Space::along, 0.5, 1.25},
                                         Pull{"cpdi", "usf", Space::along, 0.5, 1.25}, Pull{"cpdi", "usavg", Space::along, 0.5, 0.8}),
                         name_of);

/// Longest of the eigenvalues of the engine's own step about the bar at rest at a stretch, by central differences of advance() in all positions,
/// velocities and deformation gradients of a bar of 8 x 1 cells. Positions in cells, velocities over the wave speed.
/// The bar is pulled at its outermost row of particles, or at its face.
template <class Shape>
double spectral_radius(const char* shape_functions, const char* stress_update, const char* positions, double courant, double stretch,
                       bool at_face = false) {
  const std::string load = at_face ? fmt::format(
                                         "kind = \"traction\"\nbody = \"bar\"\nface = \"x+\"\n"
                                         "value = [{{ expression = \"{}*min(t/0.05,1)\", unit = \"Pa\" }}, 0]",
                                         stress_at(stretch))
                                   : fmt::format(
                                         "kind = \"total_force\"\nregion = {{ kind = \"half_plane\", point = [{}, 0], normal = [-1, 0] }}\n"
                                         "value = [{{ expression = \"{}*min(t/0.05,1)\", unit = \"N\" }}, 0]",
                                         0.5 - cell / 2, stress_at(stretch) * cell);
  const std::string text = fmt::format(R"toml(
[grid]
origin = [-0.25, -0.25]
size = [1.25, 0.5625]
cell = {}
[time]
end = 1
[method]
shape_functions = "{}"
stress_update = "{}"
positions = "{}"
damping = 1
[[material]]
name = "rubber"
law = "neo_hookean"
E = {}
nu = 0
density = 0.1
[[body]]
name = "bar"
material = "rubber"
shape = {{ kind = "rectangle", low = [0, 0], high = [0.5, {}] }}
[[boundary]]
name = "held"
region = {{ kind = "rectangle", low = [-0.25, -0.25], high = [0, 0.3] }}
vx = 0
[[boundary]]
name = "straight"
region = {{ kind = "rectangle", low = [-0.25, -0.25], high = [1, 0.3] }}
vy = 0
[[load]]
{}
)toml",
                                       cell, shape_functions, stress_update, positions, E, cell, load);
  BuiltModel<2> built = build_model<2>(read_problem_text(text, "test.toml", "."), 1);
  Model<2>& model = built.model;
  State<2>& state = built.state;
  const double c = std::sqrt(E / 0.1), dt = courant * cell / (c * std::fmax(stretch, 1.));
  const auto damp = [&](double kappa) { model.damping = ValueFunction::constant(kappa), model.damped = kappa > 0; };
  damp(2000);
  while (state.clock.time < 0.2) {
    advance<2, Shape>(state, built.work, model, dt, Watched::no);
    // Waves that the grid does not see die out by a share of its velocity.
    for (std::size_t p = 0; p < state.particles.size(); ++p) {
      Pack& q = state.particles.motion[p];
      q[2] *= 0.98, q[3] *= 0.98;
    }
  }
  damp(0);
  const std::size_t count = state.particles.size();
  std::vector<std::size_t> real;
  for (std::size_t p = 0; p < count; ++p) {
    if (!state.particles.is_padding(p)) real.push_back(p);
    state.particles.motion[p][2] = state.particles.motion[p][3] = 0;
  }
  // Of what moves along the bar: position, velocity, stretch. Nothing changes place in the order of particles: they hardly move.
  Particles<2>& particles = state.particles;
  const std::size_t of_each = particles.has_domains ? 4 : 3;  // domains that stretch have a length
  const auto number = [&](std::size_t i) -> double& {
    const std::size_t p = real[i / of_each], which = i % of_each;
    if (which < 2) return reinterpret_cast<double*>(&particles.motion[p])[which == 0 ? 0 : 2];
    Pack& pack = which == 2 ? particles.history[p / lanes * static_cast<std::size_t>(particles.history_size)]
                            : particles.domain[p / lanes * domain_size<2>];
    return reinterpret_cast<double*>(&pack)[p % lanes];
  };
  const auto copy = [](const AlignedArray<Pack>& array) {
    return std::vector<Pack, Eigen::aligned_allocator<Pack>>(array.begin(), array.end());
  };
  const auto motion = copy(particles.motion), history = copy(particles.history), stress = copy(particles.stress),
             domain = copy(particles.domain);
  const double time = state.clock.time, unit[4] = {cell, c, 1, cell};
  const std::size_t size = of_each * real.size();
  const auto stepped = [&](std::size_t j, double e) {
    std::copy(motion.begin(), motion.end(), particles.motion.data());
    std::copy(history.begin(), history.end(), particles.history.data());
    std::copy(stress.begin(), stress.end(), particles.stress.data());
    std::copy(domain.begin(), domain.end(), particles.domain.data());
    state.clock.time = time;
    number(j) += e * unit[j % of_each];
    advance<2, Shape>(state, built.work, model, dt, Watched::no);
    Eigen::VectorXd out(static_cast<Eigen::Index>(size));
    for (std::size_t i = 0; i < size; ++i) out[static_cast<Eigen::Index>(i)] = number(i) / unit[i % of_each];
    return out;
  };
  Eigen::MatrixXd J(size, size);
  for (std::size_t j = 0; j < size; ++j) J.col(static_cast<Eigen::Index>(j)) = (stepped(j, 1e-6) - stepped(j, -1e-6)) / 2e-6;
  return J.eigenvalues().cwiseAbs().maxCoeff();
}

class OneStep : public testing::TestWithParam<std::tuple<const char*, const char*, double>> {};
using OneStepFull = OneStep;

/// A radius of 1 + 1e-4 doubles an error in 7000 steps. With N03's positions it is 1.0186 at a stretch of 1.10 (a doubling in 38 steps).
void expect_no_growth(const char* shape, const char* update, double stretch) {
  const double radius = with_shape(kind_of_word(shape), [&]<class Shape>(std::type_identity<Shape>) {
    return spectral_radius<Shape>(shape, update, "strain", 0.5, stretch);
  });
  testing::Test::RecordProperty("radius_less_one", fmt::format("{:.2e}", radius - 1));
  EXPECT_LT(radius, 1 + 1e-4);
}
TEST_P(OneStep, LetsNothingGrow) { expect_no_growth(std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())); }
TEST_P(OneStepFull, LetsNothingGrow) { expect_no_growth(std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())); }
INSTANTIATE_TEST_SUITE_P(Gimp, OneStep,
                         testing::Combine(testing::Values("gimp"), testing::Values("usavg", "usf"), testing::Values(0.9, 1.05, 1.1, 1.15)));
INSTANTIATE_TEST_SUITE_P(Bspline, OneStep,
                         testing::Combine(testing::Values("bspline", "cubic_bspline"), testing::Values("usavg", "usf"),
                                          testing::Values(0.9, 1.05)));
INSTANTIATE_TEST_SUITE_P(Cpdi, OneStep,
                         testing::Combine(testing::Values("cpdi"), testing::Values("usavg", "usf"),
                                          testing::Values(0.8, 0.9, 1.05, 1.1, 1.15, 1.25, 1.5)));
INSTANTIATE_TEST_SUITE_P(Gimp, OneStepFull,
                         testing::Combine(testing::Values("gimp"), testing::Values("usavg", "usf"), testing::Values(0.8)));

/// Forces on the outermost row of particles are no load on a face: pulled so, a bar of B-splines at 1.10 lets the node grow that lies beyond the row and has
/// next to no mass (7.7e-4 in a step). Under a traction on its face nothing grows.
TEST(OneStepUnderFaceLoad, LetsNothingGrow) {
  for (const char* update : {"usavg", "usf"}) {
    for (const double stretch : {0.9, 1.05, 1.1, 1.15}) {
      const double radius = spectral_radius<BsplineShape>("bspline", update, "strain", 0.5, stretch, true);
      EXPECT_LT(radius, 1 + 1e-4) << update << " at " << stretch;
    }
    EXPECT_LT(spectral_radius<BsplineShape>("bspline", update, "strain", 0.5, 1.1), 1 + 1e-3) << update << ", pulled at its outermost row";
  }
}

TEST(OneStepOfN03, Grows) {
  EXPECT_GT(spectral_radius<GimpShape>("gimp", "usavg", "n03", 0.5, 1.1), 1.01) << "else the test above shows nothing";
}

// Long: all Courant numbers, in space, finer cells.
INSTANTIATE_TEST_SUITE_P(
    Sweep, StretchedFull,
    testing::Values(Pull{"gimp", "usavg", Space::along, 0.1, 1.5}, Pull{"gimp", "usavg", Space::along, 0.3, 1.5},
                    Pull{"gimp", "usavg", Space::three, 0.1, 1.5}, Pull{"gimp", "usavg", Space::three, 0.3, 1.5},
                    Pull{"gimp", "usavg", Space::three, 0.5, 1.5}, Pull{"bspline", "usavg", Space::along, 0.1, 1.4},
                    Pull{"bspline", "usavg", Space::along, 0.3, 1.4}, Pull{"bspline", "usavg", Space::three, 0.5, 1.4},
                    Pull{"gimp", "usavg", Space::oblique, 0.1, 1.5}, Pull{"gimp", "usavg", Space::oblique, 0.3, 1.5},
                    Pull{"gimp", "usavg", Space::oblique, 0.1, 1.5, 2}, Pull{"gimp", "usavg", Space::oblique, 0.3, 1.5, 2},
                    Pull{"gimp", "usavg", Space::oblique, 0.5, 1.5, 2}, Pull{"bspline", "usavg", Space::oblique, 0.1, 1.4},
                    Pull{"bspline", "usavg", Space::oblique, 0.3, 1.4}, Pull{"bspline", "usavg", Space::oblique, 0.5, 1.4, 2},
                    Pull{"gimp", "musl", Space::along, 0.5, 1.5}, Pull{"gimp", "usf", Space::along, 0.1, 1.5},
                    Pull{"gimp", "usf", Space::along, 0.5, 1.5}),
    name_of);
INSTANTIATE_TEST_SUITE_P(Domains, StretchedFull,
                         testing::Values(Pull{"cpdi", "usavg", Space::along, 0.1, 1.5}, Pull{"cpdi", "usavg", Space::along, 0.3, 1.5},
                                         Pull{"cpdi", "usavg", Space::oblique, 0.1, 1.5, 2},
                                         Pull{"cpdi", "usavg", Space::oblique, 0.3, 1.5, 2},
                                         Pull{"cpdi", "musl", Space::oblique, 0.5, 1.5, 2},
                                         Pull{"cpdi", "usf", Space::oblique, 0.5, 1.5, 2}, Pull{"cpdi", "usavg", Space::three, 0.1, 1.5},
                                         Pull{"cpdi", "usavg", Space::three, 0.3, 1.5}, Pull{"cpdi", "usavg", Space::three, 0.5, 1.5}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Domains, HeldFull,
                         testing::Values(Pull{"cpdi", "usavg", Space::along, 0.1, 1.25}, Pull{"cpdi", "usavg", Space::along, 0.3, 1.25},
                                         Pull{"cpdi", "usavg", Space::along, 0.1, 0.8}, Pull{"cpdi", "usavg", Space::along, 0.3, 0.8}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Sweep, HeldFull,
                         testing::Values(Pull{"gimp", "usavg", Space::along, 0.1, 1.25}, Pull{"gimp", "usavg", Space::along, 0.3, 1.25},
                                         Pull{"gimp", "usavg", Space::along, 0.1, 0.8}, Pull{"bspline", "usavg", Space::along, 0.1, 0.8},
                                         Pull{"bspline", "usavg", Space::along, 0.1, 1.25},
                                         Pull{"bspline", "usavg", Space::along, 0.3, 1.25},
                                         Pull{"bspline", "usavg", Space::along, 0.5, 1.25},
                                         Pull{"bspline", "musl", Space::along, 0.5, 1.25}, Pull{"gimp", "usf", Space::along, 0.5, 1.25},
                                         Pull{"gimp", "musl", Space::along, 0.5, 1.25}),
                         name_of);

}  // namespace
}  // namespace crampon::test
