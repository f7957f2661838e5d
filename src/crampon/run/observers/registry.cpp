#include "crampon/run/observers/registry.hpp"

#include "crampon/run/observers/clock.hpp"
#include "crampon/run/observers/energies.hpp"
#include "crampon/run/observers/left_grid.hpp"
#include "crampon/run/observers/loads.hpp"
#include "crampon/run/observers/momentum.hpp"
#include "crampon/run/observers/openings.hpp"
#include "crampon/run/observers/probes.hpp"
#include "crampon/run/observers/reactions.hpp"

namespace crampon {

namespace {

template <int Dim>
struct Kind {
  std::unique_ptr<Observer<Dim>> (*make)();
  std::vector<ColumnDescription> (*describe)();
};

template <int Dim, class Observing>
Kind<Dim> kind() {
  return {[]() -> std::unique_ptr<Observer<Dim>> { return std::make_unique<Observing>(); },
          [] {
            if constexpr (requires { Observing::table(); })
              return descriptions_in(Observing::table());
            else
              return Observing::describe();
          }};
}

// A further observer is one file like momentum.hpp and one line here.
template <int Dim>
std::vector<Kind<Dim>> kinds() {
  return {
      kind<Dim, Clock<Dim>>(),      //
      kind<Dim, Energies<Dim>>(),   //
      kind<Dim, Momentum<Dim>>(),   //
      kind<Dim, LeftGrid<Dim>>(),   //
      kind<Dim, Reactions<Dim>>(),  //
      kind<Dim, Loads<Dim>>(),      //
      kind<Dim, Openings<Dim>>(),   //
      kind<Dim, Probes<Dim>>(),
  };
}

}  // namespace

template <int Dim>
std::vector<std::unique_ptr<Observer<Dim>>> make_observers() {
  std::vector<std::unique_ptr<Observer<Dim>>> all;
  for (const Kind<Dim>& each : kinds<Dim>()) all.push_back(each.make());
  return all;
}

std::vector<ColumnDescription> describe_observers() {
  std::vector<ColumnDescription> all;
  for (const auto& each : kinds<2>()) {
    for (ColumnDescription& column : each.describe()) all.push_back(std::move(column));
  }
  return all;
}

template std::vector<std::unique_ptr<Observer<2>>> make_observers<2>();
template std::vector<std::unique_ptr<Observer<3>>> make_observers<3>();

}  // namespace crampon
