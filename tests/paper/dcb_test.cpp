/// The double cantilever beam of N03 section 3.1 at rest against our own static 4-node finite elements on the same grid
/// (tests/oracle/static_fe.py): N03 Fig. 2 and validation row 3.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "run_case.hpp"

namespace crampon::test {
namespace {

struct Profile {
  std::vector<double> x, stress, opening;
};

Profile finite_elements(int h_mm) {
  std::ifstream file(fmt::format("{}/tests/oracle/data/dcb_fe_h{}.csv", CRAMPON_SOURCE_DIR, h_mm));
  Profile p;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    double x = 0, s = 0, u = 0;
    char comma = 0;
    if (!(row >> x >> comma >> s >> comma >> u)) continue;  // comments and the header
    p.x.push_back(x);
    p.stress.push_back(s);
    p.opening.push_back(u);
  }
  return p;
}

/// sigma_xx of the upper half's particles, taken to the nodes of the mid-plane with their masses and linear shape functions, as N03 did.
std::vector<double> mid_plane_stress(const PointFrame& frame, const std::vector<double>& x_i, double h) {
  std::vector<double> weight(x_i.size(), 0), sum(x_i.size(), 0);
  const auto &u = field(frame, "displacement").values, &s = field(frame, "stress").values;
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p) {
    const double X = frame.positions[3 * p] - u[3 * p], Y = frame.positions[3 * p + 1] - u[3 * p + 1];
    if (Y < 0 || Y > h) continue;
    for (std::size_t i = 0; i < x_i.size(); ++i) {
      const double d = std::fabs(X - x_i[i]) / h;
      if (d >= 1) continue;
      weight[i] += (1 - d) * (1 - Y / h);
      sum[i] += (1 - d) * (1 - Y / h) * s[6 * p];
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= weight[i];
  return sum;
}

struct Rest {
  double opening = 0, stress_error = 0;
};

Rest at_rest(int h_mm, const char* shape_functions) {
  const double h = 1e-3 * h_mm;
  const auto simulation = Simulation::create(read_problem(fmt::format("{}/examples/paper/dcb.toml", CRAMPON_SOURCE_DIR),
                                                          {fmt::format("grid.cell=\"{} mm\"", h_mm),
                                                           fmt::format("method.shape_functions=\"{}\"", shape_functions), "time.end=0.35"}),
                                             1);
  run(*simulation);
  const Profile fe = finite_elements(h_mm);
  const std::vector<double> mpm = mid_plane_stress(simulation->particles(), fe.x, h);
  Rest rest;
  rest.opening = value(*simulation, "mouth.displacement_y");
  double difference = 0, scale = 0;
  for (std::size_t i = 0; i < fe.x.size(); ++i) {
    if (std::fabs(fe.x[i] - 0.05) < 2 * h + 1e-9) continue;  // two cells of the tip: N03's own curves part there
    difference += (mpm[i] - fe.stress[i]) * (mpm[i] - fe.stress[i]);
    scale += fe.stress[i] * fe.stress[i];
  }
  rest.stress_error = std::sqrt(difference / scale);
  return rest;
}

TEST(DoubleCantileverBeam, AgreesWithStaticFiniteElements) {
  for (const char* shape : {"linear", "gimp"}) {
    const Rest rest = at_rest(2, shape);
    RecordProperty(fmt::format("stress_error_{}", shape), fmt::format("{:.4f}", rest.stress_error));
    fmt::print("{}: mouth {:.4f} mm, L2 of sigma_xx {:.4f}\n", shape, rest.opening * 1e3, rest.stress_error);
    EXPECT_LT(rest.stress_error, 0.05) << shape;                    // the bound
    EXPECT_NEAR(rest.opening, 0.652e-3, 0.06 * 0.652e-3) << shape;  // row 3 at h = 2 mm
  }
}

TEST(DoubleCantileverBeamFull, ConvergesAtTwoGrids) {
  const Rest coarse = at_rest(2, "gimp"), fine = at_rest(1, "gimp");
  fmt::print("mouth {:.4f} and {:.4f} mm, L2 {:.4f} and {:.4f}\n", coarse.opening * 1e3, fine.opening * 1e3, coarse.stress_error,
             fine.stress_error);
  EXPECT_NEAR(fine.opening, 0.652e-3, 0.03 * 0.652e-3);                                   // row 3 at h = 1 mm
  EXPECT_LT(std::fabs(fine.opening - 0.6588e-3), std::fabs(coarse.opening - 0.6588e-3));  // finite elements extrapolated to h = 0
  EXPECT_LT(fine.stress_error, 0.05);
}

}  // namespace
}  // namespace crampon::test
