#pragma once
/// Problems of rigid tools on elastic bodies, with cells, E and density of 1, anywhere on the grid and turned against it.

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "run_case.hpp"
#include "scratch_folder.hpp"

namespace crampon::test {

using Plane = std::pair<double, double>;  ///< a point or direction

/// All of a problem, shifted and then turned about the origin.
struct Placement {
  double degrees = 0;
  Plane shift{0, 0};

  Plane direction(double x, double y) const {
    if (degrees == 0) return {x, y};
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    return {c * x - s * y, s * x + c * y};
  }
  Plane point(double x, double y) const { return direction(x + shift.first, y + shift.second); }
  std::string text(const Plane& p) const { return fmt::format("[{:.17g}, {:.17g}]", p.first, p.second); }
  std::string text_of_point(double x, double y) const { return text(point(x, y)); }
  std::string shape(const std::string& of) const {
    std::string placed = of;
    if (shift != Plane{0, 0}) placed = fmt::format("{{ kind = \"translated\", of = {}, by = {} }}", placed, text(shift));
    if (degrees != 0) placed = fmt::format("{{ kind = \"rotated\", of = {}, angle = \"{} deg\", about = [0, 0] }}", placed, degrees);
    return placed;
  }
  /// The components of (x, y) along what was x and y before the turn.
  Plane back(const Plane& p) const {
    const Plane ex = direction(1, 0), ey = direction(0, 1);
    return {p.first * ex.first + p.second * ex.second, p.first * ey.first + p.second * ey.second};
  }
};

inline std::string rectangle(double low_x, double low_y, double high_x, double high_y) {
  return fmt::format("{{ kind = \"rectangle\", low = [{}, {}], high = [{}, {}] }}", low_x, low_y, high_x, high_y);
}
inline std::string disk(double x, double y, double radius) {
  return fmt::format("{{ kind = \"disk\", centre = [{}, {}], radius = {} }}", x, y, radius);
}

struct Head {
  std::string shape_functions = "linear";
  double reach = 20;  ///< the grid goes this far from the origin, in whole cells
  double end = 1, damping = 0;
  std::string law = "\"frictionless\"";
  std::string material = "elastic_large_rotation";
  double nu = 0;
  double cell_height = 1;
};

inline std::string text_of(const Head& h) {
  const double reach = 2 * std::ceil(h.reach / 2);
  return fmt::format(R"(
analysis = "plane_strain"
[grid]
origin = [{0}, {0}]
size = [{1}, {1}]
cell = [1, {8}]
[time]
end = {2}
courant = 0.4
[method]
shape_functions = "{3}"
damping = {4}
[contact]
fields = "bodies"
default = {5}
[[material]]
name = "m"
law = "{6}"
E = 1
nu = {7}
density = 1
)",
                     -reach, 2 * reach, h.end, h.shape_functions, h.damping, h.law, h.material, h.nu, h.cell_height);
}

/// The same in space: the grid from one corner to another, in whole cells.
inline std::string text_in_space(const Head& h, const std::array<int, 3>& low, const std::array<int, 3>& high) {
  return fmt::format(R"(
analysis = "three_dimensional"
[grid]
origin = [{}, {}, {}]
size = [{}, {}, {}]
cell = 1
[time]
end = {}
courant = 0.4
[method]
shape_functions = "{}"
damping = {}
[contact]
fields = "bodies"
default = {}
[[material]]
name = "m"
law = "{}"
E = 1
nu = {}
density = 1
)",
                     low[0], low[1], low[2], high[0] - low[0], high[1] - low[1], high[2] - low[2], h.end, h.shape_functions, h.damping,
                     h.law, h.material, h.nu);
}
inline std::string box(double low_x, double low_y, double low_z, double high_x, double high_y, double high_z) {
  return fmt::format("{{ kind = \"box\", low = [{}, {}, {}], high = [{}, {}, {}] }}", low_x, low_y, low_z, high_x, high_y, high_z);
}

/// A point of a body and the area that its particle stands for.
struct Grain {
  double x, y, area;
};

