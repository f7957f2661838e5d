/// Symmetry planes: half a model does what the whole one does, and a plane's reaction is the rate at which it changes the particles' momentum.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "run_case.hpp"

namespace crampon::test {
namespace {

/// A grid of square cells about the origin, in 2D or 3D, with a soft material: waves of about 35 m/s, so that steps strain a lot.
std::string setting(int dim, const std::string& low, const std::string& size, double cell, int steps, const std::string& shape_functions,
                    const std::string& contact, const std::string& method = {}) {
  return fmt::format(R"in(
analysis = "{}"
[grid]
origin = {}
size = {}
cell = {}
[time]
steps = {}
courant = 0.4
[method]
shape_functions = "{}"
{}
[contact]
{}
[[material]]
name = "m"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[material]]
name = "n"
law = "neo_hookean"
E = 4e5
nu = 0.2
density = 700
)in",
                     dim == 3 ? "three_dimensional" : "plane_strain", low, size, cell, steps, shape_functions, method, contact);
}

std::string body(const std::string& name, const std::string& material, const std::string& shape, const std::string& velocity) {
  return fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nshape = {}\nvelocity = {}\n", name, material, shape, velocity);
}

std::string plane(const std::string& name, const std::string& axis, double at = 0, const std::string& more = {}) {
  return fmt::format("[[symmetry]]\nname = \"{}\"\naxis = \"{}\"\nat = {}\n{}\n", name, axis, at, more);
}

// ---- reactions

struct Reaction {
  std::string shape_functions;
  int dim;
  std::string method;
};
void PrintTo(const Reaction& r, std::ostream* out) { *out << r.shape_functions << ", " << r.dim << "D " << r.method; }

class SymmetryReaction : public testing::TestWithParam<Reaction> {};

/// Two bodies with friction between them, in the corner of planes of which one is in two parts, under weight, a load and a moving wall: in
/// every step the momentum changes by what all of these bring.
TEST_P(SymmetryReaction, IsTheRateOfMomentum) {
  const Reaction& r = GetParam();
  const bool space = r.dim == 3;
  const auto places = [&](const std::string& xy, const char* z) { return fmt::format("[{}{}]", xy, space ? std::string(", ") + z : ""); };
  const auto block = [&](const std::string& low, const std::string& high) {
    return fmt::format("{{ kind = \"{}\", low = {}, high = {} }}", space ? "box" : "rectangle", places(low, "0"), places(high, "0.5"));
  };
  std::string text = setting(r.dim, places("-0.5, -0.5", "-0.5"), places("2.5, 2.5", "1.5"), 0.125, 60, r.shape_functions,
                             "fields = \"bodies\"\ndefault = { law = \"coulomb\", friction = 0.3 }",
                             "body_force = " + places("-20, { expression = \"-30-500*t\" }", "-25") + "\n" + r.method);
  text +=
      body("low", "m", block("0, 0", "1, 0.45"), places("{ expression = \"-x+y\" }, { expression = \"-2*y\" }", "{ expression = \"-z\" }"));
  text += body("high", "n", block("0, 0.45", "0.8, 0.9"), places("-0.5, { expression = \"-3*y+x\" }", "-0.3"));
  text += plane("wall", "x") + plane("floor", "y", 0, "to = " + places("0.55, 0", "inf")) +
          plane("more floor", "y", 0, "from = " + places("0.55, 0", "-inf"));
  if (space) text += plane("back", "z");
  text += "[[load]]\nname = \"push\"\nkind = \"force_each\"\nvalue = " + places("-0.5, -0.25", "-0.75") + "\n";
  text += "[[wall]]\nname = \"lid\"\npoint = " + places("0, 0.95", "0") + "\nnormal = " + places("0, -1", "0") +
          "\nvelocity = " + places("0, -1", "0") + "\n";
  const auto simulation = make(text);
  const PointFrame start = simulation->particles({"mass"});
  double mass = 0;
  for (const double m : field(start, "mass").values) mass += m;
  const std::size_t particles = start.positions.size() / 3;
  const auto count = static_cast<double>(particles);
  const std::array<double, 3> pushed{-0.5 * count, -0.25 * count, -0.75 * count};
  std::array<double, 3> before{};
  const char axes[] = "xyz";
  for (int k = 0; k < r.dim; ++k) before[k] = value(*simulation, fmt::format("momentum_{}", axes[k]));
  double worst = 0, largest_reaction = 0, time = 0;
  run(*simulation, [&](Simulation& s) {
    const double dt = s.time() - time;
    // Of the middle of the step, the time of positions.
    const std::array<double, 3> weight{-20 * mass, (-30 - 500 * (time + 0.5 * dt)) * mass, -25 * mass};
    for (int k = 0; k < r.dim; ++k) {
      double force = weight[k] + pushed[k] + value(s, fmt::format("reaction_{}.lid", axes[k]));
      for (const char* name : {"wall", "floor", "more floor", "back"}) {
        if (!space && name[0] == 'b') continue;
        const double reaction = value(s, fmt::format("reaction_{}.{}", axes[k], name));
        largest_reaction = std::fmax(largest_reaction, std::fabs(reaction));
        force += reaction;
      }
      const double now = value(s, fmt::format("momentum_{}", axes[k]));
      worst = std::fmax(worst, std::fabs(now - before[k] - force * dt) / mass);
      before[k] = now;
    }
    time = s.time();
  });
  RecordProperty("worst", fmt::format("{:.2e}", worst));
  EXPECT_GT(largest_reaction, 30 * mass);  // m/s2: more than the weight
  EXPECT_LT(worst, 1e-13);                 // m/s; round-off of sums that reach 1 to 10 m/s
}

