#pragma once
/// Inputs that several tests read, good and bad.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crampon/input/read_problem.hpp"

namespace crampon {

inline const std::string folder = std::filesystem::temp_directory_path().lexically_normal().string();

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

inline std::vector<std::string> errors_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_problem_text(text, "in.toml", folder, overrides);
  } catch (const InputError& error) {
    std::vector<std::string> out;
    for (const Diagnostic& d : error.diagnostics()) out.push_back(d.text());
    return out;
  }
  return {"no error"};
}

using Lines = std::vector<std::string>;

struct ErrorCase {
  std::string name, from, to;
  Lines expected;
};

// tests/unit/input_errors.txt: the format is told there.
inline std::pair<std::string, std::vector<ErrorCase>> read_error_cases() {
  std::ifstream in(CRAMPON_SOURCE_DIR "/tests/unit/input_errors.txt");
  std::string base;
  std::vector<ErrorCase> cases;
  bool in_base = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("=== ")) {
      in_base = line == "=== input";
      if (!in_base) cases.push_back({line.substr(4), "", "", {}});
    } else if (line.empty() || line.starts_with("#")) {
      continue;
    } else if (in_base) {
      base += line + "\n";
    } else if (line.starts_with("- ") || line.starts_with("+ ")) {
      (line[0] == '-' ? cases.back().from : cases.back().to) += line.substr(2) + "\n";
    } else {
      const std::size_t dir = line.find("%DIR%");
      cases.back().expected.push_back(dir == std::string::npos ? line : line.replace(dir, 5, folder));
    }
  }
  return {base, cases};
}

inline std::string base_input() {
  static const std::string base = read_error_cases().first;
  return base;
}

// An input with something of everything.
inline const char* const rich_input = R"toml(title = "Two blocks"
description = """a "quoted" word
and a \\ line"""
analysis = "plane_strain"

[grid]
origin = [0, "0 mm"]
size = ["100 mm", 0.05]
cell = "5 mm"

[time]
steps = 100
step = "1 us"

[method]
stress_update = "usl"
damping = { times = ["0 s", "1 ms"], values = [0, "30 1/s"] }
body_force = [0, { expression = "-9.81*(t < 0.5)" }]

[contact]
detection = "volume"
require_approach = false

[[material]]
name = "soft"
law = "neo_hookean"
E = "1 MPa"
nu = 0.3
density = "1.5 g/cm3"

[[material]]
name = "hard"
law = "elastic_small_strain"
E = 2e9
nu = 0.2
density = 1000

[[body]]
name = "block"
material = "soft"
shape = { kind = "union", of = [
  { kind = "rectangle", low = [0.01, 0.01], high = ["90 mm", "20 mm"] }, { kind = "disk", centre = [0.05, 0.025], radius = 0.01 }
] }
particles_per_cell = [2, 3]
velocity = [{ expression = "10*x", unit = "mm/s" }, 0.5]
spin = 3
spin_centre = [0, 0]

[[body]]
name = "top"
material = "hard"
shape = { kind = "rectangle", low = [0.01, 0.04], high = [0.02, 0.045] }
match_mass = true
thickness = "2 mm"
particles_per_cell = 4

[[crack]]
points = [["20 mm", "18 mm"], [0.05, 0.018]]
contact = { law = "coulomb", friction = 0.3 }
max_segment = "2 mm"

[[crack]]
name = "arc"
arc = { centre = [0.05, 0.025], radius = "10 mm", from = "180 deg", to = "90 deg", segments = 7 }
contact = "bonded"
fixed = true

[[boundary]]
region = { kind = "rectangle", low = [0, 0], high = [0.1, 0] }
vy = 0
end = "0.5 ms"

[[symmetry]]
axis = "x"
at = "50 mm"
side = "below"
from = [0, 0.02]
to = [0, inf]

[[load]]
kind = "pressure"
face = "x+"
body = "top"
value = "1 kPa"

[[load]]
kind = "total_force"
value = ["1 kN", { times = [0, 1], values = [0, "2 N"] }]
region = { kind = "disk", centre = [0.05, 0.025], radius = 0.01 }

[[probe]]
quantity = "velocity"
point = ["20 mm", "15 mm"]

[output]
times = ["0.5 us", "7 us"]
history_steps = 2
quantities = ["stress", "velocity"]
full_precision = true

[[expect]]
column = "strain_energy"
value = "2 mJ"
relative = "5 %"
source = "hand"

[[expect]]
column = "kinetic_energy"
range = [0, 1e-5]
statistic = "mean"
value = 1
tolerance = "1 mJ"
)toml";

}  // namespace crampon