/// Two particles a cell in each direction, its edges where they are said to be, whatever the grid.
inline std::vector<Grain> grains_of_rectangle(double low_x, double low_y, double high_x, double high_y, double cell_x = 1,
                                              double cell_y = 1) {
  const int across = static_cast<int>(std::lround(2 * (high_x - low_x) / cell_x));
  const int up = static_cast<int>(std::lround(2 * (high_y - low_y) / cell_y));
  const double dx = (high_x - low_x) / across, dy = (high_y - low_y) / up;
  std::vector<Grain> grains;
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < across; ++i) grains.push_back({low_x + (i + 0.5) * dx, low_y + (j + 0.5) * dy, dx * dy});
  return grains;
}

/// In rings about the centre, so that the rim is round.
inline std::vector<Grain> grains_of_disk(double x, double y, double radius, double spacing) {
  std::vector<Grain> grains;
  const int count = static_cast<int>(std::lround(radius / spacing));
  for (int ring = 0; ring < count; ++ring) {
    const double inner = ring * radius / count, outer = (ring + 1) * radius / count, middle = (inner + outer) / 2;
    const int parts = ring == 0 ? 3 : static_cast<int>(std::lround(2 * std::numbers::pi * (ring + 0.5)));
    const double r = ring == 0 ? 0.6 * outer : middle, area = std::numbers::pi * (outer * outer - inner * inner) / parts;
    for (int k = 0; k < parts; ++k) {
      const double angle = 0.37 * ring + 2 * std::numbers::pi * k / parts;  // rings turned against each other
      grains.push_back({x + r * std::cos(angle), y + r * std::sin(angle), area});
    }
  }
  return grains;
}

/// A [[body]] of these particles, which turn with it.
inline std::string body(const Placement& at, const std::vector<Grain>& grains, const std::string& more = "") {
  static const ScratchFolder scratch;
  static int files = 0;
  const std::string path = scratch.path() / fmt::format("body{}.csv", ++files);
  std::ofstream out(path);
  out << "x,y,volume\n";
  for (const Grain& g : grains) {
    const Plane p = at.point(g.x, g.y);
    out << fmt::format("{:.17g},{:.17g},{:.17g}\n", p.first, p.second, g.area);
  }
  return fmt::format("[[body]]\nname = \"body\"\nmaterial = \"m\"\nparticles = \"{}\"\n{}", path, more);
}

/// What a body is made of: a shape, whose surface is known, filled on the grid's lattice, where it is turned with the mass of the shape; or
/// particles from a file that turn with it.
enum class Made { of_shape, of_particles };

/// matched: do particles stand for what the shape has, also where it is not aligned with sub-cells? At an angle they always do.
inline std::string rectangle_body(const Placement& at, Made made, double low_x, double low_y, double high_x, double high_y,
                                  double cell_height = 1, bool matched = false) {
  if (made == Made::of_particles) return body(at, grains_of_rectangle(low_x, low_y, high_x, high_y, 1, cell_height));
  return fmt::format("[[body]]\nname = \"body\"\nmaterial = \"m\"\nmatch_mass = {}\nshape = {}\n", at.degrees != 0 || matched,
                     at.shape(rectangle(low_x, low_y, high_x, high_y)));
}

/// A velocity along (x, y) that rises from nothing and falls to nothing as a triangle, and leads over this way in this time from `start` on.
inline std::string triangle(const Placement& at, double x, double y, double way, double time, double start = 0) {
  const Plane d = at.direction(x, y);
  const auto component = [&](double along) {
    return fmt::format("{{ times = [{0}, {1}, {2}], values = [0, {3:.17g}, 0] }}", start, start + time / 2, start + time,
                       2 * way / time * along);
  };
  return fmt::format("velocity = [{}, {}]\n", component(d.first), component(d.second));
}

constexpr double friction = 0.3;
inline std::string rubbing() { return fmt::format("{{ law = \"coulomb\", friction = {} }}", friction); }

enum class As { shape, wall };  ///< a tool is a [[rigid]] shape, or the [[wall]] that does as well

/// Places of a problem in a cell.
inline std::vector<Plane> places(int count) {
  std::vector<Plane> all;
  for (int k = 0; k < count; ++k) all.push_back({std::fmod(0.13 + 0.37 * k, 1.), (k + 0.05) / count});
  return all;
}

}  // namespace crampon::test
