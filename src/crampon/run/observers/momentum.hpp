#pragma once
#include "crampon/run/observers/observer.hpp"

namespace crampon {

template <int Dim>
class Momentum final : public Observer<Dim> {
 public:
  static const auto& table() {
    using Sums = ParticleSums<Dim>;
    static const std::vector<Column<Sums>> all = {
        {{"momentum_AXIS", "kg m/s", "of all particles that are not rigid", "sum of m v"},
         [](const Sums& s, int axis) { return s.momentum[axis]; },
         Axes::of_space},
        {{"angular_momentum_z", "kg m2/s", "about the origin of coordinates", "sum of m (x v_y - y v_x)"},
         [](const Sums& s, int) { return s.angular; }},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override { cells.add<Dim>(table(), now.sums()); }
};

}  // namespace crampon
