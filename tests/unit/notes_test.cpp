#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "crampon/output/file.hpp"
#include "run_case.hpp"
#include "scratch_folder.hpp"

// What is said about inputs that are legal but probably not meant: each kind of note with its place and names, and the silence of all
// kinds where nothing is odd.
namespace crampon {
namespace {

namespace fs = std::filesystem;

/// A block of 4 x 4 cells on a grid of 10 x 10, cells of 0.1 m, two particles per cell and direction.
const std::string block = R"(
[grid]
origin = [0, 0]
size = [1, 1]
cell = 0.1
[time]
end = 0.01
[[material]]
name = "soft"
law = "elastic_small_strain"
E = 1e5
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "soft"
shape = { kind = "rectangle", low = [0.3, 0.3], high = [0.7, 0.7] }
)";
/// A second block that touches the first from the right.
const std::string neighbour = R"(
[[body]]
name = "neighbour"
material = "soft"
shape = { kind = "rectangle", low = [0.7, 0.3], high = [0.9, 0.7] }
)";

std::vector<std::string> notes(const std::string& text, const std::string& directory = ".") {
  return Simulation::create(read_problem_text(text, "in.toml", directory), 1)->notes_at_start();
}
/// The one note there is.
std::string note(const std::string& text, const std::string& directory = ".") {
  const std::vector<std::string> all = notes(text, directory);
  EXPECT_EQ(all.size(), 1U) << text;
  return all.empty() ? "" : all.front();
}

TEST(Notes, ContactLawWhileAllBodiesShareAField) {
  const std::string law = "[contact]\ndefault = \"frictionless\"\n";
  EXPECT_EQ(note(block + neighbour + law),
            "in.toml:24:1: contact.default: each body has a velocity field of its own (contact.fields is not given, and in one field for "
            "all this "
            "law would hold nowhere); set contact.fields = \"bodies\", or \"single\" for bodies that stick where they meet");
  EXPECT_EQ(
      note(block + neighbour + law + "fields = \"single\"\n"),
      "in.toml:24:1: contact.default: default has no effect (the bodies \"block\", \"neighbour\" share one velocity field and stick where "
      "they meet); set contact.fields = \"bodies\", or give bodies a field of their own");
  EXPECT_EQ(
      note(block + law),
      "in.toml:19:1: contact.default: default has no effect (there is nothing that the body \"block\" could meet); remove it, or add a "
      "body, a [[rigid]] or a [[wall]]");
  EXPECT_NE(note(block + neighbour + law + "fields = \"single\"\nnormal = \"average_gradient\"\n").find("default, normal have no effect"),
            std::string::npos);
  // Two bodies of one material share a field, too.
  EXPECT_NE(note(block + neighbour + law + "fields = \"materials\"\n").find("share one velocity field"), std::string::npos);
  EXPECT_EQ(notes(block + neighbour + law + "fields = \"bodies\"\n").size(), 0U);
  EXPECT_EQ(notes(block + neighbour).size(), 0U);
}

TEST(Notes, ContactLawThatHoldsAtAWallOnly) {
  const std::string wall = "[contact]\ndefault = \"frictionless\"\n[[wall]]\nname = \"floor\"\npoint = [0, 0.3]\nnormal = [0, 1]\n";
  EXPECT_EQ(notes(block + neighbour + wall).size(), 0U) << "glued to each other, they may well be meant to meet the floor alone";
  EXPECT_NE(note(block + neighbour + "velocity = [1, 0]\n" + wall).find("holds at rigid bodies and walls only"), std::string::npos);
}

