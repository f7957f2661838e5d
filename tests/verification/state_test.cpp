/// The declared state (docs/decisions/0023-declared-state.md) is all that a run needs: saved, loaded into another simulation and stepped on, it
/// gives the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "run_case.hpp"
#include "verification/four_bodies.hpp"

namespace crampon::test {
namespace {

struct StateCase {
  const char* name;
  std::string text;
  /// Members that must have entries at the end: what the case is there for.
  std::vector<std::string> holds;
  bool reorders = true;
};
void PrintTo(const StateCase& c, std::ostream* out) { *out << c.name; }

/// Blocks on a floor in space, with a crack-free contact that remembers slip.
std::string in_space(const std::string& shape_functions) {
  return R"in(
analysis = "three_dimensional"
[grid]
origin = [0, 0, 0]
size = [0.4, 0.2, 0.2]
cell = 0.02
[time]
steps = 40
courant = 0.4
[method]
shape_functions = ")in" +
         shape_functions + R"in("
[contact]
fields = "bodies"
default = { law = "slip_weakening", friction = 0.1, static_friction = 0.5, distance = 0.001 }
[[material]]
name = "soft"
law = "neo_hookean"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "a"
material = "soft"
shape = { kind = "box", low = [0.06, 0.06, 0.06], high = [0.14, 0.14, 0.12] }
velocity = [6, 0.5, -2]
[[body]]
name = "b"
material = "soft"
shape = { kind = "sphere", centre = [0.19, 0.1, 0.1], radius = 0.041 }
velocity = [-6, -0.5, -2]
[[wall]]
name = "floor"
kind = "half_space"
point = [0, 0, 0.04]
normal = [0, 0, 1]
[[rigid]]
name = "ram"
shape = { kind = "box", low = [0.32, 0.04, 0.04], high = [0.36, 0.16, 0.16] }
velocity = [-8, 0, 0]
spin = [0, 0, 20]
)in";
}

/// A bar behind a mirror with conditions that begin and end, a force and a pressure that change, weight, damping, and a probe.
std::string timed(const std::string& method) {
  return R"in(
analysis = "plane_stress"
[grid]
origin = [0, 0]
size = [0.4, 0.2]
cell = 0.01
[time]
steps = 60
courant = 0.4
[method]
body_force = [0, -10]
damping = 5
)in" + method +
         R"in(
[[material]]
name = "soft"
law = "neo_hookean"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "bar"
material = "soft"
shape = { kind = "rectangle", low = [0, 0.06], high = [0.2, 0.12] }
velocity = [3, 1]
[[symmetry]]
name = "mirror"
axis = "x"
at = 0
[[boundary]]
name = "early"
region = { kind = "rectangle", low = [0.08, 0], high = [0.12, 0.2] }
vy = 0.5
end = 2e-3
[[boundary]]
name = "late"
region = { kind = "rectangle", low = [0.1, 0], high = [0.14, 0.2] }
vy = -0.5
start = 1.5e-3
[[load]]
name = "pull"
region = { kind = "rectangle", low = [0.19, 0], high = [0.21, 0.2] }
kind = "total_force"
value = [{ expression = "20*sin(500*t)" }, 3]
[[load]]
name = "press"
kind = "pressure"
face = "x+"
value = [2000]
[[probe]]
name = "tip"
point = [0.2, 0.09]
quantity = "displacement"
)in";
}

/// Particles leave the grid and are removed, beside a crack whose surfaces they carry.
std::string leaving() {
  return R"in(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [0.2, 0.2]
cell = 0.01
[time]
steps = 60
courant = 0.4
[method]
leaving_particle = "remove"
[[material]]
name = "soft"
law = "elastic_large_rotation"
E = 1e6
nu = 0.3
density = 1000
[[body]]
name = "block"
material = "soft"
shape = { kind = "rectangle", low = [0.1, 0.06], high = [0.18, 0.14] }
velocity = [9, 0]
[[crack]]
points = [[0.12, 0.101], [0.17, 0.099]]
contact = { law = "coulomb", friction = 0.3 }
)in";
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

