#pragma once
/// A body on a floor along the grid, under gravity that leans, followed in time.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "run_case.hpp"

namespace crampon::test {

constexpr double g = 9.81, pi = std::numbers::pi;

inline double radians(double degrees) { return degrees * pi / 180; }

/// Rises from 0 to 1 in the time T, s, as a cosine; stays there.
inline std::string eased(double T) { return fmt::format("(t < {0} ? (1 - cos(_pi*t/{0}))/2 : 1)", T); }
inline double eased_at(double t, double T) { return t < T ? 0.5 * (1 - std::cos(pi * t / T)) : 1; }

/// A body of 1000 kg/m3, nu = .3 and unit depth on a floor at y = 0, its left end at x = 0.
struct OnFloor {
  double width = 0.032, height = 0.008, cell = 0.002;  // m
  double E = 1e6, nu = 0.3;                            // Pa
  std::string shape_functions = "bspline";
  std::string floor = "wall";         ///< or rigid, or a deformable body
  double floor_stiffness = 1;         ///< of a deformable floor, over that of the body; so is its density
  bool floor_normal_is_given = true;  ///< ... and whether contact is told that it is level
  std::string law = "\"frictionless\"";
  std::string gravity_x = "0", gravity_y = fmt::format("{}", -g);  // m/s2
  std::string damping = "0";                                       // 1/s
  double velocity = 0;                                             // m/s
  double end = 0.04;                                               // s
  double room = 0.024;                                             // m, to slide
  std::string body = "";                                           ///< what the body is made of, when it is not a block
  int particles_per_cell = 2;
  std::string more = "";
};

inline std::string input(const OnFloor& s) {
  const double low_x = -4 * s.cell, high_x = std::ceil((s.width + s.room) / s.cell + 4) * s.cell, deep = 3 * s.cell;
  const double high_y = std::ceil(s.height / s.cell + 3) * s.cell;
  std::string text = fmt::format(R"(
analysis = "plane_strain"
[grid]
origin = [{}, {}]
size = [{}, {}]
cell = {}
[time]
end = {}
courant = 0.4
[method]
shape_functions = "{}"
damping = {}
body_force = [{{ expression = "{}" }}, {{ expression = "{}" }}]
[contact]
fields = "bodies"
default = {}
[[material]]
name = "soft"
law = "elastic_large_rotation"
E = {}
nu = {}
density = 1000
)",
                                 low_x, -deep, high_x - low_x, high_y + deep, s.cell, s.end, s.shape_functions, s.damping, s.gravity_x,
                                 s.gravity_y, s.law, s.E, s.nu);
  text += fmt::format(
      "[[body]]\nname = \"body\"\nmaterial = \"soft\"\nvelocity = [{}, 0]\nparticles_per_cell = [{}]\n{}\n", s.velocity,
      s.particles_per_cell,
      !s.body.empty() ? s.body : fmt::format("shape = {{ kind = \"rectangle\", low = [0, 0], high = [{}, {}] }}", s.width, s.height));
  if (s.floor == "wall") {
    text += "[[wall]]\nname = \"floor\"\npoint = [0, 0]\nnormal = [0, 1]\n";
  } else {
    const double margin = s.floor == "rigid" ? 0 : s.cell;
    const std::string shape =
        fmt::format("shape = {{ kind = \"rectangle\", low = [{}, {}], high = [{}, 0] }}\n", low_x + margin, -deep, high_x - margin);
    if (s.floor == "rigid") {
      text += "[[rigid]]\nname = \"floor\"\n" + shape;
    } else {
      text += fmt::format("[[material]]\nname = \"base\"\nlaw = \"elastic_large_rotation\"\nE = {}\nnu = {}\ndensity = {}\n",
                          s.floor_stiffness * s.E, s.nu, s.floor_stiffness * 1000);
      text += "[[body]]\nname = \"floor\"\nmaterial = \"base\"\n" + shape;
      text += fmt::format(
          "[[boundary]]\nname = \"hold\"\nregion = {{ kind = \"rectangle\", low = [{}, {}], high = [{}, {}] }}\nvx = 0\nvy = 0\n", low_x,
          -deep, high_x, -deep);
      text += fmt::format("[[contact_pair]]\nbetween = [\"body\", \"floor\"]\ncontact = {}\n{}", s.law,
                          s.floor_normal_is_given ? "normal = [0, -1]\n" : "");
    }
  }
  return text + s.more;
}

