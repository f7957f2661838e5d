#include "crampon/input/read_problem.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "crampon/contact/laws/bonded.hpp"
#include "crampon/contact/laws/coulomb.hpp"
#include "crampon/contact/laws/none.hpp"
#include "unit/input_samples.hpp"

namespace crampon {
namespace {

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
  EXPECT_EQ(
      errors_of(text),
      (Lines{"in.toml:1:1: grid: the key \"cell\" is missing (cell size; one for all axes or one per axis); add cell = ...",
             "in.toml:4:1: grid.cel: unknown key (grid has no such key); did you mean \"cell\"?",
             "in.toml:6:7: time.end: \"1 mm\" has the wrong dimension (a time is expected here); write it in ms or another unit of that "
             "dimension",
             "in.toml:11:6: material[0].nu: 0.7 is out of bounds (Poisson's ratio); it must be > -1 and < 0.5",
             "in.toml:15:1: body[0].material: there is no material \"sofd\" (it is the name of a [[material]]); did you mean \"soft\"?",
             "in.toml:16:38: body[0].shape.low[0]: nan is not a usable value (a finite number is needed); write for example 2.5 (in m) or "
             "\"2.5 m\""}));
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
  EXPECT_EQ(p.bodies[1].particles_per_cell, std::vector<std::int64_t>{4});
  ASSERT_EQ(p.cracks.size(), 2u);
  EXPECT_EQ(p.cracks[0].name, "crack1");
  EXPECT_EQ(p.cracks[0].points, (std::vector<std::vector<double>>{{0.02, 0.018}, {0.05, 0.018}}));
  EXPECT_EQ(p.cracks[0].contact.as<CoulombContact>()->friction, 0.3);
  EXPECT_TRUE(p.cracks[1].contact.as<BondedContact>());
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
  text = text.substr(0, shape) +
         "particles = \"data/p.csv\"\nvelocity = [0, 0]\n[method]\ndamping = { file = \"data/pull.csv\", unit = \"1/ms\" }\n";
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
    EXPECT_NE(std::string(error.what()).find(":19:20: method.damping: line 3 of the file is not \"time,value\""), std::string::npos)
        << error.what();
  }
  const auto damping_of = [&](const std::string& table) {
    std::ofstream(place / "data/pull.csv") << table;
    return read_problem((place / "in.toml").string()).method.damping(0, {});
  };
  EXPECT_EQ(damping_of("\xef\xbb\xbf"
                       "1,2\n2,3\n"),
            2000.)
      << "a byte order mark is no header";
  EXPECT_EQ(damping_of("t [s], kappa\n1,2\n"), 2000.);
  for (const char* wrong : {"0;1\n1,2\n", "0,1,2\n1,2\n", "0,nan\n1,2\n", "nan,1\n1,2\n", "t\n1,2\n", "t,k\nt,k\n1,2\n", "t,k\n", ""})
    EXPECT_THROW(damping_of(wrong), InputError) << wrong;
  std::filesystem::remove_all(place);
}

TEST(ReadProblem, DeepKeysAreRefused) {
  std::string deep = "a";
  for (int k = 0; k < 50000; ++k) deep += ".a";
  for (const std::string& text : {deep + " = 1\n", "[" + deep + "]\n", "x = { " + deep + " = 1 }\n"})
    EXPECT_NE(errors_of(text).at(0).find("more than a hundred parts"), std::string::npos);
}

TEST(Overrides, ReplaceAndAddEntries) {
  const Problem p = read_problem_text(rich_input, "in.toml", folder,
                                      {"method.stress_update=\"musl\"", "method.shape_functions=gimp", "body[0].velocity=[1, \"2 mm/s\"]",
                                       "crack[0].points[1][0]=\"40 mm\"", "title=My beam", "grid.cell=2.5 mm", "crack[1].contact=none",
                                       "time={ steps = 3, step = 1e-5 }", "load[0].region.kind=everywhere"});
  EXPECT_EQ(p.method.stress_update, StressUpdate::musl);
  EXPECT_EQ(p.method.shape_functions, kind_of<GimpShape>);
  EXPECT_EQ(p.bodies[0].velocity[1](0, {}), 0.002);
  EXPECT_EQ(p.cracks[0].points[1][0], 0.04);
  EXPECT_EQ(p.title, "My beam");
  EXPECT_EQ(p.grid.cell[0], 0.0025);
  EXPECT_EQ(p.time.steps, 3);
  EXPECT_TRUE(p.cracks[1].contact.as<NoContact>());
  EXPECT_TRUE(p.loads[0].region && p.loads[0].region->contains({{7, 7, 0}}));
}

