#pragma once
#include "crampon/run/observers/observer.hpp"
#include "crampon/step/face_loads.hpp"

namespace crampon {

template <int Dim>
class Loads final : public Observer<Dim> {
 public:
  static const auto& table() {
    static const std::vector<Column<Vec<Dim>>> all = {
        {{"load_AXIS.NAME", "N", "resultant of a load at the time of the row", ""},
         [](const Vec<Dim>& force, int axis) { return force[axis]; },
         Axes::of_space},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override {
    const std::vector<Vec<Dim>> forces = total_loads(now.state, now.work, now.model, now.state.clock.time);
    for (std::size_t l = 0; l < forces.size(); ++l) cells.add<Dim>(table(), forces[l], now.model.loads[l].name);
  }
};

}  // namespace crampon
