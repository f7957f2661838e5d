#pragma once
/// The quantities of vertices of cracks, a line of a table each. Frames of cracks and the reference page follow from it.

#include <functional>
#include <string>
#include <vector>

#include "crampon/state/fracture.hpp"
#include "crampon/state/traction_history.hpp"
#include "crampon/step/crack_motion.hpp"

namespace crampon {

/// A vertex of a crack as users meet it.
struct CrackVertexView {
  CrackOpening opening;
  TractionHistory traction{};     ///< all zero where no law acts
  const CrackTip* tip = nullptr;  ///< null: the vertex is no tip
};

/// Which frames have a quantity.
enum class CrackFrames {
  all,
  with_tractions,  ///< of runs in which a crack has a traction law
  with_fracture,   ///< of runs with [fracture]
};

/// A quantity of vertices, SI.
struct CrackQuantity {
  std::string name, unit;
  CrackFrames in = CrackFrames::all;
  std::string meaning, formula;
  std::function<double(const CrackVertexView&)> get;
};

/// In the order of the files.
const std::vector<CrackQuantity>& crack_quantities();

}  // namespace crampon
