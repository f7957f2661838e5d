/// Members that are stated once: all are stated, all are kept, all are hashed, and the first that differs has a name.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <type_traits>

#include "crampon/core/saved_state.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {
namespace {

// Neither can be copied by accident.
static_assert(!std::is_copy_constructible_v<State<2>> && !std::is_copy_assignable_v<State<3>>);
static_assert(!std::is_copy_constructible_v<StepWork<2>> && !std::is_copy_assignable_v<StepWork<3>>);
static_assert(std::is_nothrow_move_constructible_v<State<2>> && std::is_move_constructible_v<StepWork<3>>);

template <class T>
struct ElementOf {};
template <class T, class A>
struct ElementOf<std::vector<T, A>> {
  using type = T;
};

/// Do the members that a type states fill it, but for gaps that alignment asks for? The same of all types that it is made of.
template <class T>
void expect_all_stated(const T& object, const std::string& name, int& types) {
  ++types;
  struct Part {
    std::size_t begin, end, alignment;
    std::string name;
  };
  std::vector<Part> parts;
  T::for_members(object, [&](const Member& m, const auto& part) {
    using P = std::remove_cvref_t<decltype(part)>;
    const auto begin = static_cast<std::size_t>(reinterpret_cast<const char*>(&part) - reinterpret_cast<const char*>(&object));
    parts.push_back({begin, begin + sizeof(P), alignof(P), m.name});
    if constexpr (HasMembers<P>) expect_all_stated(part, name + "." + m.name, types);
    if constexpr (requires { typename ElementOf<P>::type; }) {
      if constexpr (HasMembers<typename ElementOf<P>::type>)
        expect_all_stated(typename ElementOf<P>::type{}, name + "." + m.name + "[]", types);
    }
  });
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.begin < b.begin; });
  std::size_t end = 0;
  for (const Part& p : parts) {
    EXPECT_LT(p.begin - end, p.alignment) << name << " has a member before " << p.name << " that it does not state, or states one twice";
    end = p.end;
  }
  EXPECT_LT(sizeof(T) - end, alignof(T)) << name << " has a member at its end that it does not state";
}

TEST(Members, AreAllStated) {
  int types = 0;
  expect_all_stated(State<2>{}, "State", types);
  expect_all_stated(State<3>{}, "State", types);
  EXPECT_GT(types, 50) << "of how many types the members were looked at";
}

struct Forgetful {
  double stated = 0, not_stated = 0;
  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    visit(Member{"stated"}, self.stated);
  }
};

TEST(Members, OneThatIsNotStatedIsFound) {
  const auto found = [](const auto& object) {
    testing::TestPartResultArray failures;
    {
      testing::ScopedFakeTestPartResultReporter catcher(testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD,
                                                        &failures);
      int types = 0;
      expect_all_stated(object, "it", types);
    }
    return failures.size();
  };
  EXPECT_EQ(found(Forgetful{}), 1);
  EXPECT_EQ(found(RunClock{}), 0);
}

