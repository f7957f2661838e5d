#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

namespace {

/// Has the crack a tip? May one of its tips grow?
bool any_tip(const std::vector<CrackTip>& tips, std::size_t crack, const GrowthModel* growth) {
  return std::any_of(tips.begin(), tips.end(),
                     [&](const CrackTip& tip) { return tip.crack == crack && (!growth || growth->end[tip.end]); });
}

}  // namespace

template <int Dim>
void note_idle_growth(const Start<Dim>& start, Notes& notes) {
  const std::vector<CrackTip>& tips = start.state.fracture.tips;
  if (!start.problem.fracture) return;
  if (tips.empty()) {
    notes.push_back({start.problem.fracture->location, "no crack has a tip in a body", "there is no J to find",
                     "let a crack end inside a body, or remove [fracture]"});
  }
  for (std::size_t c = 0; c < start.problem.cracks.size(); ++c) {
    const CrackInput& crack = start.problem.cracks[c];
    if (!crack.growth || any_tip(tips, c, &start.model.growth[c])) continue;
    notes.push_back({crack.at("growth"), fmt::format("the crack \"{}\" has no tip that may grow", crack.name),
                     any_tip(tips, c, nullptr) ? "growth.ends leaves out the end that lies in a body"
                                               : "both of its ends lie outside of every body, or on a mirror",
                     "let it end inside a body, or remove growth"});
  }
  const double least = std::fmin(FractureModel::least_outer, start.model.fracture.outer);
  for (const NucleationInput& nucleation : start.problem.nucleations) {
    if (!nucleation.growth || nucleation.length >= least) continue;
    notes.push_back({nucleation.at("length"),
                     fmt::format("cracks of the nucleation \"{}\" are {:g} cells long and are to grow", nucleation.name, nucleation.length),
                     fmt::format("there is J only where {:g} cells about a tip are free, also of the other tip", least),
                     fmt::format("make length at least {:g}, or remove growth", least + 1)});
  }
}

template void note_idle_growth(const Start<2>&, Notes&);
template void note_idle_growth(const Start<3>&, Notes&);

}  // namespace crampon
