#pragma once
#include "crampon/step/packs.hpp"

namespace crampon {

/// Forces of loads on particles and faces, for one block: kept for account_loads, and added to its tiles (N03 Eq. 28, f_ext).
template <int Dim, class Shape>
void project_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, NodalVector<Dim>* tiles);

/// Work of loads over the step to the block's ledger, f_i . (v_i + v'_i)/2 dt; where velocities are extrapolated anew, f_i . v_i/2 dt, and account_loads_anew adds the other half.
template <int Dim, class Shape>
void account_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After Task 6: half of the work with the velocities that were extrapolated anew. The sum is what particles gain (docs/theory/loads.md).
template <int Dim, class Shape>
void account_loads_anew(StepWork<Dim>& work, std::size_t block);

}  // namespace crampon
