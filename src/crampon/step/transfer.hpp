#pragma once
/// How particles take up what nodes have found (docs/theory/step.md, transfers).

#include <cstdint>
#include <variant>

#include "crampon/core/declaration.hpp"
#include "crampon/core/options.hpp"

namespace crampon {

/// FLIP: particles add the accelerations of nodes to their own velocities (N03 Eq. 30), or take, to the part `pic`, the velocities of nodes.
struct FlipTransfer {
  double pic = 0;  ///< part of PIC, 0 to 1
  static const Declaration<FlipTransfer>& declaration();
};

/// XPIC(order) (Hammerquist & Nairn, CMAME 318 (2017) 724): velocities of nodes at the start of the step, cleared of what particles could not
/// have given them, plus accelerations. Order 1 is PIC.
struct XpicTransfer {
  int order = 2;
  int every = 1;  ///< in every so many steps, FLIP in between
  static const Declaration<XpicTransfer>& declaration();
};

/// FMPM(order) (Nairn & Hammerquist, CMAME 377 (2021)): the same for velocities at the end of the step: the first terms of the inverse
/// of the full mass matrix. Order 1 is PIC. In every step: accelerations of short waves are up to `order` times those of FLIP, and a change
/// between the two shakes a body until it breaks (docs/decisions/0011-transfers.md).
struct FmpmTransfer {
  int order = 2;
  static const Declaration<FmpmTransfer>& declaration();
};

using TransferSpec = std::variant<FlipTransfer, XpicTransfer, FmpmTransfer>;

/// The family as the input sees it: `transfer = { kind = "fmpm", order = 2 }`.
const Family<TransferSpec>& transfers();

/// What the transfer does in one step.
struct StepTransfer {
  int terms = 0;                 ///< of the series for the velocities of nodes; 0: FLIP
  bool of_start = false;         ///< the series is that of the velocities at the start (XPIC)
  bool re_extrapolates = false;  ///< Task 6: are momenta extrapolated from particles once more, to strain them or to move them?
};

/// A series always goes with Task 6: strain and positions follow the velocities that particles have taken (docs/decisions/0011-transfers.md).
StepTransfer step_transfer(const TransferSpec&, StressUpdate, PositionUpdate, std::int64_t step);

/// What a particle makes of its velocity V in Task 5: taken = own V + nodal (sum S v') + gain (sum S a). Then damping takes `damped` V away.
struct VelocityRule {
  double own = 1, nodal = 0;
  double gain = 0;              ///< s
  double damped = 0;            ///< 1 - exp(-kappa_p dt)
  double share_of_damping = 0;  ///< of what goes with `nodal`
  double dt = 0;                ///< s
  /// A change d of a particle's velocity changes the work on the strain that follows by strain_share m d . (dt sum S a). It is half of the
  /// step's; with USL, which has strained with the velocities before, the other half is missing instead.
  double strain_share = 0.5;

  bool is_flip() const { return own == 1 && nodal == 0 && damped == 0; }
};

/// Damping (1/s) is a force on particles. Nodes lose the part of it that they see. The velocity of a FLIP particle has another part, which
/// nodes do not see; damping takes the same fraction of it. With N03 Eq. 30 (PositionUpdate::n03) this other part is not damped.
/// particle_damping: 1/s.
VelocityRule velocity_rule(const TransferSpec&, const StepTransfer&, StressUpdate, PositionUpdate, double dt, double damping,
                           double particle_damping);

}  // namespace crampon
