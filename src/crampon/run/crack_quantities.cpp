#include "crampon/run/crack_quantities.hpp"

#include <limits>

#include <fmt/format.h>

#include "crampon/run/observers/fracture.hpp"

namespace crampon {

namespace {

using View = CrackVertexView;

/// A value that tips alone have.
std::function<double(const View&)> at_tips(std::function<double(const CrackTip&)> get) {
  return [get = std::move(get)](const View& v) { return v.tip ? get(*v.tip) : std::numeric_limits<double>::quiet_NaN(); };
}

std::string meaning_of_status() {
  std::string text = "what has become of a tip:";
  for (std::size_t k = 0; k < tip_status_words.size(); ++k)
    text += fmt::format("{} {} {} ({})", k == 0 ? "" : ",", k, tip_status_words[k].word, tip_status_words[k].meaning);
  return text;
}

// A further quantity of vertices is one line here; what tips have is one line in run/observers/fracture.hpp.
std::vector<CrackQuantity> table() {
  using In = CrackFrames;
  std::vector<CrackQuantity> list = {
      {"opening", "m", In::all, "how far the two surfaces are apart across the crack; negative where they overlap",
       "(x_upper - x_lower) along the normal of the crack", [](const View& v) { return v.opening.opening; }},
      {"sliding", "m", In::all, "how far the upper surface has gone ahead of the lower one, along the direction of the path",
       "(x_upper - x_lower) along the crack", [](const View& v) { return v.opening.sliding; }},
      {"traction_normal", "Pa", In::with_tractions, "traction of the law against opening", "by the traction law",
       [](const View& v) { return v.traction.normal_traction; }},
      {"traction_shear", "Pa", In::with_tractions, "traction of the law against sliding", "by the traction law",
       [](const View& v) { return v.traction.shear_traction; }},
      {"damage", "1", In::with_tractions, "0 where the law is whole, 1 where it has failed", "by the traction law",
       [](const View& v) { return v.traction.damage; }},
      {"cohesive_loss_I", "J/m2", In::with_tractions, "spent by the law in opening since the start, for each area of the crack", "G_I",
       [](const View& v) { return v.traction.dissipated_normal; }},
      {"cohesive_loss_II", "J/m2", In::with_tractions, "spent by the law in sliding since the start, for each area of the crack", "G_II",
       [](const View& v) { return v.traction.dissipated_shear; }},
  };
  for (const auto& column : FractureParameters<2>::tip_table()) {
    list.push_back({column.is.pattern.substr(0, column.is.pattern.find('.')), column.is.unit, In::with_fracture, column.is.meaning,
                    column.is.formula, at_tips([&column](const CrackTip& tip) {
                      return column.get({tip, true, true}, 0);
                    })});
  }
  list.push_back({"tip_status", "1", In::with_fracture, meaning_of_status(), "",
                  at_tips([](const CrackTip& tip) { return static_cast<double>(tip.status); })});
  return list;
}

}  // namespace

const std::vector<CrackQuantity>& crack_quantities() {
  static const std::vector<CrackQuantity> all = table();
  return all;
}

}  // namespace crampon
