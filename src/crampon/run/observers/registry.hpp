#pragma once
/// The list of observers (observer.hpp).

#include <memory>

#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// How an observer is made, and what it says of its columns.
template <int Dim>
struct ObserverKind {
  std::unique_ptr<Observer<Dim>> (*make)();
  std::vector<ColumnDescription> (*describe)();
};
template <int Dim, class Observing>
ObserverKind<Dim> observer_kind() {
  return {[]() -> std::unique_ptr<Observer<Dim>> { return std::make_unique<Observing>(); },
          [] {
            if constexpr (requires { Observing::table(); })
              return descriptions_in(Observing::table());
            else
              return Observing::describe();
          }};
}

/// The list, in the order of columns.
template <int Dim>
std::vector<ObserverKind<Dim>>& observer_kinds();

/// Adds an observer from outside the list, before the first problem is built.
template <template <int> class Observing>
void add_observer() {
  observer_kinds<2>().push_back(observer_kind<2, Observing<2>>());
  observer_kinds<3>().push_back(observer_kind<3, Observing<3>>());
}

/// A new one of each, in the order of their columns.
template <int Dim>
std::vector<std::unique_ptr<Observer<Dim>>> make_observers();

/// What all of them may write, in the same order.
std::vector<ColumnDescription> describe_observers();

}  // namespace crampon