TEST(Notes, BodiesThatOverlap) {
  const std::string tool =
      "[[body]]\nname = \"tool\"\nmaterial = \"soft\"\nshape = { kind = \"rectangle\", low = [0.6, 0.3], high = [0.9, 0.5] }\n";
  EXPECT_EQ(note(block + tool),
            "in.toml:21:1: body[1].shape: the bodies \"block\" and \"tool\" overlap: 8 of the 64 particles of \"block\" (0.02 m2, 12 % of "
            "it) lie "
            "in \"tool\" (the material there counts twice); move one of them, or cut it out of the other (kind = \"difference\")");
  const std::string rigid = "[[rigid]]\nname = \"punch\"\nshape = { kind = \"disk\", centre = [0.5, 0.8], radius = 0.15 }\n";
  const std::string said = note(block + rigid);
  EXPECT_NE(said.find("rigid[0].shape: the bodies \"block\" and \"punch\" overlap"), std::string::npos) << said;
  EXPECT_EQ(notes(block + rigid + "role = \"boundary\"\n").size(), 0U) << "a rigid boundary holds what it lies in";
  EXPECT_EQ(notes(block + "[[rigid]]\nname = \"punch\"\nshape = { kind = \"disk\", centre = [0.5, 0.85], radius = 0.15 }\n").size(), 0U);
  // A fine inclusion in a coarse matrix: the stairs of their particles interlock, the shapes do not overlap.
  std::string matrix = block;
  matrix.replace(
      matrix.find("shape = {"), std::string::npos,
      "shape = { kind = \"difference\", of = { kind = \"rectangle\", low = [0.3, 0.3], high = [0.7, 0.7] }, without = [{ kind = "
      "\"disk\", centre = [0.5, 0.5], radius = 0.1234 }] }\n[[body]]\nname = \"inclusion\"\nmaterial = \"soft\"\nshape = { kind = "
      "\"disk\", centre = [0.5, 0.5], radius = 0.1234 }\nmatch_mass = false\nparticles_per_cell = 3\n");
  EXPECT_EQ(notes(matrix).size(), 0U);
}

TEST(Notes, ParticlesFromAFile) {
  const ScratchFolder scratch;
  const auto write = [&](double volume) {
    std::ofstream file(scratch.path() / "two.csv");
    file << "x,y,volume\n0.275,0.35," << volume << "\n0.75,0.35,0.0025\n";
  };
  const std::string file = block + "[[body]]\nname = \"listed\"\nmaterial = \"soft\"\nparticles = \"two.csv\"\n";
  write(0.0025);
  EXPECT_EQ(notes(file, scratch.path()).size(), 0U) << "boxes of 0.05 m: one ends at 0.3, where the block begins";
  write(0.02);
  EXPECT_EQ(
      note(file, scratch.path()),
      "in.toml:21:1: body[1].particles: 1 of the 2 particles of \"listed\" are larger than a cell: up to 0.02 m2, and a cell has 0.01 m2 "
      "(nodes between such particles see none of them, and the body falls apart); use larger cells or more particles; volumes in the "
      "file are areas times the thickness of the body");
  std::ofstream(scratch.path() / "two.csv") << "x,y,volume\n0.325,0.325,0.0025\n0.75,0.35,0.0025\n";
  EXPECT_NE(note(file, scratch.path()).find("\"block\" and \"listed\" overlap: 1 of the 64 particles of \"block\""), std::string::npos);
}

TEST(Notes, StairsOfParticles) {
  const std::string head = block.substr(0, block.find("[[body]]")), body = "[[body]]\nname = \"disk\"\nmaterial = \"soft\"\n";
  const std::string disk = "shape = { kind = \"disk\", centre = [0.5, 0.5], radius = 0.225 }\n";
  EXPECT_EQ(note(head + body + disk),
            "in.toml:17:1: body[0].shape: the particles of \"disk\" have 5.7 % less area than its shape (each stands for a whole sub-cell, "
            "and those "
            "with their middle in the shape make a staircase); set match_mass = true, or false to keep them without this note");
  for (const char* said : {"match_mass = true\n", "match_mass = false\n"}) EXPECT_TRUE(notes(head + body + said + disk).empty());
}

TEST(Notes, ParticlesInsideAWall) {
  EXPECT_EQ(
      note(block + "[contact]\ndefault = \"frictionless\"\n[[wall]]\nname = \"floor\"\npoint = [0, 0.5]\nnormal = [0, 1]\n"),
      "in.toml:20:1: wall[0]: 16 particles begin more than a cell inside the wall \"floor\" (it lets their nodes move outwards only); move "
      "the wall or the body");
}

