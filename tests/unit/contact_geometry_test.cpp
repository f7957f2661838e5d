/// Gaps and areas between two materials at a node (contact/edge_map.hpp, separation.hpp).

#include "unit/contact_geometry_cases.hpp"

namespace crampon::test {
namespace {

// Gaps.

TEST(ContactGap, CellAcrossANormal) {
  const Vec<2> cell{{2, 0.5}};
  for (const double angle : {0., 0.3, 1.2, 2.5}) {
    const Vec<2> n{{std::cos(angle), std::sin(angle)}}, t{{-n[1], n[0]}};
    EXPECT_NEAR(perpendicular_cell(cell, n), cell[0] * cell[1] * std::hypot(t[0] / cell[0], t[1] / cell[1]), 1e-15);
  }
  const Vec<3> box{{2, 0.5, 3}};
  for (int k = 0; k < 3; ++k) {
    Vec<3> n;
    n[k] = -1;
    EXPECT_EQ(perpendicular_cell(box, n), box[k]);
    EXPECT_EQ(plane_in_cells(box, n).oblique, 0);
  }
  EXPECT_NEAR(plane_in_cells(Vec<2>{{1, 1}}, Vec<2>{{0.6, 0.8}}).oblique, std::pow(std::sin(2 * std::atan2(0.8, 0.6)), 2), 1e-14);
}

/// Mean position of a continuum with its edge at d, by the midpoint rule.
double mean_position(Shape shape, double d) {
  double sum = 0, weights = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double x = d + (2 - d) * (i + 0.5) / steps, S = profile(shape, x, 0.25).value;
    sum += S * x;
    weights += S;
  }
  return sum / weights;
}

/// What two touching half-spaces read (docs/theory/contact.md, detection).
TEST(ContactGap, InverseOfTheTable) {
  const double raw[3][5] = {{0.667, 0.686, 0.732, 0.797, 0.884}, {0.706, 0.722, 0.768, 0.840, 0.941}, {0.813, 0.826, 0.868, 0.939, 1.034}};
  const Shape of_raw[3] = {LinearShape::boxes, GimpShape::boxes, BsplineShape::boxes};
  for (const Shape shape : shapes) {
    const EdgeMap map = edge_map(shape, 0.25, Packing::continuous);
    for (int i = 0; i < 5; ++i) {
      const double d = 0.2 * i, ahead = mean_position(shape, d), behind = mean_position(shape, -d);
      for (int k = 0; k < 3; ++k) {
        if (shape == of_raw[k]) {
          EXPECT_NEAR(ahead + behind, raw[k][i], 6e-4);
        }
      }
      EXPECT_NEAR(map.edge_distance(ahead), d, 4e-4);
      EXPECT_NEAR(map.edge_distance(behind), -d, 4e-4);
    }
  }
  const EdgeMap linear = edge_map(LinearShape::boxes, 0.25, Packing::continuous);
  for (double d = 0; d < 0.98; d += 0.01) {
    EXPECT_NEAR(linear.edge_distance((1 + 2 * d) / 3), d, 4e-4);
    EXPECT_NEAR(linear.edge_distance((1. / 6 - d * d / 2 + d * d * d / 3) / (1 - (1 - d) * (1 - d) / 2)), -d, 4e-4);
  }
}

TEST(ContactGap, MapsIncreaseWithoutJumps) {
  for (const Shape shape : shapes) {
    for (const double l : {0.5, 0.25, 1. / 6, 0.125, 0.1, 0.05}) {
      const EdgeMap map = edge_map(shape, l);
      for (const double oblique : {0., 0.4, 1.}) {
        const PlaneInCells plane{1, {1, 0, 0}, oblique};
        double before = map.edge_distance(-1, plane);
        for (double p = -1; p < 3; p += 1e-3) {
          const double d = map.edge_distance(p, plane);
          ASSERT_GE(d, before);
          if (p > 0.05) {  // where the node hardly sees the edge the map is steep
            ASSERT_LT(d - before, 0.13);
          }
          before = d;
        }
        EXPECT_NEAR(map.edge_distance(-1, plane) - map.edge_distance(-0.5, plane), -0.5, 1e-12);
        EXPECT_NEAR(map.edge_distance(3.5, plane) - map.edge_distance(3, plane), 0.5, 1e-12);
      }
    }
  }
  EXPECT_NEAR(EdgeMap().edge_distance(0.3), 0.3, 1e-15);
}

struct GapErrors {
  double layers = 0, continuous = 0, rule = 0, particles = 0;
};

/// How far mean positions of touching bodies are apart: the rule of contact.position_cutoff. Each box of a cell more adds a tenth.
double cutoff(Shape shape) { return 0.6 + 0.1 * shape.cell; }

/// Largest |gap| of touching half-planes at nodes where the smaller side has a hundredth of the volume or more.
GapErrors gap_errors(Shape shape, double angle, Rows rows_are) {
  GapErrors e;
  const EdgeMap layers = edge_map(shape, 0.25), continuous = edge_map(shape, 0.25, Packing::continuous);
  for (int trial = -5; trial <= 5; ++trial) {
    const Touching touching{angle, 0.1 * trial, 0.25, rows_are};
    const Vec<2> n = touching.n();
    const PlaneInCells plane = plane_in_cells(unit_cell, n);
    for_nodes(touching.particles(), 4, shape, 0.25, [&](const Vec<2>& node, const View<2>& view) {
      if (view.share() < 0.01) return;
      const double x_a = dot(view.x[0], n), x_b = dot(view.x[1], n);
      e.layers = std::fmax(e.layers, std::fabs(position_gap(x_a, layers, x_b, layers, plane)));
      e.continuous = std::fmax(e.continuous, std::fabs(position_gap(x_a, continuous, x_b, continuous, plane)));
      if (std::fabs(touching.offset - dot(node, n)) < 0.5) e.rule = std::fmax(e.rule, std::fabs(x_b - x_a - cutoff(shape)));
      RegressionGap<2> gap(n);
      for (const Particle<2>& p : view.particles) gap.add(p.x, p.half_edges, p.side);
      e.particles = std::fmax(e.particles, std::fabs(gap.gap()));
    });
  }
  return e;
}

/// Two particles a cell each way.
TEST(ContactGap, TouchingBlocks) {
  for (const Shape shape : shapes) {
    for (const double angle : {0., 15., 30., 45.}) {
      const GapErrors e = gap_errors(shape, angle * degree, Rows::along_line);
      EXPECT_LT(e.layers, angle == 0 ? 1e-12 : shape.smoothness() == 0 ? 0.17 : 0.03);
      EXPECT_LT(e.continuous, 0.2);
      EXPECT_LT(e.rule, 0.14);
      EXPECT_LT(e.particles, 1e-12);
      // A staircase: particles as bodies reach across by their corners.
      const GapErrors stairs = gap_errors(shape, angle * degree, Rows::along_grid);
      // Of a particle functions of domains see the corners alone, which of a staircase lie .1 further in and out.
      EXPECT_LT(stairs.layers, angle == 0 ? 1e-12 : shape.ends > 0 ? 0.31 : 0.19);
      EXPECT_LT(stairs.rule, 0.14) << "st ";
      EXPECT_LT(stairs.particles, angle == 0 ? 1e-12 : 0.71);
    }
  }
}

TEST(ContactGap, BlocksApart) {
  for (const Shape shape : shapes) {
    const EdgeMap map = edge_map(shape, 0.25);
    for (const double gap : {-0.4, -0.1, 0.2, 0.4}) {
      auto particles = Touching{0, 0.2}.particles();
      for (Particle<2>& p : particles) {
        if (p.side == ContactSide::b) p.x[1] += gap;
      }
      const View<2> view = see(particles, {}, unit_cell, shape, 0.25);
      const double found = position_gap(view.x[0][1], map, view.x[1][1], map, plane_in_cells(unit_cell, Vec<2>{{0, 1}}));
      EXPECT_NEAR(found, gap, 2e-3);
    }
  }
}

/// Particles that are longer along one axis than along the other.
TEST(ContactGap, UnlikeParticles) {
  const double unlike[] = {0.25, 0.125};
  const EdgeMap map = EdgeMap(GimpShape::boxes, unlike), longer = edge_map(GimpShape::boxes, 0.25),
                shorter = edge_map(GimpShape::boxes, 0.125);
  const PlaneInCells along_x = plane_in_cells(unit_cell, Vec<2>{{-1, 0}}), along_y = plane_in_cells(unit_cell, Vec<2>{{0, 1}});
  const PlaneInCells between = plane_in_cells(unit_cell, normalized(Vec<2>{{1, 1}}));
  for (double p = -0.5; p < 1.5; p += 0.1) {
    EXPECT_EQ(map.edge_distance(p, along_x), longer.edge_distance(p, along_x));
    EXPECT_EQ(map.edge_distance(p, along_y), shorter.edge_distance(p, along_y));
    const double ends[] = {longer.edge_distance(p, between), shorter.edge_distance(p, between)};
    EXPECT_GE(map.edge_distance(p, between), std::fmin(ends[0], ends[1]));
    EXPECT_LE(map.edge_distance(p, between), std::fmax(ends[0], ends[1]));
  }
}

/// Turned blocks in cells of unlike edges, cubes of particles as seen in units of the cell.
TEST(ContactGap, ThreeDimensions) {
  Random random(5);
  const Vec<3> cell{{1, 2, 0.5}};
  constexpr double l = 0.25;
  for (int trial = 0; trial < 30; ++trial) {
    const Vec<3> m = random.direction<3>(), u = normalized(Vec<3>{{m[1], -m[0], 0}});
    const Vec<3> v{{m[1] * u[2] - m[2] * u[1], m[2] * u[0] - m[0] * u[2], m[0] * u[1] - m[1] * u[0]}};
    const double offset = random.draw(-0.5, 0.5);
    Vec<3> n;
    for (int k = 0; k < 3; ++k) n[k] = m[k] / cell[k];
    n = normalized(n);
    std::vector<Particle<3>> particles;
    for (int i = 0; i < 12 * 12 * 12; ++i) {
      const auto at = [](int row) { return (2 * (row % 12 - 6) + 1) * l; };
      Particle<3> p;
      p.side = at(i) < 0 ? ContactSide::a : ContactSide::b;
      p.x = m * (offset + at(i)) + u * at(i / 12) + v * at(i / 144);
      p.half_edges = {m * l, u * l, v * l};
      for (int k = 0; k < 3; ++k) {
        p.x[k] *= cell[k];
        for (auto& r : p.half_edges) r[k] *= cell[k];
      }
      particles.push_back(p);
    }
    const PlaneInCells plane = plane_in_cells(cell, n);
    for (const Shape shape : shapes) {
      const EdgeMap map = edge_map(shape, l);
      const View<3> view = see(particles, {}, cell, shape, l);
      EXPECT_LT(degrees_between(logistic_normal(view.points, cell), n), 8);
      EXPECT_NEAR(position_gap(dot(view.x[0], n), map, dot(view.x[1], n), map, plane) / plane.h, 0, shape.smoothness() == 0 ? 0.08 : 0.03);
      RegressionGap<3> gap(n);
      for (const Particle<3>& p : view.particles) gap.add(p.x, p.half_edges, p.side);
      EXPECT_NEAR(gap.gap(), 0, 1e-12);
      EXPECT_NEAR(gap.end_of_a(), offset * plane.h, 1e-12);
      const double area = contact_area(view.V[0], dot(view.x[0], n), map, view.V[1], dot(view.x[1], n), map, plane);
      EXPECT_NEAR(area / ((view.V[0] + view.V[1]) * map.area_at(offset, plane) / plane.h), 1, 0.1);
    }
  }
}

// Areas.

/// The nodes' areas add up to the length of the interface, also where it gapes.
TEST(ContactArea, OfStraightInterface) {
  for (const Shape shape : shapes) {
    const EdgeMap map = edge_map(shape, 0.25);
    for (const double angle : {0., 15., 30., 45.}) {
      for (const Rows rows_are : {Rows::along_line, Rows::along_grid}) {
        for (const double gape : {0., 0.1, 0.3}) {
          for (int trial = -2; trial <= 2; ++trial) {
            const Touching touching{angle * degree, 0.25 * trial + 0.02, 0.25, rows_are};
            const Vec<2> n = touching.n();
            std::vector<Particle<2>> particles = touching.particles(9);
            for (Particle<2>& p : particles) p.x += n * (p.side == ContactSide::a ? -0.5 * gape : 0.5 * gape);
            const PlaneInCells plane = plane_in_cells(unit_cell, n);
            double area = 0;
            for_nodes(particles, 7, shape, 0.25, [&](const Vec<2>& node, const View<2>& view) {
              const double weight = std::clamp(5 - std::fabs(dot(node, touching.t())), 0., 1.) / 9;  // soft ends
              area += weight * contact_area(view.V[0], dot(view.x[0], n), map, view.V[1], dot(view.x[1], n), map, plane);
            });
            // Linear functions see whole particles or none.
            EXPECT_NEAR(area, 1, shape.smoothness() == 0 ? 0.2 : gape > 0 ? 0.16 : 0.08) << angle << " degrees, gap " << gape;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace crampon::test