TEST(Overrides, ErrorsNameTheSetting) {
  const auto one = [](const std::string& setting) {
    const Lines all = errors_of(base_input(), {setting});
    EXPECT_EQ(all.size(), 1u);
    return all[0];
  };
  EXPECT_EQ(one("time.end=5 mm"),
            "--set time.end=5 mm: time.end: \"5 mm\" has the wrong dimension (a time is expected here); write it in ms or another unit of "
            "that dimension");
  EXPECT_EQ(one("time.curant=0.2"), "--set time.curant=0.2: time.curant: unknown key (time has no such key); did you mean \"courant\"?");
  EXPECT_EQ(one("body[1].thickness=1"),
            "--set body[1].thickness=1: there is no element [1] (the array has 1, counted from 0); correct the path");
  EXPECT_EQ(one("grid[0]=1"), "--set grid[0]=1: there is no element [0] (the entry is not an array); correct the path");
  EXPECT_EQ(one("title"),
            "--set title: not a setting (a setting is a path, = and a value); write it as time.courant=0.2 or body[0].thickness=\"2 mm\"");
  for (const std::string bad : {"=1", ".a=1", "a.=1", "a..b=1", "[0]=1", "a[=1", "a[x]=1", "a[0=1", "a[-1]=1", "a[99999999999999999999]=1"})
    EXPECT_EQ(one(bad).find("--set " + bad + ": "), 0u) << bad;
  EXPECT_EQ(one("grid.x.y=1"), "--set grid.x.y=1: grid.x: unknown key (grid has no such key); choose from: origin, size, cell");
  EXPECT_EQ(one("grid.cell.x=1"),
            "--set grid.cell.x=1: \"x\" cannot be set (what stands before it is not a table); correct the path; elements of an array are "
            "chosen by [0]");
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
  for (const char* line : {"courant = 0.4\n", "end = 0.001  # s\n", "E = 1000000.0  # Pa\n", "density = 1500.0  # kg/m3\n",
                           "thickness = 1.0  # m\n", "particles_per_cell = [2]\n", "scheme = \"consistent\"\n", "mass_screen = 1e-06\n",
                           "law = \"neo_hookean\"\n", "shape = { kind = \"rectangle\", low = [0.01, 0.01], high = [0.09, 0.04] }\n"})
    EXPECT_NE(resolved.find(line), std::string::npos) << line;
  EXPECT_EQ(resolved.find("steps"), std::string::npos);
}

// Blind mutations of good inputs: whatever is in a file, reading it gives a problem or an InputError.
TEST(Fuzz, MutatedInputsGiveAProblemOrAnInputError) {
  const std::vector<std::string> seeds = {base_input(), rich_input, write_resolved(read_problem_text(rich_input, "in.toml"))};
  const std::vector<std::string> words = {"[",
                                          "]",
                                          "{",
                                          "}",
                                          "[[",
                                          "]]",
                                          "=",
                                          "\"",
                                          "'",
                                          "\n",
                                          "#",
                                          ",",
                                          ".",
                                          "-",
                                          "nan",
                                          "inf",
                                          "1e999",
                                          "1e308",
                                          "-1",
                                          "0",
                                          "true",
                                          "\"1 MPa*sqrt(m)\"",
                                          "\"5 mm\"",
                                          "{ expression = \"x/t\" }",
                                          "{ kind = \"everywhere\" }",
                                          "[]",
                                          "{}",
                                          "99999999999999999999",
                                          "9223372036854775807",
                                          "1979-05-27T07:32:00Z",
                                          "kind",
                                          "law",
                                          "points",
                                          "size",
                                          "cell",
                                          "\xc3\xa4",
                                          "\xff",
                                          "\x01",
                                          "\\"};
  std::mt19937 random(20);
  const auto below = [&](std::size_t n) { return n == 0 ? std::size_t{0} : std::size_t(random() % n); };
  int accepted = 0, refused = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string text = seeds[below(seeds.size())];
    for (std::size_t edits = round % 3 == 0 ? 1 + below(12) : 1; edits > 0; --edits) {
      const std::size_t at = below(text.size());
      switch (below(7)) {
        case 0:
          text.erase(at, 1 + below(8));
          break;
        case 1:
          text.insert(at, words[below(words.size())]);
          break;
        case 2:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 3:
          text.insert(at, text.substr(below(text.size()), below(60)));
          break;
        case 4: {  // exchange a value for a word
          const std::size_t equals = text.find("= ", at), end = text.find('\n', equals);
          if (equals != std::string::npos && end != std::string::npos)
            text.replace(equals + 2, end - equals - 2, words[below(words.size())]);
          break;
        }
        case 5: {  // another digit
          const std::size_t digit = text.find_first_of("0123456789", at);
          if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
          break;
        }
        default:
          text.erase(at, text.find('\n', at) - at);
          break;
      }
      if (text.empty()) text.push_back('\n');
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