TEST(Notes, ThinRigidBodies) {
  const std::string plate = "[[rigid]]\nname = \"plate\"\nshape = { kind = \"rectangle\", low = [0.2, 0.75], high = [0.8, 0.8] }\n";
  EXPECT_EQ(notes(block + plate).size(), 0U) << "its faces are met, however thin it is";
  EXPECT_EQ(note(block + plate + "faces = \"particles\"\n"),
            "in.toml:20:1: rigid[0].shape: the rigid body \"plate\" is 0.05 m thick, which is 0.5 of a cell (a node beside it sees bodies "
            "on both of its sides at once, and they stick to each other through it); leave out faces = \"particles\", make it thicker, or "
            "cells smaller than 0.05 m");
  EXPECT_EQ(notes(block + plate + "role = \"boundary\"\n").size(), 0U) << "thin is no trouble there";
  const std::string above =
      "[[body]]\nname = \"upper\"\nmaterial = \"soft\"\nshape = { kind = \"rectangle\", low = [0.3, 0.8], high = [0.7, 0.9] }\n";
  EXPECT_EQ(
      note(block + above + plate),
      "in.toml:24:1: rigid[0].shape: the rigid body \"plate\" is 0.05 m thick, which is 0.5 of a cell, and one velocity field has "
      "material on both of its sides (a node beside it sees both at once, and they stick to each other through it); set contact.fields "
      "= \"bodies\", or give one of the bodies a field of its own");
  EXPECT_EQ(notes("[contact]\nfields = \"bodies\"\n" + block + above + plate).size(), 0U);
  std::string thick = plate;
  thick.replace(thick.find("0.8] }"), 4, "0.9]");
  EXPECT_EQ(notes(block + thick + "faces = \"particles\"\n").size(), 0U);
  // A thin bar that leans.
  const std::string leaning =
      "[[rigid]]\nname = \"bar\"\nfaces = \"particles\"\nshape = { kind = \"polygon\", corners = [[0.1, 0.7], [0.2, 0.7], [0.25, 0.95], "
      "[0.15, 0.95]] }\n";
  EXPECT_NE(note(block + leaning).find("\"bar\" is 0.098"), std::string::npos) << "0.1 m across, at atan(1/5) to the y axis";
}

TEST(Notes, CracksThatCutNothing) {
  const auto crack = [&](const std::string& points) { return block + "[[crack]]\nname = \"notch\"\npoints = " + points + "\n"; };
  const std::string tail = "; move it, or let it pass between particles of the body";
  EXPECT_EQ(note(crack("[[0.1, 0.1], [0.9, 0.1]]")),
            "in.toml:20:1: crack[0].points: the crack \"notch\" cuts nothing (the nearest body, \"block\", is 0.2 m away)" + tail);
  // On the edge, and so near to it that no particle is in between.
  for (const char* points : {"[[0.2, 0.3], [0.8, 0.3]]", "[[0.2, 0.32], [0.8, 0.32]]"})
    EXPECT_EQ(
        note(crack(points)),
        "in.toml:20:1: crack[0].points: the crack \"notch\" cuts nothing (nowhere is there a particle of \"block\" on either side)" + tail);
  EXPECT_EQ(
      note(crack("[[0.49, 0.49], [0.492, 0.491]]")),
      "in.toml:20:1: crack[0].points: the crack \"notch\" cuts nothing (it is 0.022 cells long, and no line from a particle to a node "
      "crosses it); use smaller cells or a longer crack");
  for (const char* points : {"[[0.2, 0.5], [0.5, 0.5]]", "[[0.2, 0.355], [0.8, 0.355]]", "[[0.45, 0.52], [0.55, 0.52]]"})
    EXPECT_EQ(notes(crack(points)).size(), 0U) << points;
  // Between two bodies of one field, and on a mirror plane.
  EXPECT_EQ(notes(block + neighbour + "[[crack]]\npoints = [[0.7, 0.2], [0.7, 0.8]]\n").size(), 0U);
  EXPECT_EQ(notes(crack("[[0.2, 0.3], [0.5, 0.3]]") + "[[symmetry]]\naxis = \"y\"\nat = 0.3\nfrom = [0.5, 0]\n").size(), 0U);
  std::string whole = crack("[[0.2, 0.5], [0.5, 0.5]]");
  whole.insert(whole.find("[[crack]]"), "ignores_cracks = true\n");
  EXPECT_NE(note(whole).find("no body is parted by cracks"), std::string::npos);
}

