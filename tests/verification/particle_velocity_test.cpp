/// How particles take up what nodes have found: FLIP, a part of PIC, XPIC and FMPM, and damping of particles (docs/theory/step.md, transfers).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "run_case.hpp"

namespace crampon::test {
namespace {

/// Cells of 0.1 m over [0, 1.2]^2 (or cubed), one material with waves of about 32 m/s.
std::string input(const std::string& method, const std::string& rest, int steps, const char* law = "neo_hookean") {
  return fmt::format(R"(
[grid]
origin = [-0.8, -0.8]
size = [1.6, 1.6]
cell = 0.1
[time]
steps = {}
courant = 0.3
[method]
{}
[[material]]
name = "m"
law = "{}"
E = 1e6
nu = 0.3
density = 1000
{}
)",
                     steps, method, law, rest);
}
std::string disk(const std::string& motion) {
  return "[[body]]\nname = \"disk\"\nmaterial = \"m\"\nshape = { kind = \"disk\", centre = [0.013, 0.021], radius = 0.5 }\n" + motion +
         "\n";
}
/// Breathing: speeds of up to 0.5 m/s, strains of 3 %.
const std::string breathing = "velocity = [{ expression = \"x\", unit = \"m/s\" }, { expression = \"y\", unit = \"m/s\" }]";

double total_energy(const Simulation& s) { return value(s, "total_energy"); }

/// One step of bodies without stress, against the series written out with full matrices: the velocities of particles are
/// V = S v^(k), v^(k) = sum over l < k of (1 - A)^l m^-1 S^T m V. Linear functions, random velocities, order by order.
TEST(Series, IsThatOfTheMatrices) {
  const double h = 0.1;
  for (const char* kind : {"fmpm", "xpic"}) {
    for (int order = 1; order <= 5; ++order) {
      const auto simulation = make(input(
          fmt::format("shape_functions = \"linear\"\nstress_update = \"usl\"\ntransfer = {{ kind = \"{}\", order = {} }}", kind, order),
          "[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [0.03, 0.01], high = [0.33, 0.26] }\n"
          "velocity = [{ expression = \"sin(91*x+37*y)\", unit = \"m/s\" }, { expression = \"cos(53*x-71*y)\", unit = \"m/s\" }]\n",
          1));
      const PointFrame before = simulation->particles({"velocity", "mass"});
      const Numbers v = field(before, "velocity").values, mass = field(before, "mass").values;
      const std::size_t count = mass.size();
      const auto weight = [&](std::size_t p, int i, int j) {
        const auto hat = [&](double x, int n) { return std::fmax(0., 1 - std::fabs((x - (-0.8 + n * h)) / h)); };
        return hat(before.positions[3 * p], i) * hat(before.positions[3 * p + 1], j);
      };
      constexpr int side = 17, nodes = side * side;
      std::vector<double> S(count * nodes), m(nodes, 0.);
      for (std::size_t p = 0; p < count; ++p) {
        for (int n = 0; n < nodes; ++n) {
          S[p * nodes + n] = weight(p, n % side, n / side);
          m[n] += S[p * nodes + n] * mass[p];
        }
      }
      for (int axis = 0; axis < 2; ++axis) {
        const auto to_nodes = [&](const std::vector<double>& V) {
          std::vector<double> w(nodes, 0.);
          for (std::size_t p = 0; p < count; ++p) {
            for (int n = 0; n < nodes; ++n) w[n] += S[p * nodes + n] * mass[p] * V[p];
          }
          for (int n = 0; n < nodes; ++n) w[n] = m[n] > 0 ? w[n] / m[n] : 0;
          return w;
        };
        const auto to_particles = [&](const std::vector<double>& w) {
          std::vector<double> V(count, 0.);
          for (std::size_t p = 0; p < count; ++p) {
            for (int n = 0; n < nodes; ++n) V[p] += S[p * nodes + n] * w[n];
          }
          return V;
        };
        std::vector<double> V(count);
        for (std::size_t p = 0; p < count; ++p) V[p] = v[3 * p + static_cast<std::size_t>(axis)];
        std::vector<double> w = to_nodes(V), sum = w;
        for (int l = 2; l <= order; ++l) {
          const std::vector<double> Aw = to_nodes(to_particles(w));
          for (int n = 0; n < nodes; ++n) w[n] -= Aw[n], sum[n] += w[n];
        }
        const std::vector<double> wanted = to_particles(sum);
        if (axis == 0) simulation->step(1e9);
        const Numbers after = field(simulation->particles({"velocity"}), "velocity").values;
        for (std::size_t p = 0; p < count; ++p)
          EXPECT_NEAR(after[3 * p + static_cast<std::size_t>(axis)], wanted[p], 1e-13) << kind << order;
      }
    }
  }
}

struct Way {
  const char* transfer;
  const char* stress_update;
  const char* shape_functions;
};
void PrintTo(const Way& c, std::ostream* out) { *out << c.transfer << ' ' << c.stress_update << ' ' << c.shape_functions; }
class Transfer : public testing::TestWithParam<Way> {};

std::string method(const Way& c) {
  return fmt::format("shape_functions = \"{}\"\nstress_update = \"{}\"\ntransfer = {}", c.shape_functions, c.stress_update, c.transfer);
}

/// A free disk that breathes and flies keeps its momentum to round-off, never has more energy than at the start, and what it loses is told: the
/// balance closes within 1 % of the energy of the breathing (second order in the step, as with FLIP).
TEST_P(Transfer, KeepsMomentumAndTellsWhatItLoses) {
  const auto simulation =
      make(input(method(GetParam()),
                 disk("velocity = [{ expression = \"0.3+x\", unit = \"m/s\" }, { expression = \"y-0.2\", unit = \"m/s\" }]"), 300));
  const double start = total_energy(*simulation), px = value(*simulation, "momentum_x"), py = value(*simulation, "momentum_y");
  const double flight = 0.5 * (px * px + py * py) / (3.14159 * 0.25 * 1000);
  double most = 0;
  run(*simulation, [&](Simulation& s) { most = std::fmax(most, total_energy(s)); });
  EXPECT_NEAR(value(*simulation, "momentum_x"), px, 1e-12 * px);
  EXPECT_NEAR(value(*simulation, "momentum_y"), py, 1e-12 * px);
  // Only USAVG knows stress at the time of the velocities: the others swing by half a step's work.
  EXPECT_LT(most, start * (std::string(GetParam().stress_update) == "usavg" ? 1.001 : 1.04));
  std::printf("%s %s %s: kept %.4f closure %.4f loss %.4f\n", GetParam().transfer, GetParam().stress_update, GetParam().shape_functions,
              (total_energy(*simulation) - flight) / (start - flight), value(*simulation, "energy_closure") / (start - flight),
              value(*simulation, "transfer_loss") / (start - flight));
  EXPECT_NEAR(value(*simulation, "energy_closure"), 0, 0.01 * (start - flight));
  EXPECT_GE(value(*simulation, "transfer_loss"), -0.001 * start);
}

INSTANTIATE_TEST_SUITE_P(
    ParticleVelocity, Transfer,
    testing::Values(Way{"{ kind = \"flip\", pic = 0.02 }", "usavg", "gimp"}, Way{"{ kind = \"flip\", pic = 0.1 }", "musl", "linear"},
                    Way{"{ kind = \"xpic\", order = 1 }", "usavg", "gimp"}, Way{"{ kind = \"xpic\", order = 2 }", "usavg", "gimp"},
                    Way{"{ kind = \"xpic\", order = 3 }", "usl", "bspline"},
                    Way{"{ kind = \"xpic\", order = 5, every = 10 }", "usavg", "linear"},
                    Way{"{ kind = \"fmpm\", order = 1 }", "usavg", "gimp"}, Way{"{ kind = \"fmpm\", order = 2 }", "usavg", "gimp"},
                    Way{"{ kind = \"fmpm\", order = 2 }", "usf", "gimp"}, Way{"{ kind = \"fmpm\", order = 4 }", "musl", "bspline"},
                    Way{"{ kind = \"fmpm\", order = 3 }", "usl", "gimp"},
                    Way{"{ kind = \"fmpm\", order = 4, every = 20 }", "usavg", "gimp"}));

/// Order test: a breathing disk loses the less, the more terms the series has; FLIP is no bound. Ten periods of some 25 ms.
double kept(const std::string& transfer, const char* shape_functions) {
  const auto simulation =
      make(input(fmt::format("shape_functions = \"{}\"\ntransfer = {}", shape_functions, transfer), disk(breathing), 250));
  const double start = total_energy(*simulation);
  run(*simulation);
  return total_energy(*simulation) / start;
}
TEST(Series, LosesLessWithEveryTerm) {
  for (const char* kind : {"xpic", "fmpm"}) {
    for (const char* shape_functions : {"linear", "gimp", "bspline"}) {
      double last = 0;
      for (int order : {1, 2, 3, 4, 6, 8}) {
        const double now = kept(fmt::format("{{ kind = \"{}\", order = {} }}", kind, order), shape_functions);
        std::printf("%s %s %d: %.5f\n", kind, shape_functions, order, now);
        EXPECT_GT(now, last) << kind << ' ' << order << ' ' << shape_functions;
        EXPECT_LT(now, 1.0005) << kind << ' ' << order << ' ' << shape_functions;
        last = now;
      }
    }
  }
}

/// All velocity from nodes, with PIC as a part of FLIP and as the first term of either series: the same numbers.
TEST(Series, OfOneTermIsPic) {
  std::array<Numbers, 3> v;
  const char* ways[] = {"{ kind = \"flip\", pic = 1 }", "{ kind = \"fmpm\", order = 1 }", "{ kind = \"xpic\", order = 1 }"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto simulation = make(input(fmt::format("stress_update = \"usl\"\ntransfer = {}", ways[i]), disk(breathing), 20));
    run(*simulation);
    v[i] = field(simulation->particles({"velocity"}), "velocity").values;
  }
  EXPECT_LT(difference(v[0], v[1]), 1e-13);  // m/s, of 0.5
  EXPECT_LT(difference(v[0], v[2]), 1e-13);
}

/// Stuck everywhere is one body, also in every term; a mirror is the other half; prescribed nodes keep what is prescribed.
TEST(Series, KeepsBondsMirrorsAndPrescribedNodes) {
  for (const char* transfer : {"{ kind = \"fmpm\", order = 3 }", "{ kind = \"xpic\", order = 3 }", "{ kind = \"flip\", pic = 0.05 }"}) {
    for (const char* shape_functions : {"linear", "gimp", "bspline"}) {
      const std::string way = fmt::format("shape_functions = \"{}\"\ntransfer = {}\n", shape_functions, transfer);
      const std::string two =
          "[[body]]\nname = \"a\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [-0.4, -0.3], high = [0.02, 0.3] }\n" +
          breathing +
          "\n[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [0.02, -0.3], high = [0.4, 0.3] }\n" +
          breathing + "\n";
      const auto one = make(input(way, two, 40)),
                 bonded = make(input(way, two + "[contact]\nfields = \"bodies\"\ndefault = \"bonded\"\n", 40));
      run(*one), run(*bonded);
      EXPECT_LT(
          difference(field(one->particles({"velocity"}), "velocity").values, field(bonded->particles({"velocity"}), "velocity").values),
          1e-12)
          << transfer << shape_functions;

      const std::string whole =
          "[[body]]\nname = \"a\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [-0.4, -0.3], high = [0.4, 0.3] }\n" +
          breathing + "\n";
      const std::string half =
          "[[body]]\nname = \"a\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [0, -0.3], high = [0.4, 0.3] }\n" + breathing +
          "\n[[symmetry]]\naxis = \"x\"\nat = 0\n";
      const auto full = make(input(way, whole, 40)), mirrored = make(input(way, half, 40));
      run(*full), run(*mirrored);
      EXPECT_NEAR(value(*full, "kinetic_energy"), 2 * value(*mirrored, "kinetic_energy"), 1e-10 * value(*full, "kinetic_energy"))
          << transfer << shape_functions;
      EXPECT_NEAR(value(*full, "strain_energy"), 2 * value(*mirrored, "strain_energy"), 1e-9 * value(*full, "kinetic_energy"))
          << transfer << shape_functions;
    }
  }
}

/// A block slides on another with friction .3 under its weight: the momentum that it loses along the face is .3 of the impulse across, m g t and
/// what it has gained, within 1 %, as with FLIP; terms of the series neither glue nor part the two.
TEST(Series, LeavesFrictionAlone) {
  for (const char* transfer :
       {"{ kind = \"flip\" }", "{ kind = \"fmpm\", order = 2 }", "{ kind = \"xpic\", order = 2 }", "{ kind = \"fmpm\", order = 4 }"}) {
    const auto simulation = make(input(
        fmt::format("shape_functions = \"gimp\"\nbody_force = [0, -9.81]\ntransfer = {}", transfer),
        "[contact]\nfields = \"bodies\"\ndefault = { law = \"coulomb\", friction = 0.3 }\n"
        "[[body]]\nname = \"low\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [-0.7, -0.5], high = [0.7, -0.1] }\n"
        "[[body]]\nname = \"top\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [-0.5, -0.1], high = [0.1, 0.2] }\n"
        "velocity = [1, 0]\n[[boundary]]\nregion = { kind = \"rectangle\", low = [-0.8, -0.5], high = [0.8, -0.5] }\nvx = 0\nvy = 0\n",
        200));
    run(*simulation);
    const PointFrame end = simulation->particles({"velocity", "mass"});
    Vec<2> p;
    double m = 0;
    for (std::size_t i = 0; i < field(end, "mass").values.size(); ++i) {
      if (field(end, "body").values[i] != 1) continue;
      for (std::size_t k = 0; k < 2; ++k) p[k] += field(end, "mass").values[i] * field(end, "velocity").values[3 * i + k];
      m += field(end, "mass").values[i];
    }
    const double ratio = (m - p[0]) / (m * 9.81 * simulation->time() + p[1]);
    std::printf("%s: %.4f\n", transfer, ratio);
    EXPECT_NEAR(ratio, 0.3, 0.003) << transfer;
  }
}

/// Short waves of uGIMP particles that nodes do not see: with damping of nodes alone they stay, with damping of particles or FMPM they go.
TEST(ParticleDamping, BringsToRestWhatNodesDoNotSee) {
  const auto left = [](const std::string& way) {
    const auto simulation =
        make(input("shape_functions = \"gimp\"\n" + way,
                   "[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [-0.4, -0.3], high = [0.4, 0.3] }\n"
                   "velocity = [{ expression = \"0.1*cos(2*pi*x/0.1)\", unit = \"m/s\" }, 0]\n",
                   1000));
    const double start = value(*simulation, "kinetic_energy");
    run(*simulation);
    EXPECT_NEAR(value(*simulation, "energy_closure"), 0, 0.01 * start);
    return value(*simulation, "kinetic_energy") / start;
  };
  EXPECT_GT(left("damping = 30"), 0.05);
  EXPECT_LT(left("particle_damping = 30"), 1e-6);
  EXPECT_LT(left("damping = 30\ntransfer = { kind = \"fmpm\", order = 2 }"), 1e-6);
  EXPECT_LT(left("damping = 30\ntransfer = { kind = \"flip\", pic = 0.02 }"), 1e-6);
}

/// A pulled bar comes to rest and the run ends by itself, long before its end, with the stress of the load.
TEST(StopAtRest, EndsWhenNothingMoves) {
  const auto simulation = make(input("shape_functions = \"gimp\"\nparticle_damping = 120\nbody_force = [0, -1]",
                                     "[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = { kind = \"rectangle\", low = [0, 0], high = [0.4, "
                                     "0.6] }\n[[symmetry]]\naxis = \"x\"\nat = 0\n"
                                     "[[symmetry]]\nname = \"floor\"\naxis = \"y\"\nat = 0\n",
                                     100000),
                               {"time.stop_at_rest={ ratio = 1e-8, period = 0.05 }"});
  run(*simulation);
  EXPECT_LT(simulation->time(), 1.5);
  EXPECT_LT(value(*simulation, "kinetic_energy"), 1e-8 * value(*simulation, "strain_energy"));
  ASSERT_EQ(simulation->notes().size(), 1u);
  EXPECT_NE(simulation->notes()[0].find("at rest"), std::string::npos);
}

}  // namespace
}  // namespace crampon::test
