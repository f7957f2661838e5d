#pragma once
#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// What boundaries, symmetry planes, rigid bodies and walls do to the material in the last step: forces of conditions first, then forces and torques
/// of rigid bodies.
template <int Dim>
class Reactions final : public Observer<Dim> {
  struct Reaction {
    RigidReaction<Dim> of;
    bool turns = false;  ///< it is of a body, which has a torque
  };

 public:
  static const auto& table() {
    static const std::vector<Column<Reaction>> all = {
        {{"reaction_AXIS.NAME", "N", "force of a boundary, symmetry plane, rigid body or wall on the material, in the last step", ""},
         [](const Reaction& r, int axis) { return r.of.force[axis]; },
         Axes::of_space},
        {{"torque_AXIS.NAME", "N m", "moment of a rigid body or wall on the material about its centre, in the last step", ""},
         [](const Reaction& r, int axis) { return r.of.torque[static_cast<std::size_t>(axis)]; },
         Axes::of_turning,
         [](const Reaction& r) { return r.turns; }},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override {
    const State<Dim>& state = now.state;
    for (std::size_t c = 0; c < now.model.conditions.size(); ++c) {
      Reaction r;
      if (c < state.ledger.reactions.size()) r.of.force = state.ledger.reactions[c];
      cells.add<Dim>(table(), r, now.model.conditions[c].name);
    }
    for (std::size_t b = 0; b < now.model.rigid_bodies.size(); ++b) {
      if (now.model.rigid_bodies[b].prescribes()) continue;  // its condition has the columns
      Reaction r{b < state.ledger.rigid_reactions.size() ? state.ledger.rigid_reactions[b] : RigidReaction<Dim>{}, true};
      cells.add<Dim>(table(), r, now.model.rigid_bodies[b].name);
    }
  }
};

}  // namespace crampon
