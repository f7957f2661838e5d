#pragma once
#include <span>

#include "crampon/crack/j_integral.hpp"
#include "crampon/crack/tip_domain.hpp"
#include "crampon/crack/tip_field.hpp"

namespace crampon {

/// By the interaction integral: J of the sum of the fields and a known field, less J of each (docs/theory/fracture.md, stress intensities). The known field
/// moves with the tip.
StressIntensity interaction_integral(std::span<const TipSample> samples, const VirtualExtension& extension, const TipPath& path,
                                     const SteadyTip& tip, std::span<const FaceTraction> tractions,
                                     std::span<const CrackSideSample> faces = {});

/// J in the proportion of two intensities: J says how large they are together, G = (A_I K_I^2 + A_II K_II^2)/E'. It does not depend on where exactly the
/// tip is taken to be, as the interaction integral does. Without J both are zero.
StressIntensity share(double J, const StressIntensity& proportion, const SteadyTip& tip);

/// By the opening behind the tip: J divided in the proportion of opening and sliding (docs/theory/fracture.md, stress intensities). opening: in the frame of
/// the tip, {sliding, opening}, m, of the side to the left. Without an opening both are zero. A closed crack has no opening intensity.
StressIntensity partition_by_opening(double J, const Vec<2>& opening, const SteadyTip& tip);

}  // namespace crampon