std::vector<StateCase> cases() {
  const std::vector<std::string> much = {"cracks.list[1].traction.history.damage",
                                         "cracks.list[0].upper_carriers.weight",
                                         "contacts.entries.state",
                                         "contacts.sides.side",
                                         "particles.contact",
                                         "rigid.present.centre",
                                         "conditions.prescribed_by_rigid",
                                         "pieces.list.origin"};
  return {
      {"everything_linear", everything("linear"), much},
      {"everything_gimp", everything("gimp"), much},
      {"everything_bspline", everything("bspline"), much},
      {"everything_cpdi", everything("cpdi"), {"particles.domain"}},
      {"volume_literal",
       with(four_bodies("scheme = \"literal\"\nmaterial_detection = \"volume\"", "stress_update = \"musl\"", 2,
                        "{ law = \"coulomb\", friction = 0.2 }"),
            "[contact]", "[contact]\ndetection = \"volume\""),
       {"contacts.initial_volume.value"},
       false},
      {"timed_usavg", timed(""), {"conditions.was_active", "observed.probes"}},
      {"timed_xpic", timed("transfer = { kind = \"xpic\", order = 3, every = 4 }\nstress_update = \"musl\""), {}},
      {"timed_fmpm", timed("transfer = { kind = \"fmpm\", order = 3 }\nshape_functions = \"gimp\""), {}},
      {"timed_usl", timed("stress_update = \"usl\"\nshape_functions = \"gimp\""), {}},
      {"leaving", leaving(), {"ledger.left.mass"}},
      {"space_gimp", in_space("gimp"), {"particles.contact", "rigid.present.turn"}},
      {"space_bspline", in_space("bspline"), {}},
  };
}

class KeptState : public testing::TestWithParam<StateCase> {};

/// From the start, from both sides of the first re-orderings, and from the middle: the next twelve steps are the same.
TEST_P(KeptState, GoesOnWithTheSameBits) {
  const StateCase& c = GetParam();
  const auto whole = make(c.text);
  std::vector<SavedState> kept;
  std::vector<std::uint64_t> hashes;
  std::vector<std::vector<double>> rows;
  const auto keep = [&] {
    kept.push_back(whole->save());
    hashes.push_back(whole->state_hash());
    rows.push_back(whole->history_row());
  };
  std::set<std::size_t> from = {0, 1};
  keep();
  run(*whole, [&](Simulation& s) {
    keep();
    const auto done = static_cast<std::size_t>(s.steps_done());
    if (done > 1 && s.last_reordering() == s.steps_done() - 1 && from.size() < 6) from.insert({done - 1, done});
  });
  ASSERT_TRUE(!c.reorders || from.size() > 2u) << "particles were never re-ordered: the case tests less than it says";
  from.insert(kept.size() / 2);
  for (const std::string& name : c.holds) {
    const bool any =
        std::any_of(kept.begin(), kept.end(), [&](const SavedState& s) { return s.find(name) && !s.find(name)->data.empty(); });
    EXPECT_TRUE(any) << name << " is empty";
  }
  for (const std::size_t k : from) {
    const auto other = make(c.text, {}, k % 2 == 0 ? 2 : 1);
    other->load(kept[k]);
    ASSERT_FALSE(first_difference(kept[k], other->save()))
        << "loaded at step " << k << ": " << first_difference(kept[k], other->save())->text();
    EXPECT_EQ(other->state_hash(), hashes[k]);
    const std::vector<double> row = other->history_row();
    ASSERT_EQ(row.size(), rows[k].size());
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_TRUE(row[i] == rows[k][i] || std::isnan(row[i])) << "column " << i << " at step " << k;
    for (int on = 0; on < 12 && !other->finished(); ++on) {
      other->step(other->end_time());
      const auto done = static_cast<std::size_t>(other->steps_done());
      ASSERT_LT(done, kept.size());
      const auto difference = first_difference(kept[done], other->save());
      ASSERT_FALSE(difference) << "from step " << k << ", after step " << done << ": " << difference->text();
      ASSERT_EQ(other->state_hash(), hashes[done]);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Cases, KeptState, testing::ValuesIn(cases()), [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace crampon::test
