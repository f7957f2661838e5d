#pragma once
/// The list of observers (observer.hpp).

#include <memory>

#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// A new one of each, in the order of their columns.
template <int Dim>
std::vector<std::unique_ptr<Observer<Dim>>> make_observers();

/// What all of them may write, in the same order.
std::vector<ColumnDescription> describe_observers();

}  // namespace crampon
