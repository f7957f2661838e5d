#pragma once
/// Stress on faces of bodies as nodal forces that the internal forces of a uniform stress balance exactly (docs/theory/loads.md).

#include <functional>

#include "crampon/step/packs.hpp"

namespace crampon {

/// The faces at the start of the run.
template <int Dim>
void start_face_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Sees a force on the pair of a particle, by its slot, and node n of its stencil at lane l, as if no symmetry plane folded the pair, N.
template <int Dim, class Shape>
using FaceForceVisitor = std::function<void(std::uint32_t slot, const Stencil<Dim, Shape>& stencil, int l, const PairTarget* targets, int n,
                                            const NodalVector<Dim>& force)>;
template <int Dim, class Shape>
void for_face_forces(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block,
                     const FaceForceVisitor<Dim, Shape>& visit);

/// Adds the forces of the links of a block's particles to a tile, all layers, N.
template <int Dim, class Shape>
void project_face_loads(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block,
                        NodalVector<Dim>* tiles);

/// Force of every load on all that it acts on, N, with values at time t (s).
template <int Dim>
std::vector<Vec<Dim>> total_loads(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, double t);

}  // namespace crampon