inline std::string coulomb(double friction) { return fmt::format("{{ law = \"coulomb\", friction = {} }}", friction); }

/// The body in time.
struct Motion {
  std::vector<double> t, v, fall;              ///< s; m/s, along the floor and normal to it
  std::vector<double> x;                       ///< m, mean displacement along the floor, where asked for
  std::vector<double> reaction_x, reaction_y;  ///< N, of a rigid floor
  std::vector<double> spin;                    ///< kg m2/s, angular momentum about the centre of mass, where asked for
  double mass = 0;                             ///< kg
  std::unique_ptr<Simulation> simulation;

  double at_end(const std::string& column) const { return value(*simulation, column); }
  std::size_t first(double time) const { return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time) - t.begin()); }
};

enum class Places { no, yes };

inline Motion follow(const OnFloor& setup, Places places = Places::no) {
  Motion motion;
  motion.simulation = make(input(setup));
  std::vector<double> mass, mine;
  {
    const PointFrame frame = motion.simulation->particles({"mass"});
    mass = field(frame, "mass").values.doubles();
    mine = field(frame, "body").values.doubles();
    for (std::size_t p = 0; p < mass.size(); ++p) {
      if (mine[p] != 0) mass[p] = 0;
      motion.mass += mass[p];
    }
  }
  const auto note = [&](Simulation& s) {
    motion.t.push_back(s.time());
    if (setup.floor != "body") {
      motion.reaction_x.push_back(value(s, "reaction_x.floor"));
      motion.reaction_y.push_back(value(s, "reaction_y.floor"));
    }
    if (places == Places::no && setup.floor != "body") {
      motion.v.push_back(value(s, "momentum_x") / motion.mass);
      motion.fall.push_back(value(s, "momentum_y") / motion.mass);
      return;
    }
    const PointFrame frame = s.particles({"velocity", "displacement"});
    const auto &v = field(frame, "velocity").values, &u = field(frame, "displacement").values, &x = frame.positions;
    double way = 0, L = 0, X[2] = {}, P[2] = {};
    for (std::size_t p = 0; p < mass.size(); ++p) {
      for (std::size_t k = 0; k < 2; ++k) X[k] += mass[p] * x[3 * p + k], P[k] += mass[p] * v[3 * p + k];
      L += mass[p] * (x[3 * p] * v[3 * p + 1] - x[3 * p + 1] * v[3 * p]);
      way += mass[p] * u[3 * p];
    }
    motion.v.push_back(P[0] / motion.mass);
    motion.fall.push_back(P[1] / motion.mass);
    motion.x.push_back(way / motion.mass);
    motion.spin.push_back(L - (X[0] * P[1] - X[1] * P[0]) / motion.mass);
  };
  note(*motion.simulation);
  run(*motion.simulation, note);
  return motion;
}

/// Slope by least squares of what lies between two times.
inline double slope(const Motion& m, const std::vector<double>& y, double from, double to = HUGE_VAL) {
  double n = 0, st = 0, stt = 0, sy = 0, sty = 0;
  for (std::size_t i = m.first(from); i < m.t.size() && m.t[i] <= to; ++i) {
    const double t = m.t[i] - from;
    n += 1, st += t, stt += t * t, sy += y[i], sty += t * y[i];
  }
  return (n * sty - st * sy) / (n * stt - st * st);
}

}  // namespace crampon::test
