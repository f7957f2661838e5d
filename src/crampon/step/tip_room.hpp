#pragma once
/// How large a domain there is room for about a tip, and which particles belong to it (docs/theory/fracture.md, the domain).

#include <cstdint>
#include <optional>

#include "crampon/step/model.hpp"
#include "crampon/step/tip_frame.hpp"
#include "crampon/step/tip_watch.hpp"

namespace crampon {

/// The material about a tip: that of the nearest particle; none when that is more than a cell away.
std::optional<std::uint32_t> material_at_tip(const State<2>& state, const Model<2>& model, const Vec<2>& tip, const TipWatch& watch);

/// Are two materials of one piece: of one velocity field, or of fields that bonds join?
bool belong_together(const Model<2>& model, std::uint32_t a, std::uint32_t b);

/// Radius of the domain about a tip, m, and what keeps it from the radius that the model asks for.
struct TipRoom {
  double radius = 0;
  NoParameter bound = NoParameter::none;
};
TipRoom find_room(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch);

}  // namespace crampon