/// A state with something in every member.
template <int Dim>
State<Dim> filled() {
  State<Dim> s;
  s.particles.packs = 3;
  s.particles.history_size = 5;
  s.particles.remembers_contact = s.particles.has_domains = s.particles.keeps_turn = s.particles.watched = true;
  s.particles.allocate();
  std::mt19937_64 random(1);
  const auto number = [&] { return std::uniform_real_distribution<>(-1, 1)(random); };
  Particles<Dim>::for_arrays(s.particles, [&](const Member&, auto& array, auto) {
    for (auto& x : array) {
      using X = std::remove_cvref_t<decltype(x)>;
      if constexpr (std::is_integral_v<X>) {
        x = static_cast<X>(random());
      } else if constexpr (std::is_same_v<X, double>) {
        x = number();
      } else if constexpr (std::is_same_v<X, Pack>) {
        x = Pack{number(), number(), number(), number()};
      } else {
        for (double& c : x.c) c = number();
      }
    }
  });
  s.particles.lead = 0.3;
  for (std::size_t p = 0; p < s.particles.size(); ++p) s.particles.id[p] = p == 11 ? padding_id : static_cast<std::uint32_t>(p * 7 % 12);
  s.clock = {1, 2, 3, 4, 5, 6, 7};
  s.order = {{{0, 1, 0}, {1, 3, 1}}, {{5, 0, 1}, {9, 1, 2}}, false, 11, 1};
  Crack<Dim>& crack = s.cracks.list.emplace_back();
  crack.name = "c";
  crack.plane = crack.upper = crack.lower = crack.original = {Vec<Dim>{}, Vec<Dim>{{1, 2}}};
  crack.facets = {{0, 1}};
  crack.upper_carriers = crack.lower_carriers = {{{1, 0, 0.5}, {2, 1, 0.5}}, {}};
  crack.extension = {1, 2};
  crack.mirrored = {0, 1};
  crack.traction.area = {1, 2};
  crack.traction.history.resize(2);
  crack.traction.history[1].damage = 0.5;
  crack.traction.force = {Vec<Dim>{}, Vec<Dim>{}};
  crack.traction.stored = {1, 2};
  crack.traction.between = {true, false};
  crack.fading.resize(1);
  crack.fading[0].until = 0.5;
  s.fracture.nucleations.resize(1);
  s.fracture.nucleations[0].made = 3;
  s.fracture.energy = 2;
  s.fracture.tips.resize(1);
  s.fracture.tips[0] = {
      0, 1, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, NoParameter::none, NoParameter::tip}, 8, 9, 1, TipStatus::grows, 1, 2, 3, {{4, 5}}, true};
  s.fracture.next = s.fracture.energy_by_J = 1;
  ContactName contact;
  contact.crack = 3;
  contact.others.insert(2);
  s.contacts.entries = {{{4, contact}, ContactState::slip}};
  s.contacts.sides = {{4, 1, -1}};
  s.contacts.initial_volume = {{4, 0.5}, {2, 0.25}};
  s.conditions = {{true, false, true}, {7, 8}};
  s.rigid.resize(2);
  s.rigid[1].present.centre[0] = 2;
  s.pieces.list.resize(1);
  s.pieces.of_field = {0};
  s.pieces.of_particle = {0, 1};
  s.ledger.events.push_back({1, 0, {}, 2, 3, CrackEvent<Dim>::Kind::grew, 1, 4, 5, 6, 7, 8});
  s.ledger.reactions = {Vec<Dim>{}};
  s.ledger.rigid_reactions.resize(1);
  s.ledger.face_areas = {Vec<Dim>{}};
  s.observed = {1, {2}, {{true, false}, {}}};
  return s;
}

template <int Dim>
void expect_round_trip() {
  const State<Dim> state = filled<Dim>();
  const SavedState kept = save_state(state);
  for (const NamedArray& a : kept.arrays()) EXPECT_FALSE(a.data.empty()) << a.name << ": the test has nothing in it";
  State<Dim> other;
  load_state(other, kept);
  const auto difference = first_difference(kept, save_state(other));
  EXPECT_FALSE(difference) << difference->text();
  EXPECT_EQ(hash_state(other, 1), hash_state(state, 2));
}
TEST(Members, AreKept) {
  expect_round_trip<2>();
  expect_round_trip<3>();
}

/// A saved state with one bit changed in the last entry of an array.
SavedState changed(const SavedState& from, const std::string& name, std::size_t byte) {
  SavedState out;
  for (const NamedArray& a : from.arrays()) {
    std::vector<std::byte> data = a.data;
    if (a.name == name) data[byte] ^= std::byte{1};
    out.add(a.name, Member{"", "", a.use}, a.layout, data.data());
  }
  return out;
}

/// What says how long arrays are or which particles stand where decides how everything else is read.
bool is_structure(const std::string& name) {
  return name.ends_with(".count") || name.starts_with("order.") || name == "particles.packs" || name == "particles.history_size" ||
         name == "particles.remembers_contact" || name == "particles.has_domains" || name == "particles.keeps_turn" ||
         name == "particles.watched";
}

