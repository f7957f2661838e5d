#include <gtest/gtest.h>
// After gtest.h.
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "crampon/geometry/particles_csv.hpp"
#include "scratch_folder.hpp"

namespace crampon {
namespace {

std::vector<std::string> csv_errors(const std::string& text, int dimension = 2) {
  try {
    parse_particles_csv(text, "p.csv", dimension);
  } catch (const InputError& error) {
    std::vector<std::string> texts;
    for (const Diagnostic& d : error.diagnostics()) texts.push_back(d.text());
    return texts;
  }
  return {};
}

TEST(ParticlesCsv, ReadsColumnsInAnyOrderWithUnits) {
  const auto list = parse_particles_csv(
      "# a body\r\n\r\n volume[mm3] , y[mm],x, vy, vx[mm/s] \r\n1e-3, 18,+0.1,-2,3 # first\r\n\r\n  # nothing\r\n2,36,.2,0,0\r\n", "p.csv",
      2);
  ASSERT_EQ(list.particles.size(), 2u);
  EXPECT_TRUE(list.has_velocity);
  EXPECT_EQ(list.particles[0].position, (Vec<3>{{.1, .018, 0}}));
  EXPECT_EQ(list.particles[0].volume, 1e-12);
  EXPECT_EQ(list.particles[0].velocity, (Vec<3>{{.003, -2, 0}}));
  EXPECT_EQ(list.particles[0].line, 4);
  EXPECT_EQ(list.particles[1].line, 7);
  const auto space = parse_particles_csv("\xEF\xBB\xBFz,y,x,volume\n3,2,1,4", "p.csv", 3);
  EXPECT_FALSE(space.has_velocity);
  EXPECT_EQ(space.particles.at(0).position, (Vec<3>{{1, 2, 3}}));
}

RC_GTEST_PROP(ParticlesCsvProperty, KeepsEveryBit, (const std::vector<std::uint64_t>& bits)) {
  std::vector<double> values{.1, 1. / 3, 5e-324, 1.7976931348623157e308};
  for (const std::uint64_t b : bits)
    if (const double v = std::bit_cast<double>(b); std::isfinite(v)) values.push_back(v);
  std::string text = "x,y,volume\n";
  const auto written = [](double v) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.17g", v);
    return std::string(buffer);
  };
  for (const double v : values) text += written(v) + "," + written(-v) + ",1\n";
  const auto list = parse_particles_csv(text, "p.csv", 2);
  RC_ASSERT(list.particles.size() == values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    RC_ASSERT(std::bit_cast<std::uint64_t>(list.particles[k].position[0]) == std::bit_cast<std::uint64_t>(values[k]));
    RC_ASSERT(list.particles[k].position[1] == -values[k]);
  }
}

TEST(ParticlesCsv, TellsAllErrorsWithTheirPlaces) {
  const auto errors = csv_errors("# c\nx,y,volume\n1,2,3\n1, abc ,3\n1,nan,-3\r\n1,2\n1,2,3,4\n1,,0\n1e999,2mm,3\n");
  ASSERT_EQ(errors.size(), 9u);
  EXPECT_EQ(errors[0],
            "p.csv:4:4: y: \"abc\" is not a number (every value is a plain decimal number); write it as 1.5 or 1.5e-3, with the "
            "unit in the header as name[unit]");
  EXPECT_EQ(errors[1], "p.csv:5:3: y: nan is not finite (a particle has a place, a volume and a velocity); write a finite number");
  EXPECT_EQ(errors[2], "p.csv:5:7: volume: the volume is negative (-3 leaves the particle without mass); give a volume above 0");
  EXPECT_EQ(errors[3],
            "p.csv:6:4: 2 values where the header names 3 columns (it is not clear which is which); give one value for each column");
  EXPECT_EQ(errors[4].substr(0, 20), "p.csv:7:7: 4 values ");
  EXPECT_EQ(errors[5].substr(0, 33), "p.csv:8:3: y: the value is missin");
  EXPECT_EQ(errors[6].substr(0, 38), "p.csv:8:4: volume: the volume is zero ");
  EXPECT_EQ(errors[7].substr(0, 41), "p.csv:9:1: x: 1e999 does not fit a double");
  EXPECT_EQ(errors[8].substr(0, 39), "p.csv:9:7: y: \"2mm\" is not a number (ev");
}

TEST(ParticlesCsv, ReportsHeadersAndFiles) {
  EXPECT_EQ(csv_errors("").at(0),
            "p.csv: the file has no header line (it is empty or all comments); start it with a line such as \"x,y,volume\"");
  EXPECT_EQ(csv_errors("# only\n").size(), 1u);
  EXPECT_EQ(csv_errors("x,y,volume\n# none\n").at(0),
            "p.csv: the file has no particles (a body needs at least one); add a line for each particle below the header");
  EXPECT_EQ(csv_errors("x,y,z,volume\n1,2,3,4").at(0).substr(0, 57), "p.csv:1:5: \"z\" is not a column of a particle file (the pr");
  EXPECT_EQ(csv_errors("x,y\n1,2").at(0).substr(0, 36), "p.csv:1:1: column volume is missing ");
  EXPECT_EQ(csv_errors("x,y,volume,vx\n1,2,3,4").at(0).substr(0, 32), "p.csv:1:1: column vy is missing ");
  EXPECT_EQ(csv_errors("x,x,y,volume\n").at(0).substr(0, 36), "p.csv:1:3: x: column x appears twice");
  EXPECT_EQ(csv_errors("x,y,volume,mass\n").at(0).substr(0, 30), "p.csv:1:12: \"mass\" is not a co");
  EXPECT_EQ(csv_errors("x[mm,y,volume\n").at(0).substr(0, 40), "p.csv:1:1: \"x[mm\" has no closing bracket");
  EXPECT_EQ(csv_errors("x[s],y[furlongg],volume\n").size(), 2u) << "wrong dimension, unknown unit";
  EXPECT_EQ(csv_errors("1,2,3\n").at(0).substr(0, 20), "p.csv:1:1: \"1\" is no");
  std::string long_text = "x,y,volume\n";
  for (int k = 0; k < 1000; ++k) long_text += "a,0,1\n";
  EXPECT_EQ(csv_errors(long_text).size(), 51u);
  EXPECT_EQ(csv_errors(long_text).back(), "p.csv: and 950 more errors; mend these first");
}

TEST(ParticlesCsv, MissingFileIsReportedWhereItIsNamed) {
  const auto error_of = [](const std::string& path, const Location& at) -> std::string {
    try {
      read_particles_csv(path, 2, at);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("no/such.csv", {"in.toml", 7, 3, "body[0].particles"}),
            "in.toml:7:3: body[0].particles: cannot read the particle file \"no/such.csv\" (No such file or directory); correct the path "
            "(relative to the input file) or make the file");
  const ScratchFolder scratch;
  EXPECT_NE(error_of(scratch.path().string(), {}).find("it is a folder"), std::string::npos);
  const auto file = scratch.path() / "particles.csv";
  std::ofstream(file, std::ios::binary) << "x,y,volume\n1,2,3\n";
  EXPECT_EQ(read_particles_csv(file.string(), 2).particles.size(), 1u);
  std::ofstream(file, std::ios::binary | std::ios::trunc);
  EXPECT_NE(error_of(file.string(), {}).find("no header line"), std::string::npos);
}

}  // namespace
}  // namespace crampon
