#pragma once
/// From state to the integrals about a tip: where tips lie, what particles about them hold, how large a domain there is room for.

#include <vector>

#include "crampon/crack/criteria/tip_state.hpp"
#include "crampon/crack/j_integral.hpp"
#include "crampon/crack/stress_intensity.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// The vertices of a crack from a tip backwards.
class TipVertices {
 public:
  TipVertices(const Crack<2>& crack, const CrackTip& tip) : count_(crack.plane.size()), from_start_(tip.end == 0) {}
  std::size_t size() const { return count_; }
  std::size_t operator[](std::size_t k) const { return from_start_ ? k : count_ - 1 - k; }
  /// Of the opening, upper less lower, that of the side to the left of a tip less that to the right.
  double sign() const { return from_start_ ? -1 : 1; }

 private:
  std::size_t count_;
  bool from_start_;
};

/// Cells between the ends of the chord that gives a tip its direction.
inline constexpr double chord_in_cells = 2;

/// In the undeformed body, and at present.
TipFrame original_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip);
TipFrame present_frame(const Model<2>& model, const Crack<2>& crack, const CrackTip& tip);

/// Particles about each tip of the state, with their velocities and displacement gradients.
std::vector<TipWatch> watch_particles(const State<2>& state, const Model<2>& model);

/// Radius of the domain about a tip, m, and what keeps it from the radius that the model asks for.
struct TipRoom {
  double radius = 0;
  NoParameter bound = NoParameter::none;
};
TipRoom find_room(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch);

/// What criteria of growth may ask of a tip whose parameters have just been found.
TipState state_of_tip(const State<2>& state, const Model<2>& model, const CrackTip& tip, const TipWatch& watch);

/// Parameters of a tip after a step of dt. dt = 0: as if all were at rest.
void find_parameters(const State<2>& state, const StepWork<2>& work, const Model<2>& model, const TipWatch& watch, double dt,
                     CrackTip& tip);

}  // namespace crampon
