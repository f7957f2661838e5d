#pragma once
#include "crampon/step/packs.hpp"

namespace crampon {

/// Forces of loads on particles and faces, for one block: kept for account_loads, and added to its tiles (N03 Eq. 28, f_ext).
/// load_values: per load and component, N or Pa.
template <int Dim, class Shape>
void project_loads(State<Dim>& state, const Model<Dim>& model, std::size_t block, const std::vector<Vec<Dim>>& load_values,
                   NodalVector<Dim>* tiles);

/// Work of loads over the step to the block's ledger, f_i . (v_i + v'_i)/2 dt; where velocities are extrapolated anew, f_i . v_i/2 dt, and account_loads_anew adds the other half.
template <int Dim, class Shape>
void account_loads(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt);

/// After Task 6: half of the work with the velocities that were extrapolated anew. The sum is what particles gain (docs/theory/loads.md).
template <int Dim, class Shape>
void account_loads_anew(State<Dim>& state, std::size_t block, double dt);

}  // namespace crampon
