#pragma once
#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// What has left the grid, where the input says that it may.
template <int Dim>
class LeftGrid final : public Observer<Dim> {
 public:
  static const auto& table() {
    using Sums = ParticleSums<Dim>;
    static const std::vector<Column<Sums>> all = {
        {{"left_mass", "kg", "that has left the grid (method.leaving_particle = \"remove\")", ""},
         [](const Sums& s, int) { return s.mass; }},
        {{"left_energy", "J", "kinetic and strain energy that left with it", ""}, [](const Sums& s, int) { return s.kinetic + s.strain; }},
        {{"left_momentum_AXIS", "kg m/s", "momentum that left with it", ""},
         [](const Sums& s, int axis) { return s.momentum[axis]; },
         Axes::of_space},
        {{"left_angular_momentum_z", "kg m2/s", "angular momentum that left with it", ""}, [](const Sums& s, int) { return s.angular; }},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override {
    if (now.model.leaving_particle == LeavingParticle::remove) cells.add<Dim>(table(), now.state.ledger.left);
  }
};

}  // namespace crampon
