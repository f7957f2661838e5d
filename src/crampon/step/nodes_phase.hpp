#pragma once
/// The work on nodes between the passes over particles: assembly, contact, boundary conditions, momenta. Own nodes of one block each.

#include "crampon/step/model.hpp"
#include "crampon/step/state.hpp"

namespace crampon {

/// Task 1: sums the momenta and masses of tiles.
template <int Dim, class Shape>
void assemble_momentum(State<Dim>& state, std::size_t block);

/// Task 1: marks the own nodes of a block that hold several fields or are near a rigid face (BlockLayers::shared), and assembles momenta where
/// there may be some.
template <int Dim, class Shape>
void find_shared_nodes(State<Dim>& state, const Model<Dim>& model, std::size_t block);

// Contact with the faces of rigid bodies (step/meet_faces.hpp), together with the pairs of nodes there, needs the nodes of several blocks. So each task
// of contact has what precedes it, and what follows, as functions of their own.

/// Tasks 1 and 2: assembles momenta, finds contacts.
template <int Dim, class Shape>
void gather_start_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t block);
/// Adjusts contact, imposes velocities; leaves nodal velocities.
template <int Dim>
void settle_start_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt);

/// Tasks 3 and 4: assembles forces, adds body force and damping, imposes boundary forces, updates momenta (N03 Eqs. 28, 29),
/// body_force: m/s2 at the start of the step; damping: 1/s.
template <int Dim, class Shape>
void update_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, const Vec<Dim>& body_force, double damping);
/// Adjusts contact in momentum and force; leaves {v', a} and the velocities v'.
template <int Dim>
void settle_updated_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, const Vec<Dim>& body_force,
                            double damping);

/// Adds the work of the body force over dt on the velocities at hand. Where particles do more than add accelerations, half of that of Task 4
/// is taken back (dt < 0), and half of that of Task 6 comes in its place.
template <int Dim>
void account_body_force(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt, const Vec<Dim>& body_force);

/// Task 6: assembles the re-extrapolated momenta (N03 Eq. 31).
template <int Dim, class Shape>
void gather_end_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt);
/// Adjusts contact, imposes velocities; leaves nodal velocities, with which particles also move unless N03 Eq. 30 is chosen.
template <int Dim>
void settle_end_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t block, double dt);

}  // namespace crampon
