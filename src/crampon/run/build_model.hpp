#pragma once
#include "crampon/input/problem.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

template <int Dim>
struct BuiltModel {
  Model<Dim> model;
  State<Dim> state;
  StepWork<Dim> work;
};

/// Grid, laws, particles, cracks, conditions and loads of a problem. threads <= 0: all cores.
/// Throws InputError with all that only building can find: empty bodies, bodies, particles and cracks outside the grid, regions without
/// nodes or particles.
template <int Dim>
BuiltModel<Dim> build_model(const Problem& problem, int threads);

}  // namespace crampon
