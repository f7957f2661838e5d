#pragma once
#include <span>

#include "crampon/crack/j_integral.hpp"
#include "crampon/crack/tip_domain.hpp"

namespace crampon {

/// J of a tip, in its frame, J/m2, by Rice's form: along a circle of the radius (m) about the tip, from the lower face of the crack to the upper one, and over what
/// lies inside (docs/theory/fracture.md, the contour form):
///   J_k = int [(W + K) n_k - P_iJ n_J u_i,k] ds + sum A rho [a_i u_i,k - v_i v_i,k] + sum T . d(opening) + sum l (W + K) n_k.
/// It takes what j_integral() takes, and is its limit for a weight that falls from 1 to 0 at the radius. On the circle values come from the samples about 1.5
/// cells (m) around on the same side of the crack, by fits that are exact for linear fields.
Vec<2> contour_integral(std::span<const TipSample> samples, const TipPath& path, double radius, double cell,
                        std::span<const FaceTraction> tractions, std::span<const CrackSideSample> faces = {});

}  // namespace crampon
