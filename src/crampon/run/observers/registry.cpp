#include "crampon/run/observers/registry.hpp"

#include "crampon/run/observers/clock.hpp"
#include "crampon/run/observers/energies.hpp"
#include "crampon/run/observers/fracture.hpp"
#include "crampon/run/observers/left_grid.hpp"
#include "crampon/run/observers/loads.hpp"
#include "crampon/run/observers/momentum.hpp"
#include "crampon/run/observers/openings.hpp"
#include "crampon/run/observers/probes.hpp"
#include "crampon/run/observers/reactions.hpp"

namespace crampon {

// A further observer is one file like momentum.hpp and one line here.
template <int Dim>
std::vector<ObserverKind<Dim>>& observer_kinds() {
  static std::vector<ObserverKind<Dim>> list = {
      observer_kind<Dim, Clock<Dim>>(),      //
      observer_kind<Dim, Energies<Dim>>(),   //
      observer_kind<Dim, Momentum<Dim>>(),   //
      observer_kind<Dim, LeftGrid<Dim>>(),   //
      observer_kind<Dim, Reactions<Dim>>(),  //
      observer_kind<Dim, Loads<Dim>>(),      //
      observer_kind<Dim, Openings<Dim>>(),   //
      observer_kind<Dim, FractureParameters<Dim>>(),
      observer_kind<Dim, Probes<Dim>>(),
  };
  return list;
}

template <int Dim>
std::vector<std::unique_ptr<Observer<Dim>>> make_observers() {
  std::vector<std::unique_ptr<Observer<Dim>>> all;
  for (const ObserverKind<Dim>& each : observer_kinds<Dim>()) all.push_back(each.make());
  return all;
}

std::vector<ColumnDescription> describe_observers() {
  std::vector<ColumnDescription> all;
  for (const auto& each : observer_kinds<2>()) {
    for (ColumnDescription& column : each.describe()) all.push_back(std::move(column));
  }
  return all;
}

template std::vector<ObserverKind<2>>& observer_kinds<2>();
template std::vector<ObserverKind<3>>& observer_kinds<3>();
template std::vector<std::unique_ptr<Observer<2>>> make_observers<2>();
template std::vector<std::unique_ptr<Observer<3>>> make_observers<3>();

}  // namespace crampon
