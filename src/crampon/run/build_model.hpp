#pragma once
#include "crampon/input/problem.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

template <int Dim>
struct BuiltModel {
  Model<Dim> model;
  State<Dim> state;
  std::vector<std::vector<bool>> cracked;  ///< per crack and vertex: there is material on both sides at the start
};

/// Grid, laws, particles, cracks, conditions and loads of a problem. threads <= 0: all cores.
/// Throws InputError with all that only building can find: empty bodies, bodies, particles and cracks outside the grid, regions without
/// nodes or particles.
template <int Dim>
BuiltModel<Dim> build_model(const Problem& problem, int threads);

}  // namespace crampon