TEST(Notes, FractureWithoutTips) {
  const std::string through = "[[crack]]\nname = \"c\"\npoints = [[0.2, 0.5], [0.8, 0.5]]\n",
                    edge = "[[crack]]\nname = \"c\"\npoints = [[0.2, 0.5], [0.5, 0.5]]\n";
  const std::string growth = "growth = { criterion = { law = \"critical_j\", toughness = 1 }", fracture = "[fracture]\n";
  EXPECT_EQ(
      note(block + through + fracture),
      "in.toml:21:1: fracture: no crack has a tip in a body (there is no J to find); let a crack end inside a body, or remove [fracture]");
  EXPECT_EQ(note(block + edge + growth + ", ends = \"start\" }\n" + fracture),
            "in.toml:21:1: crack[0].growth: the crack \"c\" has no tip that may grow (growth.ends leaves out the end that lies in a "
            "body); let it end "
            "inside a body, or remove growth");
  EXPECT_EQ(notes(block + through + growth + " }\n" + fracture).size(), 2U);
  EXPECT_TRUE(notes(block + edge + growth + " }\n" + fracture).empty());
  const auto nucleation = [&](const char* length) { return block + fracture + "[[nucleation]]\nstrength = 1\nlength = " + length + "\n"; };
  EXPECT_EQ(
      note(nucleation("2") + growth + " }\n"),
      "in.toml:21:1: nucleation[0].length: cracks of the nucleation \"nucleation1\" are 2 cells long and are to grow (there is J only "
      "where 3 cells about a tip are free, also of the other tip); make length at least 4, or remove growth");
  EXPECT_TRUE(notes(nucleation("2")).empty());
  EXPECT_TRUE(notes(nucleation("3") + growth + " }\n").empty());
}

TEST(Notes, CracksThatCoincideOrMeetThemselves) {
  const auto cracks = [&](const std::string& a, const std::string& b) {
    return block + "[[crack]]\nname = \"a\"\npoints = " + a + "\n[[crack]]\nname = \"b\"\npoints = " + b + "\n";
  };
  EXPECT_EQ(note(cracks("[[0.2, 0.5], [0.6, 0.5]]", "[[0.8, 0.5], [0.4, 0.5]]")),
            "in.toml:23:1: crack[1].points: the cracks \"a\" and \"b\" coincide over 0.2 m (there is nothing between them, and the "
            "stricter of their two contact laws holds); remove one of them, or part them");
  EXPECT_EQ(notes(cracks("[[0.2, 0.5], [0.8, 0.5]]", "[[0.2, 0.45], [0.8, 0.55]]")).size(), 0U) << "they cross at nine degrees";
  EXPECT_EQ(notes(cracks("[[0.2, 0.5], [0.5, 0.5]]", "[[0.5, 0.5], [0.8, 0.5]]")).size(), 0U) << "end to end";
  EXPECT_EQ(notes(cracks("[[0.2, 0.5], [0.8, 0.5]]", "[[0.5, 0.5], [0.5, 0.8]]")).size(), 0U) << "one begins on the other";

  const auto crack = [&](const std::string& points) { return block + "[[crack]]\nname = \"a\"\npoints = " + points + "\n"; };
  EXPECT_EQ(
      note(crack("[[0.2, 0.4], [0.6, 0.4], [0.6, 0.6], [0.5, 0.6], [0.5, 0.2]]")),
      "in.toml:20:1: crack[0].points: the crack \"a\" crosses itself at (0.5, 0.4) m (a line that crosses it twice counts as crossing "
      "nothing); divide it into cracks that do not, or correct its points");
  EXPECT_NE(note(crack("[[0.2, 0.5], [0.6, 0.5], [0.4, 0.5]]")).find("the crack \"a\" runs back over itself for 0."), std::string::npos);
  EXPECT_EQ(notes(crack("[[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.6], [0.4, 0.4]]")).size(), 0U) << "a closed one";
  EXPECT_EQ(notes(block + "[[crack]]\narc = { centre = [0.5, 0.5], radius = 0.1, from = 0, to = \"360 deg\" }\n").size(), 0U);
}

