#pragma once
/// Shapes and grids that several tests of the geometry share.

#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "crampon/geometry/boxes.hpp"
#include "crampon/geometry/combine.hpp"
#include "crampon/geometry/fill.hpp"
#include "crampon/geometry/flats.hpp"
#include "crampon/geometry/placed.hpp"
#include "crampon/geometry/polygon.hpp"
#include "crampon/geometry/round.hpp"
#include "crampon/geometry/solids.hpp"

namespace crampon::testing {

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T, class... Args>
RegionPtr make(Args&&... args) {
  return std::make_shared<T>(std::forward<Args>(args)...);
}

struct Named {
  std::string name;
  RegionPtr shape;
};

inline Corners loop(std::initializer_list<std::pair<double, double>> corners) {
  Corners out;
  for (const auto& [x, y] : corners) out.push_back({{x, y}});
  return out;
}

// About one across, around the origin, none aligned with the lattices below; every kind of bounded shape, and placed ones.
inline const Corners notched = loop({{-.55, -.5}, {.5, -.45}, {.6, .5}, {.05, -.05}, {-.45, .55}});
inline const Corners notched_hole = loop({{-.3, -.3}, {-.05, -.32}, {-.25, -.1}});

inline std::vector<Named> plane_shapes() {
  const RegionPtr polygon = make<Polygon>(notched, std::vector<Corners>{notched_hole});
  return {{"rectangle", make<Rectangle>(Vec<2>{{-.52, -.31}}, Vec<2>{{.47, .44}})},
          {"disk", make<Disk>(Vec<2>{{.013, -.021}}, .513)},
          {"ellipse", make<Ellipse>(Vec<2>{{.01, .02}}, Vec<2>{{.55, .21}}, .6)},
          {"tall ellipse", make<Ellipse>(Vec<2>{{.01, .02}}, Vec<2>{{.2, .57}})},
          {"ring", make<Ring>(Vec<2>{{.017, -.01}}, .27, .55)},
          {"sector", make<Sector>(Vec<2>{{-.1, -.2}}, .7, .3, 1.9)},
          {"wide sector", make<Sector>(Vec<2>{{.02, .03}}, .52, -.7, 4.1)},
          {"polygon", polygon},
          {"turned polygon", make<Rotated>(polygon, .4, Vec<3>{{.1, .05, 0}})},
          {"shifted, turned rectangle",
           make<Translated>(make<Rotated>(make<Rectangle>(Vec<2>{{-.4, -.2}}, Vec<2>{{.5, .3}}), 1., Vec<3>{}), Vec<3>{{.04, -.03, 0}})}};
}

inline std::vector<Named> solid_shapes() {
  const RegionPtr box = make<Box>(Vec<3>{{-.5, -.3, -.41}}, Vec<3>{{.45, .4, .33}});
  return {{"box", box},
          {"sphere", make<Sphere>(Vec<3>{{.01, -.02, .03}}, .52)},
          {"cylinder", make<Cylinder>(Vec<3>{{-.3, -.2, -.25}}, Vec<3>{{.35, .25, .2}}, .3)},
          {"turned box", make<Rotated>(box, .7, Vec<3>{{.05, 0, 0}}, Vec<3>{{1, 2, -1}})}};
}

inline std::vector<Named> all_shapes() {
  std::vector<Named> all = plane_shapes();
  for (Named& s : solid_shapes()) all.push_back(s);
  all.push_back({"union", make<Union>(std::vector<RegionPtr>{all[0].shape, all[1].shape})});
  all.push_back({"intersection", make<Intersection>(std::vector<RegionPtr>{all[1].shape, all[2].shape})});
  all.push_back({"difference", make<Difference>(all[0].shape, std::vector<RegionPtr>{all[2].shape})});
  all.push_back({"half-plane", make<HalfPlane>(Vec<3>{{.1, .2, 0}}, Vec<3>{{3, -4, 0}}, 2)});
  all.push_back({"half-space", make<HalfPlane>(Vec<3>{{.1, .2, .3}}, Vec<3>{{1, -2, 2}}, 3)});
  all.push_back({"point", make<Point>(Vec<3>{{.1, .2, .3}}, 3)});
  all.push_back({"line", make<Line>(Vec<3>{{-.1, .2, 0}}, Vec<3>{{.4, -.2, 0}}, 2)});
  return all;
}

// Cells of size `cell` over [-1, 1] in each axis.
inline FillGrid grid_around_origin(int dimension, int cells_per_unit) {
  const double h = 1. / cells_per_unit;
  const int n = 2 * cells_per_unit;
  return {dimension, {{-1, -1, dimension == 3 ? -1. : 0.}}, {{h, h, h}}, {{n, n, dimension == 3 ? n : 1}}};
}

inline double total(const std::vector<FilledParticle>& particles) {
  double sum = 0;
  for (const FilledParticle& p : particles) sum += p.measure;
  return sum;
}

}  // namespace crampon::testing
