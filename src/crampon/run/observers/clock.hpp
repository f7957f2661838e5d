#pragma once
#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// The time of the row, which is the first column.
template <int Dim>
class Clock final : public Observer<Dim> {
 public:
  static const auto& table() {
    static const std::vector<Column<Present<Dim>>> all = {
        {{"time", "s", "time of the row", "t"}, [](const Present<Dim>& now, int) { return now.state.clock.time; }},
    };
    return all;
  }
  void look(const Present<Dim>& now, Cells& cells) const override { cells.add<Dim>(table(), now); }
};

}  // namespace crampon