TEST(Members, EachCountsInTheHashAndIsNamedWhenItDiffers) {
  const State<2> state = filled<2>();
  const SavedState kept = save_state(state);
  const std::uint64_t hash = hash_state(state, 1);
  int looked_at = 0;
  for (const NamedArray& a : kept.arrays()) {
    if (is_structure(a.name)) continue;
    ++looked_at;
    const SavedState other = changed(kept, a.name, 0);  // the first entry: a particle that is there
    const auto difference = first_difference(kept, other);
    ASSERT_TRUE(difference) << a.name;
    EXPECT_EQ(difference->name, a.name);
    EXPECT_EQ(difference->row, 0u) << a.name;
    EXPECT_NE(difference->before, difference->after) << a.name;
    State<2> loaded;
    load_state(loaded, other);
    if (a.use == Use::course) {
      EXPECT_NE(hash_state(loaded, 1), hash) << a.name << " does not count";
    } else {
      EXPECT_EQ(hash_state(loaded, 1), hash) << a.name << " is shown and must not count";
    }
  }
  EXPECT_GT(looked_at, 90);
}

TEST(Members, TheFirstDifferenceIsThatOfTheFirstMember) {
  const SavedState kept = save_state(filled<2>());
  const NamedArray& stress = *kept.find("particles.stress");
  const std::size_t row = 7, component = 2;
  const SavedState other =
      changed(changed(kept, "ledger.energy.damping", 0), "particles.stress", (row * stress.layout.width + component) * 8);
  const auto difference = first_difference(kept, other);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->name, "particles.stress");
  EXPECT_EQ(difference->row, row);
  EXPECT_EQ(difference->component, component);
  EXPECT_TRUE(difference->text().starts_with("particles.stress, row 7, component 2: ")) << difference->text();
}

TEST(Members, WhatIsMissingOrOfAnotherKindIsRefusedByName) {
  const SavedState kept = save_state(filled<2>());
  const auto error = [&](const std::string& name, auto change) {
    SavedState out;
    for (const NamedArray& a : kept.arrays()) {
      NamedArray b = a;
      if (a.name == name && !change(b)) continue;
      out.add(b.name, Member{"", "", b.use}, b.layout, b.data.data());
    }
    State<2> state;
    try {
      load_state(state, out);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error("particles.stress", [](NamedArray&) { return false; }), "particles.stress: it was not kept");
  EXPECT_EQ(error("clock.step", [](NamedArray& a) { return a.layout.scalar = Scalar::u64, true; }),
            "clock.step: 1 numbers u64 a row were kept, not 1 numbers i64");
  EXPECT_EQ(error("contacts.entries.state", [](NamedArray& a) { return a.layout.rows = 0, true; }),
            "contacts.entries.state: it has not as many rows as the others of contacts.entries");
  EXPECT_EQ(error("contacts.initial_volume.key", [](NamedArray& a) { return a.layout.rows = 1, true; }),
            "contacts.initial_volume: there are not as many keys as values");
  EXPECT_NE(error("cracks.list[0].upper_carriers.weight", [](NamedArray& a) { return a.layout.rows = 1, true; }), "no error");
}

/// Particles of the same state in another order have the same hash only where their places in blocks are the same.
TEST(Members, TheHashDoesNotDependOnWhereBlocksStandInMemory) {
  State<2> one = filled<2>();
  const std::uint64_t hash = hash_state(one, 1);
  // The two blocks change places: packs 1 and 2 first, then pack 0.
  State<2> other = filled<2>();
  Particles<2>::for_arrays(other.particles, [&](const Member&, auto& array, auto) {
    const std::size_t of_pack = array.size() / 3;
    std::rotate(array.begin(), array.begin() + of_pack, array.end());
  });
  other.order.runs = {{0, 2, 1}, {2, 3, 0}};
  other.order.blocks = {{9, 0, 1}, {5, 1, 2}};
  EXPECT_EQ(hash_state(other, 1), hash);
  other.order.blocks = {{5, 0, 1}, {9, 1, 2}};
  EXPECT_NE(hash_state(other, 1), hash);
}

}  // namespace
}  // namespace crampon