TEST(Notes, ConditionsWhereNoBodyIs) {
  const std::string boundary = "[[boundary]]\nname = \"left\"\nvx = 0\nregion = { kind = \"rectangle\", low = [0, 0], high = [0.1, 1] }\n";
  EXPECT_EQ(note(block + boundary),
            "in.toml:21:1: boundary[0].region: no body is at the nodes of \"left\" (the nearest particle, of \"block\", is 0.225 m away); "
            "move it "
            "to a body, unless one is to come there");
  EXPECT_EQ(note(block + "[[symmetry]]\nname = \"mirror\"\naxis = \"x\"\nat = 0.1\n"),
            "in.toml:21:1: symmetry[0].at: no body is at the symmetry plane \"mirror\" (the nearest particle, of \"block\", is 0.225 m "
            "away); move "
            "it to a body, unless one is to come there");
  EXPECT_EQ(
      note(block + "[[rigid]]\nname = \"grip\"\nrole = \"boundary\"\nshape = { kind = \"rectangle\", low = [0, 0], high = [0.1, 0.1] }\n"),
      "in.toml:18:1: rigid[0]: no body is at the rigid boundary \"grip\" (the nearest particle, of \"block\", is 0.318 m away); move it to "
      "a "
      "body, unless one is to come there");
  // Nodes beside the body: how far its particles reach depends on the shape functions.
  const auto beside = [&](const char* shape, const char* x) {
    return notes(block + "[method]\nshape_functions = \"" + shape + "\"\n[[boundary]]\nvx = 0\nregion = { kind = \"rectangle\", low = [" +
                 x + ", 0], high = [" + x + ", 1] }\n");
  };
  for (const char* shape : {"linear", "gimp", "bspline"}) EXPECT_EQ(beside(shape, "0.3").size(), 0U) << shape;
  EXPECT_EQ(beside("linear", "0.2").size(), 1U);
  EXPECT_EQ(beside("gimp", "0.2").size(), 1U) << "its particles end at the edge of the block";
  EXPECT_EQ(beside("bspline", "0.2").size(), 0U);
  EXPECT_EQ(beside("bspline", "0.1").size(), 1U);
}

TEST(Notes, ProbesOutsideEveryBody) {
  const auto probe = [&](const std::string& point, const std::string& more = "") {
    return block + neighbour + "[[probe]]\nname = \"tip\"\nquantity = \"velocity\"\npoint = " + point + "\n" + more;
  };
  EXPECT_EQ(
      note(probe("[0.9, 0.8]")),
      "in.toml:26:1: probe[0].point: the probe \"tip\" is outside every body, 0.1 m from \"neighbour\" (it watches the nearest particle); "
      "move the point into the body");
  EXPECT_NE(note(probe("[0.8, 0.5]", "body = \"block\"\n")).find("outside its body, 0.1 m from \"block\""), std::string::npos);
  EXPECT_EQ(notes(probe("[0.3, 0.3]")).size(), 0U) << "a corner";
}

TEST(Notes, UnstableMethod) {
  EXPECT_EQ(
      note(block + "[method]\nstress_update = \"usl\"\n"),
      "in.toml:19:1: method.stress_update: usl with linear shape functions (strain follows from velocities that were divided by the small "
      "masses of nodes at edges; errors grow until the run stops); use usavg or musl, or gimp or bspline shape functions");
  EXPECT_EQ(notes(block + "[method]\nstress_update = \"usl\"\nshape_functions = \"gimp\"\n").size(), 0U);
}

