#pragma once
/// What the integrals about a tip take of particles and cracks, in the frame of the tip (crack/tip_domain.hpp).

#include <cstdint>
#include <vector>

#include "crampon/crack/j_integral.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"
#include "crampon/step/tip_frame.hpp"

namespace crampon {

/// Particles about each tip of the state, with their velocities and displacement gradients.
std::vector<TipWatch> watch_particles(const State<2>& state, const Model<2>& model);

/// Particles within a radius (m) that belong to the material of the tip, after a step of dt (s); 0: as if all were at rest. Bodies that follow their deformation are
/// turned back by the mean turn about the tip, so that what is added up is small where strains are.
std::vector<TipSample> take_samples(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipFrame& frame,
                                    const TipWatch& watch, std::uint32_t material, double radius, double dt);

/// Pieces of the crack with a middle within the radius (m; infinite: all of it) that bear tractions of a law. extension: of the crack; null: all count 1.
std::vector<FaceTraction> take_tractions(const State<2>& state, const Model<2>& model, const CrackTip& tip, double radius,
                                         const VirtualExtension* extension);

/// Pieces of the crack on which no law acts and which are pressed together, with the traction of their contact: the mean stress beside them (sides, of take_sides). Pressed are
/// those which bear pressure and whose opening is less than what that pressure strains in a cell. What they give way across the crack is not counted. modulus: Pa.
std::vector<FaceTraction> take_contact_tractions(const State<2>& state, const Model<2>& model, const CrackTip& tip,
                                                 const VirtualExtension& extension, const std::vector<CrackSideSample>& sides,
                                                 double modulus);

/// The path of the crack from the tip backwards, m.
std::vector<Vec<2>> path_behind(const Crack<2>& crack, const CrackTip& tip, const TipFrame& frame);

/// Both sides of the pieces of a path with a middle within the radius, m: means over the samples within a cell (m) beside them.
std::vector<CrackSideSample> take_sides(const std::vector<Vec<2>>& path, const std::vector<TipSample>& samples, double radius, double cell);

}  // namespace crampon
