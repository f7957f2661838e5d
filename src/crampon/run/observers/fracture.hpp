#pragma once
#include <algorithm>
#include <string>

#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// What was last found at the tips of cracks, and how long cracks are.
template <int Dim>
class FractureParameters final : public Observer<Dim> {
  struct Length {
    double length = 0;  ///< m
  };
  struct Energy {
    double by_faces = 0, by_J = 0;  ///< J
  };

 public:
  struct Tip {
    const CrackTip& is;
    bool bridged = false;  ///< a traction law acts on its crack
    bool may_grow = false;
  };
  /// Frames of cracks hold these too, at tips (run/crack_quantities.cpp).
  static const auto& tip_table() {
    static const std::vector<Column<Tip>> all = {
        {{"J.NAME.END", "J/m2",
          "J at an end of a crack, start or end: energy that goes into the tip for each area by which the crack grows",
          "docs/theory/fracture.md"},
         [](const Tip& t, int) { return t.is.now.J; }},
        {{"J_far.NAME.END", "J/m2", "J far from the tip: what tractions on the faces take is not yet taken off", "docs/theory/fracture.md"},
         [](const Tip& t, int) { return t.is.now.J_far; }},
        {{"J_across.NAME.END", "J/m2", "second component of J: what would go into the tip if it moved to the left",
          "docs/theory/fracture.md"},
         [](const Tip& t, int) { return t.is.now.J_across; }},
        {{"R.NAME.END", "J/m2", "what it takes to let a crack whose faces tractions hold grow on; where its crack has a traction law",
          "J, and what tractions have dissipated for each area where they end behind the tip"},
         [](const Tip& t, int) { return t.is.now.R; },
         Axes::none,
         [](const Tip& t) { return t.bridged; }},
        {{"K_I.NAME.END", "Pa m^(1/2)", "intensity of opening", "docs/theory/fracture.md"}, [](const Tip& t, int) { return t.is.now.K_I; }},
        {{"K_II.NAME.END", "Pa m^(1/2)",
          "intensity of sliding; positive where the left side, seen along the crack towards the tip, moves ahead",
          "docs/theory/fracture.md"},
         [](const Tip& t, int) { return t.is.now.K_II; }},
        {{"phase.NAME.END", "rad", "sliding against opening, two cells behind the tip", "atan2(sliding, opening)"},
         [](const Tip& t, int) { return t.is.now.phase; }},
        {{"tip_speed.NAME.END", "m/s", "mean speed of a tip that may grow over about the last two cells",
          "docs/theory/fracture.md, tips that run"},
         [](const Tip& t, int) { return t.is.now.speed; },
         Axes::none,
         [](const Tip& t) { return t.may_grow; }},
        {{"grown.NAME.END", "m", "how far a tip has grown since the start", "sum of its increments"},
         [](const Tip& t, int) { return t.is.grown; },
         Axes::none,
         [](const Tip& t) { return t.may_grow; }},
    };
    return all;
  }
  static const auto& length_table() {
    static const std::vector<Column<Length>> all = {
        {{"crack_length.NAME", "m", "length of the path of a crack", "sum of the lengths of its segments"},
         [](const Length& l, int) { return l.length; }},
    };
    return all;
  }
  static const auto& energy_table() {
    static const std::vector<Column<Energy>> all = {
        {{"fracture_energy", "J",
          "taken by the faces that part as tips grow, since the start; where cracks grow. What has held them together fades, and does this "
          "work",
          "sum over steps of the fading tractions times the opening"},
         [](const Energy& e, int) { return e.by_faces; }},
        {{"fracture_energy_by_J", "J", "what tips have taken by their J as they grew, since the start: not a part of the balance",
          "sum of J times the area by which a tip grows"},
         [](const Energy& e, int) { return e.by_J; }},
    };
    return all;
  }
  static std::vector<ColumnDescription> describe() {
    std::vector<ColumnDescription> all = descriptions_in(tip_table());
    for (ColumnDescription& d : descriptions_in(length_table())) all.push_back(std::move(d));
    for (ColumnDescription& d : descriptions_in(energy_table())) all.push_back(std::move(d));
    return all;
  }

  void look(const Present<Dim>& now, Cells& cells) const override {
    if constexpr (Dim == 2) {
      if (!now.model.fracture.on) return;
      for (const CrackTip& tip : now.state.fracture.tips) {
        const GrowthModel& growth = now.model.growth[tip.crack];
        cells.add<Dim>(tip_table(), Tip{tip, now.model.tractions[tip.crack].acts(), growth.acts() && growth.end[tip.end]},
                       now.state.cracks.list[tip.crack].name + (tip.end == 0 ? ".start" : ".end"));
      }
      for (const Crack<2>& crack : now.state.cracks.list) {
        Length l;
        for (std::size_t v = 1; v < crack.plane.size(); ++v) l.length += norm(crack.plane[v] - crack.plane[v - 1]);
        cells.add<Dim>(length_table(), l, crack.name);
      }
      const auto& growth = now.model.growth;
      if (std::any_of(growth.begin(), growth.end(), [](const GrowthModel& g) { return g.acts(); }))
        cells.add<Dim>(energy_table(), Energy{now.state.fracture.energy, now.state.fracture.energy_by_J});
    }
  }
};

}  // namespace crampon
