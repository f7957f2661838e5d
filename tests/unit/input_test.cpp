#include "crampon/input/read_problem.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "crampon/core/closest_name.hpp"
#include "crampon/input/reference.hpp"
#include "crampon/input/schema.hpp"

namespace crampon {
namespace {

const std::string folder = std::filesystem::temp_directory_path().lexically_normal().string();

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

std::vector<std::string> errors_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
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
std::pair<std::string, std::vector<ErrorCase>> read_error_cases() {
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

std::string base_input() {
  static const std::string base = read_error_cases().first;
  return base;
}

// An input with something of everything.
const char* const rich_input = R"toml(title = "Two blocks"
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
shape = { kind = "union", of = [{ kind = "rectangle", low = [0.01, 0.01], high = ["90 mm", "20 mm"] }, { kind = "disk", centre = [0.05, 0.025], radius = 0.01 }] }
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
value = ["1 kPa"]

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

TEST(InputErrors, EachSaysWhereWhatWhyAndWhatToDo) {
  const auto [base, cases] = read_error_cases();
  ASSERT_GT(cases.size(), 60u);
  EXPECT_EQ(errors_of(base), Lines{"no error"});
  for (const ErrorCase& c : cases) {
    SCOPED_TRACE(c.name);
    EXPECT_EQ(errors_of(replaced(base, c.from, c.to)), c.expected);
  }
}

TEST(InputErrors, AllOfAFileInOneGo) {
  std::string text = base_input();
  text = replaced(text, "cell = \"5 mm\"", "cel = \"5 mm\"");
  text = replaced(text, "end = \"1 ms\"", "end = \"1 mm\"");
  text = replaced(text, "nu = 0.3", "nu = 0.7");
  text = replaced(text, "material = \"soft\"", "material = \"sofd\"");
  text = replaced(text, "low = [0.01", "low = [nan");
  EXPECT_EQ(errors_of(text),
            (Lines{"in.toml:1:1: grid: the key \"cell\" is missing (cell size; one for all axes or one per axis); add cell = ...",
                   "in.toml:4:1: grid.cel: unknown key (grid has no such key); did you mean \"cell\"?",
                   "in.toml:6:7: time.end: \"1 mm\" has the wrong dimension (a time is expected here); write it in ms or another unit of that dimension",
                   "in.toml:11:6: material[0].nu: 0.7 is out of bounds (Poisson's ratio); it must be > -1 and < 0.5",
                   "in.toml:15:1: body[0].material: there is no material \"sofd\" (it is the name of a [[material]]); did you mean \"soft\"?",
                   "in.toml:16:38: body[0].shape.low[0]: nan is not a usable value (a finite number is needed); write for example 2.5 (in m) or \"2.5 m\""}));
}

TEST(InputErrors, CharactersThatAreNoText) {
  EXPECT_EQ(errors_of("title = \"a\x0e\""), Lines{"in.toml:1:11: control character 0x0E (an input is plain UTF-8 text); remove it"});
  EXPECT_EQ(errors_of("\n[\x01"), Lines{"in.toml:2:2: control character 0x01 (an input is plain UTF-8 text); remove it"});
  EXPECT_EQ(errors_of(std::string("a = 1\0", 6)), Lines{"in.toml:1:6: control character 0x00 (an input is plain UTF-8 text); remove it"});
  EXPECT_EQ(errors_of("# \xc3\xa4\n# \xff"), Lines{"in.toml:2:3: byte 0xFF is not UTF-8 (an input is plain UTF-8 text); remove it"});
  for (const char* bad : {"\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x80", "\xf0\x80\x80\x80"})
    EXPECT_NE(errors_of(std::string("# ") + bad)[0].find("is not UTF-8"), std::string::npos);
}

TEST(InputErrors, DeepAndLargeInputsAreRefused) {
  EXPECT_NE(errors_of("a = " + std::string(100000, '['))[0].find("the file is not valid TOML"), std::string::npos);
  std::string shape;
  for (int k = 0; k < 5000; ++k) shape += "{ kind = \"union\", of = [";
  EXPECT_NE(errors_of("shape = " + shape)[0].find("the file is not valid TOML"), std::string::npos);
  EXPECT_EQ(errors_of(std::string((16 << 20) + 1, '#')),
            Lines{"in.toml: the input has 16777217 bytes (at most 16777216 are read); put particles and tables into files of their own"});
}

TEST(InputErrors, FilesThatCannotBeRead) {
  const auto message = [](const std::string& path) {
    try {
      read_problem(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string missing = folder + "/no_such_input.toml";
  EXPECT_EQ(message(missing), missing + ": there is no such file (the input is read from it); correct the path");
  EXPECT_EQ(message(folder), folder + ": this is a directory (an input is one TOML file); name the file in it");
}

TEST(ReadProblem, ValuesArriveInSI) {
  const Problem p = read_problem_text(rich_input, "in.toml");
  EXPECT_EQ(p.title, "Two blocks");
  EXPECT_EQ(p.dimension(), 2);
  EXPECT_EQ(p.grid.size, (std::vector<double>{0.1, 0.05}));
  EXPECT_EQ(p.grid.cell, (std::vector<double>{0.005}));
  EXPECT_EQ(p.time.steps, 100);
  EXPECT_EQ(p.time.step, 1e-6);
  EXPECT_FALSE(p.time.end.has_value());
  EXPECT_EQ(p.method.stress_update, StressUpdate::usl);
  EXPECT_EQ(p.method.damping(0.5e-3, {}), 15.);
  EXPECT_EQ(p.method.body_force[1](0.1, {}), -9.81);
  EXPECT_EQ(p.method.body_force[1](0.6, {}), 0.);
  EXPECT_EQ(p.contact.detection, ContactDetection::volume);
  EXPECT_FALSE(p.contact.require_approach);
  ASSERT_EQ(p.materials.size(), 2u);
  EXPECT_EQ(p.materials[1].name, "hard");
  EXPECT_TRUE(p.materials[0].law && p.materials[1].law);
  ASSERT_EQ(p.bodies.size(), 2u);
  EXPECT_TRUE(p.bodies[0].shape->contains({{0.05, 0.034, 0}}));
  EXPECT_FALSE(p.bodies[0].shape->contains({{0.05, 0.036, 0}}));
  EXPECT_EQ(p.bodies[0].particles_per_cell, (std::vector<std::int64_t>{2, 3}));
  EXPECT_EQ(p.bodies[0].velocity[0](0, {{0.2, 0, 0}}), 0.001 * (10 * 0.2));
  EXPECT_EQ(p.bodies[0].spin, std::vector<double>{3});
  EXPECT_EQ(p.bodies[1].thickness, 0.002);
  EXPECT_EQ(p.bodies[1].particles_per_cell, std::vector<std::int64_t>{2});
  ASSERT_EQ(p.cracks.size(), 2u);
  EXPECT_EQ(p.cracks[0].name, "crack1");
  EXPECT_EQ(p.cracks[0].points, (std::vector<std::vector<double>>{{0.02, 0.018}, {0.05, 0.018}}));
  EXPECT_EQ(std::get<CoulombContact>(p.cracks[0].contact).friction, 0.3);
  EXPECT_TRUE(std::holds_alternative<BondedContact>(p.cracks[1].contact));
  EXPECT_EQ(p.cracks[1].arc->segments, 7);
  EXPECT_EQ(p.cracks[1].arc->from, std::acos(-1.));
  EXPECT_EQ(p.boundaries[0].name, "boundary1");
  EXPECT_TRUE(p.boundaries[0].vy && !p.boundaries[0].vx);
  EXPECT_EQ(p.boundaries[0].end, 0.5e-3);
  EXPECT_EQ(p.symmetries[0].axis, 0);
  EXPECT_EQ(p.symmetries[0].side, -1);
  EXPECT_TRUE(std::isinf(p.symmetries[0].to[1]));
  EXPECT_EQ(p.loads[0].value[0](0, {}), 1000.);
  EXPECT_EQ(p.loads[0].face, "x+");
  EXPECT_EQ(p.loads[1].value[1](0.5, {}), 1.);
  EXPECT_EQ(p.output.times, (std::vector<double>{0.5e-6, 7e-6}));
  EXPECT_EQ(p.expects[0].value, 0.002);
  EXPECT_EQ(p.expects[0].relative, 0.05);
  EXPECT_EQ(p.expects[1].statistic, ExpectInput::Statistic::mean);
  EXPECT_EQ(p.source, rich_input);
}

TEST(ReadProblem, RecordsRememberWhereTheyStood) {
  const Problem p = read_problem_text(base_input(), "in.toml");
  EXPECT_EQ(p.bodies[0].location.line, 13);
  EXPECT_EQ(p.bodies[0].at("name").line, 14);
  EXPECT_EQ(p.bodies[0].at("name").where, "body[0].name");
  EXPECT_EQ(p.bodies[0].at("thickness").line, 13);
  EXPECT_EQ(p.grid.at("size[1]").column, 19);
  EXPECT_EQ(p.output.location.file, "in.toml");
  EXPECT_EQ(p.output.location.where, "output");
}

TEST(ReadProblem, FilesAreRelativeToTheInput) {
  const std::filesystem::path place = std::filesystem::path(folder) / "crampon_input_test";
  std::filesystem::create_directories(place / "data");
  std::ofstream(place / "data/p.csv") << "x,y,volume\n0.05,0.02,1e-6\n";
  std::ofstream(place / "data/pull.csv") << "time,value\n# slow start\n0,0\r\n\n1e-3, 5\n";
  std::string text = base_input();
  const std::size_t shape = text.find("shape =");
  text = text.substr(0, shape) + "particles = \"data/p.csv\"\nvelocity = [0, 0]\n[method]\ndamping = { file = \"data/pull.csv\", unit = \"1/ms\" }\n";
  std::ofstream(place / "in.toml") << text;
  const Problem p = read_problem((place / "in.toml").string());
  EXPECT_EQ(p.bodies[0].particles, "data/p.csv");
  EXPECT_EQ(p.directory, place.string());
  EXPECT_EQ(p.method.damping(0.5e-3, {}), 2500.);
  EXPECT_NE(write_resolved(p).find("particles = \"" + (place / "data/p.csv").string() + "\""), std::string::npos);
  std::ofstream(place / "data/pull.csv") << "time,value\n0,0\n1;2\n";
  try {
    read_problem((place / "in.toml").string());
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(":19:20: method.damping: line 3 of the file is not \"time,value\""), std::string::npos) << error.what();
  }
  std::filesystem::remove_all(place);
}

TEST(Overrides, ReplaceAndAddEntries) {
  const Problem p = read_problem_text(rich_input, "in.toml", folder,
                                      {"method.stress_update=\"musl\"", "method.shape_functions=gimp", "body[0].velocity=[1, \"2 mm/s\"]",
                                       "crack[0].points[1][0]=\"40 mm\"", "title=My beam", "grid.cell=2.5 mm", "crack[1].contact=none",
                                       "time={ steps = 3, step = 1e-5 }", "load[0].region.kind=everywhere"});
  EXPECT_EQ(p.method.stress_update, StressUpdate::musl);
  EXPECT_EQ(p.method.shape_functions, ShapeFunctionKind::gimp);
  EXPECT_EQ(p.bodies[0].velocity[1](0, {}), 0.002);
  EXPECT_EQ(p.cracks[0].points[1][0], 0.04);
  EXPECT_EQ(p.title, "My beam");
  EXPECT_EQ(p.grid.cell[0], 0.0025);
  EXPECT_EQ(p.time.steps, 3);
  EXPECT_TRUE(std::holds_alternative<NoContact>(p.cracks[1].contact));
  EXPECT_TRUE(p.loads[0].region && p.loads[0].region->contains({{7, 7, 0}}));
}

TEST(Overrides, ErrorsNameTheSetting) {
  const auto one = [](const std::string& setting) {
    const Lines all = errors_of(base_input(), {setting});
    EXPECT_EQ(all.size(), 1u);
    return all[0];
  };
  EXPECT_EQ(one("time.end=5 mm"),
            "--set time.end=5 mm: time.end: \"5 mm\" has the wrong dimension (a time is expected here); write it in ms or another unit of that dimension");
  EXPECT_EQ(one("time.curant=0.2"), "--set time.curant=0.2: time.curant: unknown key (time has no such key); did you mean \"courant\"?");
  EXPECT_EQ(one("body[1].thickness=1"), "--set body[1].thickness=1: there is no element [1] (the array has 1, counted from 0); correct the path");
  EXPECT_EQ(one("grid[0]=1"), "--set grid[0]=1: there is no element [0] (the entry is not an array); correct the path");
  EXPECT_EQ(one("title"),
            "--set title: not a setting (a setting is a path, = and a value); write it as time.courant=0.2 or body[0].thickness=\"2 mm\"");
  for (const std::string bad : {"=1", ".a=1", "a.=1", "a..b=1", "[0]=1", "a[=1", "a[x]=1", "a[0=1", "a[-1]=1", "a[99999999999999999999]=1"})
    EXPECT_EQ(one(bad).find("--set " + bad + ": "), 0u) << bad;
  EXPECT_EQ(one("grid.x.y=1"), "--set grid.x.y=1: grid.x: unknown key (grid has no such key); choose from: origin, size, cell");
  EXPECT_EQ(one("grid.cell.x=1"),
            "--set grid.cell.x=1: \"x\" cannot be set (what stands before it is not a table); correct the path; elements of an array are chosen by [0]");
  EXPECT_EQ(one("title=a\x01"), "--set title=a\x01:1:2: control character 0x01 (an input is plain UTF-8 text); remove it");
}

TEST(Resolved, ReadsBackAsTheSameProblem) {
  const Problem first = read_problem_text(rich_input, "in.toml");
  const std::string resolved = write_resolved(first);
  const Problem second = read_problem_text(resolved, "resolved.toml");
  EXPECT_EQ(write_resolved(second), resolved);
  // The declaration sees every member, so equal values of all entries are equal problems.
  EXPECT_EQ(second.description, first.description);
  EXPECT_EQ(second.method.damping(0.3e-3, {}), first.method.damping(0.3e-3, {}));
  EXPECT_EQ(second.bodies[0].velocity[0](0, {{0.7, 0, 0}}), first.bodies[0].velocity[0](0, {{0.7, 0, 0}}));
  EXPECT_EQ(second.cracks[1].arc->from, first.cracks[1].arc->from);
  EXPECT_EQ(second.boundaries[0].end, first.boundaries[0].end);
  EXPECT_EQ(second.output.times, first.output.times);
  EXPECT_EQ(second.expects[0].relative, first.expects[0].relative);
}

TEST(Resolved, ShowsDefaultsInSI) {
  const std::string resolved = write_resolved(read_problem_text(base_input(), "in.toml"));
  for (const char* line : {"courant = 0.4\n", "end = 0.001  # s\n", "E = 1000000.0  # Pa\n", "density = 1500.0  # kg/m3\n", "thickness = 1.0  # m\n",
                           "particles_per_cell = [2]\n", "scheme = \"consistent\"\n", "mass_screen = 1e-06\n", "law = \"neo_hookean\"\n",
                           "shape = { kind = \"rectangle\", low = [0.01, 0.01], high = [0.09, 0.04] }\n"})
    EXPECT_NE(resolved.find(line), std::string::npos) << line;
  EXPECT_EQ(resolved.find("steps"), std::string::npos);
}

// A law made up here. Nothing but its declaration and its name in the family is said.
struct ToyContact {
  double stickiness = 0.25;
};
using ToyLaw = std::variant<FrictionlessContact, ToyContact>;
const Declaration<ToyContact>& toy_declaration() {
  static const auto d = Declaration<ToyContact>("toy", "Glue that a test made up.")
      .quantity("stickiness", &ToyContact::stickiness, "Pa", Bounds::between(0, 1e9), "how much it sticks");
  return d;
}

struct ToyMaterial {
  double E = 0, density = 0;
};

TEST(ToyLaw, IsSeenByParserSchemaReferenceAndResolvedInput) {
  // Materials may be added at run time; the toy borrows the engine side of an existing law.
  static const auto declaration = Declaration<ToyMaterial>("toy_putty", "Putty that a test made up.")
      .quantity("E", &ToyMaterial::E, "Pa", Bounds::positive(), "stiffness of the putty", Presence::required)
      .quantity("density", &ToyMaterial::density, "kg/m3", Bounds::positive(), "mass per initial volume", Presence::required);
  const MaterialSpec existing = read_problem_text(base_input(), "in.toml").materials[0].law;
  materials().add(declaration, [existing](ToyMaterial m) -> MaterialSpec {
    if (m.E > 1e9) throw std::invalid_argument("that is no putty");
    return existing;
  });

  std::string text = replaced(base_input(), "\"neo_hookean\"", "\"toy_putty\"");
  EXPECT_EQ(errors_of(text), Lines{"in.toml:11:1: material[0].nu: unknown key (material has no such key); choose from: name, law, E, density"});
  text = replaced(text, "nu = 0.3\n", "");
  const Problem p = read_problem_text(text, "in.toml");
  EXPECT_EQ(p.materials[0].law, existing);
  EXPECT_NE(write_resolved(p).find("law = \"toy_putty\"\nE = 1000000.0  # Pa\n"), std::string::npos);
  EXPECT_EQ(errors_of(replaced(text, "\"1 MPa\"", "\"2 GPa\"")),
            Lines{"in.toml:9:7: material[0].law: that is no putty (Putty that a test made up); correct the parameters"});
  EXPECT_NE(errors_of(replaced(base_input(), "\"neo_hookean\"", "\"toy_puty\""))[0].find("did you mean \"toy_putty\"?"), std::string::npos);
  EXPECT_NE(json_schema().find("\"toy_putty\""), std::string::npos);
  EXPECT_NE(json_schema().find("stiffness of the putty [Pa]"), std::string::npos);
  EXPECT_NE(reference_page().find("### toy_putty\n\nPutty that a test made up."), std::string::npos);
  EXPECT_NE(reference_page().find("| `E` | quantity | Pa | **required** | > 0 | stiffness of the putty |"), std::string::npos);
}

struct ToyInput {
  ToyLaw law = ToyContact{};
};

TEST(ToyLaw, FamiliesOfVariantsNeedNoMoreThanTheirDeclarations) {
  static const auto family =
      Family<ToyLaw>("toy law", "law", "Laws of a test.").add(FrictionlessContact::declaration()).add(toy_declaration());
  const auto record = Declaration<ToyInput>("toy input", "An input of a test.")
                          .one_of("contact", &ToyInput::law, []() -> const Family<ToyLaw>& { return family; }, "a law");
  const std::string page = reference_page(record);
  EXPECT_NE(page.find("| `contact` | [toy law](#toy-law-family) |  | `\"toy\"` |  | a law |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `stickiness` | quantity | Pa | `0.25` | >= 0 and <= 1000000000 | how much it sticks |"), std::string::npos) << page;
  const auto schema = nlohmann::json::parse(json_schema(record));
  EXPECT_EQ(schema["definitions"]["toy_law"]["anyOf"][1]["properties"]["stickiness"]["default"], 0.25);
}

// What of a schema the tests need: does `value` satisfy it? Draft 4, the keywords that json_schema() writes.
bool satisfies(const nlohmann::json& value, const nlohmann::json& schema, const nlohmann::json& root) {
  if (schema.contains("$ref")) return satisfies(value, root.at(nlohmann::json::json_pointer(schema["$ref"].get<std::string>().substr(1))), root);
  const auto any = [&](const char* key) {
    return std::count_if(schema[key].begin(), schema[key].end(), [&](const auto& s) { return satisfies(value, s, root); });
  };
  if (schema.contains("anyOf") && any("anyOf") == 0) return false;
  if (schema.contains("oneOf") && any("oneOf") != 1) return false;
  if (schema.contains("allOf") && any("allOf") != std::ptrdiff_t(schema["allOf"].size())) return false;
  if (schema.contains("not") && satisfies(value, schema["not"], root)) return false;
  if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) return false;
  const std::string type = schema.value("type", "");
  if ((type == "number" && !value.is_number()) || (type == "integer" && !value.is_number_integer()) || (type == "string" && !value.is_string()) ||
      (type == "boolean" && !value.is_boolean()) || (type == "array" && !value.is_array()) || (type == "object" && !value.is_object()))
    return false;
  if (value.is_number() && schema.contains("minimum")) {
    const double low = schema["minimum"], x = value;
    if (x < low || (x == low && schema.value("exclusiveMinimum", false))) return false;
  }
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", 0u) || value.size() > schema.value("maxItems", std::size_t(-1))) return false;
    for (const auto& item : value)
      if (schema.contains("items") && !satisfies(item, schema["items"], root)) return false;
  }
  if (value.is_object()) {
    for (const auto& key : schema.value("required", nlohmann::json::array()))
      if (!value.contains(key.get<std::string>())) return false;
    for (const auto& [key, item] : value.items()) {
      const bool known = schema.contains("properties") && schema["properties"].contains(key);
      if (!known && schema.contains("additionalProperties")) return false;
      if (known && !satisfies(item, schema["properties"][key], root)) return false;
    }
  }
  return true;
}

TEST(Schema, AcceptsASampleAndRefusesWhatIsWrong) {
  const auto schema = nlohmann::json::parse(json_schema());
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-04/schema#");
  EXPECT_EQ(schema["required"], (nlohmann::json{"grid", "time", "material", "body"}));
  EXPECT_EQ(schema["properties"]["grid"]["properties"]["cell"]["description"], "cell size; one for all axes or one per axis [m]");
  EXPECT_EQ(schema["properties"]["time"]["properties"]["courant"]["default"], 0.4);
  auto sample = nlohmann::json::parse(R"({
    "grid": {"origin": [0, 0], "size": ["100 mm", 0.05], "cell": "5 mm"},
    "time": {"end": "1 ms"},
    "method": {"damping": {"times": [0, 1], "values": [0, "30 1/s"]}},
    "material": [{"name": "soft", "law": "neo_hookean", "E": "1 MPa", "nu": 0.3, "density": 1500}],
    "body": [{"name": "b", "material": "soft", "shape": {"kind": "union", "of": [{"kind": "disk", "centre": [0, 0], "radius": 1}]}}],
    "crack": [{"points": [[0, 0], ["1 mm", 0]], "contact": "bonded"}, {"points": [[0, 0], [1, 0]], "contact": {"law": "coulomb", "friction": 0.1}}]
  })");
  EXPECT_TRUE(satisfies(sample, schema, schema));
  const auto refuses = [&](const char* pointer, const nlohmann::json& value) {
    auto changed = sample;
    changed[nlohmann::json::json_pointer(pointer)] = value;
    return !satisfies(changed, schema, schema);
  };
  EXPECT_TRUE(refuses("/gird", 1));
  EXPECT_TRUE(refuses("/time/steps", 3));
  EXPECT_TRUE(refuses("/grid/cell", 0));
  EXPECT_TRUE(refuses("/grid/cell", true));
  EXPECT_TRUE(refuses("/grid/origin", {1}));
  EXPECT_TRUE(refuses("/material/0/law", "neo"));
  EXPECT_TRUE(refuses("/material/0/friction", 0.1));
  EXPECT_TRUE(refuses("/body/0/shape/of/0/kind", "disc"));
  EXPECT_TRUE(refuses("/crack/0/contact", "coulomb"));
  EXPECT_TRUE(refuses("/material", nlohmann::json::array()));
  EXPECT_FALSE(refuses("/title", "a"));
}

TEST(Reference, NamesEveryKeyOfEveryTable) {
  const std::string page = reference_page();
  EXPECT_NE(page.find("| `cell` | list of quantities | m | **required** | > 0; 1 to 3 values | cell size; one for all axes or one per axis |"),
            std::string::npos);
  EXPECT_NE(page.find("not together with `end` |"), std::string::npos);
  EXPECT_NE(page.find("| N or Pa by `kind` | **required** |"), std::string::npos);
  for (const Entry& table : problem_declaration().entries()) {
    EXPECT_NE(page.find("| `" + table.key + "` |"), std::string::npos) << table.key;
    if (table.record) {
      for (const Entry& entry : table.record().entries()) EXPECT_NE(page.find("| `" + entry.key + "` |"), std::string::npos) << entry.key;
    }
  }
  for (const Alternative& a : contact_laws().alternatives()) EXPECT_NE(page.find("### " + a.name() + "\n\n" + a.record->help()), std::string::npos);
}

// Blind mutations of good inputs: whatever is in a file, reading it gives a problem or an InputError.
TEST(Fuzz, MutatedInputsGiveAProblemOrAnInputError) {
  const std::vector<std::string> seeds = {base_input(), rich_input, write_resolved(read_problem_text(rich_input, "in.toml"))};
  const std::vector<std::string> words = {"[", "]", "{", "}", "[[", "]]", "=", "\"", "'", "\n", "#", ",", ".", "-", "nan", "inf", "1e999", "1e308", "-1", "0", "true",
                                          "\"1 MPa*sqrt(m)\"", "\"5 mm\"", "{ expression = \"x/t\" }", "{ kind = \"everywhere\" }", "[]", "{}", "99999999999999999999",
                                          "9223372036854775807", "1979-05-27T07:32:00Z", "kind", "law", "points", "size", "cell", "\xc3\xa4", "\xff", "\x01", "\\"};
  std::mt19937 random(20);
  const auto below = [&](std::size_t n) { return n == 0 ? std::size_t{0} : std::size_t(random() % n); };
  int accepted = 0, refused = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string text = seeds[below(seeds.size())];
    for (std::size_t edits = round % 3 == 0 ? 1 + below(12) : 1; edits > 0; --edits) {
      const std::size_t at = below(text.size());
      switch (below(7)) {
        case 0: text.erase(at, 1 + below(8)); break;
        case 1: text.insert(at, words[below(words.size())]); break;
        case 2: text[at] = static_cast<char>(random() % 256); break;
        case 3: text.insert(at, text.substr(below(text.size()), below(60))); break;
        case 4: {  // exchange a value for a word
          const std::size_t equals = text.find("= ", at), end = text.find('\n', equals);
          if (equals != std::string::npos && end != std::string::npos) text.replace(equals + 2, end - equals - 2, words[below(words.size())]);
          break;
        }
        case 5: {  // another digit
          const std::size_t digit = text.find_first_of("0123456789", at);
          if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
          break;
        }
        default: text.erase(at, text.find('\n', at) - at); break;
      }
      if (text.empty()) text = "\n";
    }
    try {
      const Problem p = read_problem_text(text, "in.toml", folder);
      ++accepted;
      if (accepted % 20 == 0) {
        EXPECT_NO_THROW(read_problem_text(write_resolved(p), "resolved.toml", folder)) << text;
      }
    } catch (const InputError& error) {
      ++refused;
      EXPECT_FALSE(error.diagnostics().empty());
      for (const Diagnostic& d : error.diagnostics()) {
        EXPECT_FALSE(d.what.empty() || d.remedy.empty()) << d.text();
        EXPECT_EQ(d.location.file, "in.toml") << d.text();
      }
    }
  }
  // Both happen often, or the mutations would test one branch only.
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused, 2000);
}

}  // namespace
}  // namespace crampon