TEST(Notes, BrakedRotation) {
  const std::string method = "[method]\nshape_functions = \"gimp\"\nrotation = \"n03\"\ntransfer = ";
  std::string turning = block;
  turning.replace(turning.find("[[body]]"), 8, "[[body]]\nspin = [2]");
  const std::string text = note(turning + method + "{ kind = \"xpic\", order = 2 }\n");
  EXPECT_NE(
      text.find(".spin: the body \"block\" turns, and method.transfer brakes rotation (momenta do not carry rotation, and what particles "
                "take from nodes has lost a part of the spin); use rotation = \"carried\", or flip without pic"),
      std::string::npos)
      << text;
  EXPECT_EQ(notes(turning + method + "\"flip\"\n").size(), 0U);
  EXPECT_EQ(notes(turning + "[method]\nshape_functions = \"gimp\"\ntransfer = { kind = \"xpic\", order = 2 }\n").size(), 0U);
  EXPECT_EQ(notes(block + method + "{ kind = \"fmpm\", order = 2 }\n").size(), 0U);
}

TEST(Notes, OutputAfterTheEnd) {
  std::string steps = block;
  steps.replace(steps.find("end = 0.01"), 10, "steps = 10\nstep = 1e-3");
  const std::string why = " (the run ends at about 0.01 s); ";
  EXPECT_EQ(note(steps + "[output]\ntimes = [0.005, 0.02, 0.03]\n"),
            "in.toml:20:17: output.times[1]: 2 of the 3 times of frames are after the end, from 0.02 s on" + why +
                "correct the times or let the run last longer");
  EXPECT_EQ(
      note(block + "[output]\nevery = 0.02\n"),
      "in.toml:19:1: output.every: the first frame after the start would be due at 0.02 s (the run ends at 0.01 s); make it shorter; only "
      "the first and the last state are written");
  EXPECT_NE(note(block + "[output]\nhistory_every = 0.02\n").find("output.history_every: the first history row"), std::string::npos);
  const std::string expect = "[[expect]]\nname = \"rest\"\ncolumn = \"kinetic_energy\"\nvalue = 0\ntolerance = 1\n";
  EXPECT_NE(note(steps + expect + "time = 1\n").find("\"rest\" is expected at 1 s, after the end" + why), std::string::npos);
  EXPECT_NE(note(steps + expect + "range = [0, 1]\nstatistic = \"mean\"\n").find("\"rest\" is expected until 1 s, after the end"),
            std::string::npos);
  const std::string late =
      "[[boundary]]\nname = \"late\"\nvx = 0\nstart = 1\nregion = { kind = \"rectangle\", low = [0.3, 0.3], high = [0.3, 0.7] }\n";
  EXPECT_NE(note(steps + late).find("\"late\" starts at 1 s, after the end" + why), std::string::npos);
  EXPECT_EQ(notes(block + "[output]\nevery = 0.01\nhistory_every = 0.01\ntimes = [0.01]\n").size(), 0U);
}

/// All input files in a folder of the repository.
std::vector<fs::path> inputs_in(const std::string& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(CRAMPON_SOURCE_DIR) / folder)) {
    if (entry.path().extension() == ".toml") found.push_back(entry.path());
  }
  EXPECT_FALSE(found.empty()) << folder;
  return found;
}
std::vector<std::string> notes_on(const fs::path& input) { return Simulation::create(read_problem(input.string()), 1)->notes_at_start(); }

TEST(Notes, SilentOnExamplesAndTemplates) {
  for (const std::string folder : {"examples", "apps/crampon/templates"}) {
    for (const fs::path& input : inputs_in(folder)) {
      for (const std::string& said : notes_on(input)) ADD_FAILURE() << input << ": " << said;
    }
  }
}

TEST(Notes, SilentOnProblems) {
  // Cracks on each other, thin tools and laws without fields are what some of these problems are about.
  const std::string meant[] = {"coincide", "m thick", "asks for steps", "a velocity field of its own"};
  for (const fs::path& input : inputs_in("tests/problems")) {
    for (const std::string& said : notes_on(input)) {
      const bool expected =
          std::any_of(std::begin(meant), std::end(meant), [&](const auto& part) { return said.find(part) != std::string::npos; });
      EXPECT_TRUE(expected) << input << ": " << said;
    }
  }
}

}  // namespace
}  // namespace crampon