std::vector<Reaction> reactions() {
  std::vector<Reaction> out;
  for (const char* shape : all_shape_functions()) {
    for (const int dim : {2, 3}) {
      for (const char* method : {"", "stress_update = \"usl\"", "stress_update = \"musl\"", "fixed_force = \"n13\""}) {
        if (dim == 2 || *method == 0) out.push_back({shape, dim, method});
      }
    }
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Sweep, SymmetryReaction, testing::ValuesIn(cases_for(Runs::every, reactions())));
INSTANTIATE_TEST_SUITE_P(SweepFull, SymmetryReaction, testing::ValuesIn(cases_for(Runs::full, reactions())));

// ---- half models

/// Largest difference of positions and velocities of the half's particles from the whole's, over size and speed of 1 m and 1 m/s.
double apart(const std::string& whole_text, const std::string& half_text) {
  const auto whole = make(whole_text), half = make(half_text);
  const auto places = [](const Simulation& s) { return s.particles({"velocity"}); };
  const PointFrame whole_start = places(*whole), half_start = places(*half);
  std::map<std::array<long, 3>, std::size_t> of_whole;
  const auto key = [](const PointFrame& f, std::size_t p) {
    std::array<long, 3> k;
    for (std::size_t d = 0; d < 3; ++d) k[d] = std::lround(f.positions[3 * p + d] * 1e6);
    return k;
  };
  for (std::size_t p = 0; p < whole_start.positions.size() / 3; ++p) of_whole[key(whole_start, p)] = p;
  run(*whole);
  run(*half);
  const PointFrame whole_end = places(*whole), half_end = places(*half);
  const DataArray &v = field(whole_end, "velocity"), &w = field(half_end, "velocity");
  double worst = 0, moved = 0;
  for (std::size_t p = 0; p < half_start.positions.size() / 3; ++p) {
    const auto at = of_whole.find(key(half_start, p));
    if (at == of_whole.end()) return HUGE_VAL;
    for (std::size_t d = 0; d < 3; ++d) {
      worst = std::fmax(worst, std::fabs(whole_end.positions[3 * at->second + d] - half_end.positions[3 * p + d]));
      worst = std::fmax(worst, std::fabs(v.values[3 * at->second + d] - w.values[3 * p + d]));
      moved = std::fmax(moved, std::fabs(half_end.positions[3 * p + d] - half_start.positions[3 * p + d]));
    }
  }
  return moved > 1e-3 ? worst : HUGE_VAL;
}

struct Bodies {
  std::string shape_functions;
  int dim;
  std::string contact;
};
void PrintTo(const Bodies& b, std::ostream* out) { *out << b.shape_functions << ", " << b.dim << "D, " << b.contact; }

class HalfModel : public testing::TestWithParam<Bodies> {};

/// A ball falls on a block; both are cut by the plane x = 0 and, in 3D, by z = 0, so that each half alone sees normals with a component
/// across.
std::string ball_on_block(const Bodies& b, bool half, int steps) {
  const bool space = b.dim == 3;
  const double left = half ? 0 : -0.75;
  const auto places = [&](double x, double y, double z) {
    return space ? fmt::format("[{}, {}, {}]", x, y, z) : fmt::format("[{}, {}]", x, y);
  };
  const auto cut = [&](const std::string& shape) {
    return fmt::format("{{ kind = \"intersection\", of = [{}, {{ kind = \"{}\", low = {}, high = {} }}] }}", shape,
                       space ? "box" : "rectangle", places(left, -1, left), places(2, 2, 2));
  };
  const std::string velocity =
      space ? "[{ expression = \"x*(1+y)\" }, -3, { expression = \"-0.5*z*(1+y)\" }]" : "[{ expression = \"x*(1+y)\" }, -3]";
  std::string text =
      setting(b.dim, places(-1, -0.75, -1), places(2, 1.75, 2), 0.125, steps, b.shape_functions, "fields = \"bodies\"\n" + b.contact);
  text += body(
      "ball", "n",
      cut(space ? "{ kind = \"sphere\", centre = [0, 0.42, 0], radius = 0.4 }" : "{ kind = \"disk\", centre = [0, 0.42], radius = 0.4 }"),
      velocity);
  text += body("block", "m",
               cut(fmt::format("{{ kind = \"{}\", low = {}, high = {} }}", space ? "box" : "rectangle", places(-0.75, -0.5, -0.75),
                               places(0.75, 0.03, 0.75))),
               places(0, 0, 0));
  if (half) text += plane("mirror", "x") + (space ? plane("other mirror", "z") : "");
  return text;
}

TEST_P(HalfModel, OfTwoBodiesIsTheWhole) {
  const int steps = GetParam().dim == 2 ? 60 : 20;
  const double worst = apart(ball_on_block(GetParam(), false, steps), ball_on_block(GetParam(), true, steps));
  RecordProperty("worst", fmt::format("{:.2e}", worst));
  // The gradient of the body with more volume nearly cancels at some nodes in space, and its direction is that of the rest: 1.7e-10.
  const bool cancels = GetParam().contact.find("more_volume") != std::string::npos;
  // Domains that stretch carry it on: 2.9e-8.
  EXPECT_LT(worst, !cancels ? 1e-10 : has_domains(kind_of_word(GetParam().shape_functions)) ? 1e-7 : 1e-9);
}

std::vector<Bodies> bodies() {
  std::vector<Bodies> out;
  for (const int dim : {2, 3}) {
    for (const char* shape : all_shape_functions()) {
      for (const char* contact :
           {"normal = \"logistic_regression\"\ndefault = { law = \"coulomb\", friction = 0.3 }",
            "normal = \"linear_regression\"\ndefault = { law = \"coulomb\", friction = 0.3 }",
            "normal = \"largest_gradient\"\ndefault = { law = \"coulomb\", friction = 0.3 }",
            "normal = \"average_gradient\"\ndefault = \"stick\"", "normal = \"more_volume\"\ndefault = \"frictionless\"",
            "material_detection = \"regression\"\ndefault = { law = \"coulomb\", friction = 0.3 }",
            "material_detection = \"volume\"\nreference_volume = \"cell\"\ndefault = \"frictionless\"",
            "default = { law = \"adhesive\", friction = 0.3, shear_strength = 2000, normal_strength = 3000 }",
            "default = { law = \"coulomb\", friction = 0.3, strength = 1000 }",
            "default = { law = \"interface\", tangential = 1e6, tension = 1e7, compression = 1e7 }"}) {
        out.push_back({shape, dim, contact});
      }
    }
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Sweep, HalfModel, testing::ValuesIn(cases_for(Runs::every, bodies())));
INSTANTIATE_TEST_SUITE_P(SweepFull, HalfModel, testing::ValuesIn(cases_for(Runs::full, bodies())));

struct Cracked {
  std::string shape_functions;
  std::string axis;     ///< across the mirror
  std::string contact;  ///< law of the crack
  std::string start;    ///< of the crack: height over the mirror and place along it
  std::string end;
  bool joined = true;  ///< the crack ends on the mirror
};
void PrintTo(const Cracked& c, std::ostream* out) {
  *out << c.shape_functions << ", mirror across " << c.axis << ", " << c.contact << ", " << c.start << " to " << c.end;
}

class HalfCrack : public testing::TestWithParam<Cracked> {};

/// A block with a crack oblique to the mirror, pressed and sheared.
std::string cracked_block(const Cracked& c, bool half, int steps) {
  const bool x = c.axis == "x";
  const auto places = [&](const std::string& across, const std::string& along) {
    return x ? fmt::format("[{}, {}]", across, along) : fmt::format("[{}, {}]", along, across);
  };
  const auto point = [&](const std::string& at, const char* sign) {
    const auto comma = at.find(',');
    return places(sign + at.substr(0, comma), at.substr(comma + 1));
  };
  const std::string across = x ? "x" : "y", along = x ? "y" : "x";
  std::string text = setting(2, "[-1.25, -1.25]", "[2.5, 2.5]", 0.125, steps, c.shape_functions, "");
  text += body("block", "m",
               "{ kind = \"rectangle\", low = " + places(half ? "0" : "-0.9375", "-0.875") + ", high = " + places("0.9375", "0.875") + " }",
               places("{ expression = \"-" + across + "*(4+3*" + along + ")\" }",
                      "{ expression = \"-5*" + along + "+3*" + across + "*" + across + "\" }"));
  const std::string more = "contact = " + c.contact + "\n";
  if (half) {
    text += plane("mirror", c.axis) + "[[crack]]\npoints = [" + point(c.start, "") + ", " + point(c.end, "") + "]\n" + more;
  } else if (c.joined) {
    text += "[[crack]]\npoints = [" + point(c.end, "-") + ", " + point(c.start, "") + ", " + point(c.end, "") + "]\n" + more;
  } else {
    text += "[[crack]]\npoints = [" + point(c.start, "") + ", " + point(c.end, "") + "]\n" + more;
    text += "[[crack]]\npoints = [" + point(c.end, "-") + ", " + point(c.start, "-") + "]\n" + more;
  }
  return text;
}

TEST_P(HalfCrack, IsTheWhole) {
  const double worst = apart(cracked_block(GetParam(), false, 60), cracked_block(GetParam(), true, 60));
  RecordProperty("worst", fmt::format("{:.2e}", worst));
  EXPECT_LT(worst, 1e-10);
}

std::vector<Cracked> cracks() {
  std::vector<Cracked> out;
  for (const char* shape : all_shape_functions()) {
    for (const char* axis : {"x", "y"}) {
      for (const char* law : {"{ law = \"coulomb\", friction = 0.2 }", "\"frictionless\"", "\"stick\"",
                              "{ law = \"interface\", tangential = 1e6, tension = 1e7, compression = 1e7 }"}) {
        out.push_back({shape, axis, law, "0, 0.03", "0.6, 0.41", true});
      }
      const std::string law = "{ law = \"coulomb\", friction = 0.2 }";
      out.push_back({shape, axis, law, "0, 0.0625", "0.07, 0.11", true});  // its tip within a cell of the mirror
      for (const char* end : {"0.6, 0.41", "0.6, 0", "0.5, 0.6", "0.3, 0.7"}) {
        out.push_back({shape, axis, law, "0, 0.03", end, true});
        // Begins on a node. Not along a diagonal through nodes: those that lie on it count as below, left and right, where an image counts as above.
        out.push_back({shape, axis, law, "0, 0", end, true});
      }
      // Beside the mirror: fields count mass and momentum, whatever they are called.
      out.push_back({shape, axis, "\"bonded\"", "0.03, -0.91", "0.045, 0.93", false});
      out.push_back({shape, axis, "\"bonded\"", "0.02, -0.3", "0.4, 0.2", false});
    }
  }
  return out;
}
INSTANTIATE_TEST_SUITE_P(Sweep, HalfCrack, testing::ValuesIn(cases_for(Runs::every, cracks())));
INSTANTIATE_TEST_SUITE_P(SweepFull, HalfCrack, testing::ValuesIn(cases_for(Runs::full, cracks())));

}  // namespace
}  // namespace crampon::test
