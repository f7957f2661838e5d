#include <fmt/format.h>

#include <algorithm>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

template <int Dim>
void note_braked_rotation(const Start<Dim>& start, Notes& notes) {
  const TransferSpec& transfer = start.problem.method.transfer;
  const auto* flip = std::get_if<FlipTransfer>(&transfer);
  if (start.problem.method.rotation == RotationTransfer::carried || (flip && flip->pic == 0)) return;
  for (const BodyInput& body : start.problem.bodies) {
    if (std::all_of(body.spin.begin(), body.spin.end(), [](double w) { return w == 0; })) continue;
    notes.push_back({body.at("spin"), fmt::format("the body \"{}\" turns, and method.transfer brakes rotation", body.name),
                     "momenta do not carry rotation, and what particles take from nodes has lost a part of the spin",
                     "use rotation = \"carried\", or flip without pic"});
  }
}

template void note_braked_rotation(const Start<2>&, Notes&);
template void note_braked_rotation(const Start<3>&, Notes&);

}  // namespace crampon
