#pragma once
/// Notes: what an input says legally but probably not on purpose, found before the first step and told by `validate` and at the start
/// of a run. A kind of note is one function in one file; find_notes.cpp lists them.

#include <string>
#include <vector>

#include "crampon/run/notes/body_space.hpp"

namespace crampon {

/// What a note may look at: the problem as stated and as built, before the first step.
template <int Dim>
struct Start {
  const Problem& problem;
  const Model<Dim>& model;
  const State<Dim>& state;
  double time_step = 0, end_time = 0;    ///< s; the end is estimated when the input gives a number of steps
  std::vector<BodySpace<Dim>> bodies{};  ///< bodies, then rigid bodies of particles: as Particles::body counts
};

/// A note has the form of an error: place, what, why, what to do.
using Notes = std::vector<Diagnostic>;

/// All notes, in the order of the list in find_notes.cpp.
template <int Dim>
Notes find_notes(Start<Dim> start);

/// The law between bodies is stated, but all bodies share one velocity field.
template <int Dim>
void note_contact_without_fields(const Start<Dim>& start, Notes& notes);
/// Two bodies take the same place.
template <int Dim>
void note_overlapping_bodies(const Start<Dim>& start, Notes& notes);
/// Particles that begin deep inside a wall.
template <int Dim>
void note_particles_in_walls(const Start<Dim>& start, Notes& notes);
/// Particles from a file that are larger than a cell.
template <int Dim>
void note_large_particles(const Start<Dim>& start, Notes& notes);
/// Bodies whose particles have another measure than their shape.
template <int Dim>
void note_stairs_of_particles(const Start<Dim>& start, Notes& notes);
/// Rigid bodies that meet others through nodes on both of their sides at once.
template <int Dim>
void note_thin_rigid_bodies(const Start<Dim>& start, Notes& notes);
/// Cracks that have no material on both sides, or pass between particles and nodes.
template <int Dim>
void note_idle_cracks(const Start<Dim>& start, Notes& notes);
/// Fracture parameters or growth asked for where there is no tip.
template <int Dim>
void note_idle_growth(const Start<Dim>& start, Notes& notes);
/// Cracks that lie on each other, or meet themselves.
template <int Dim>
void note_tangled_cracks(const Start<Dim>& start, Notes& notes);
/// Prescribed velocities and symmetry planes whose nodes no body reaches.
template <int Dim>
void note_idle_conditions(const Start<Dim>& start, Notes& notes);
/// Probes that are in no body.
template <int Dim>
void note_far_probes(const Start<Dim>& start, Notes& notes);
/// Choices of the algorithm that are known to fail.
template <int Dim>
void note_unstable_method(const Start<Dim>& start, Notes& notes);
/// Bodies set spinning where the transfer takes rotation away.
template <int Dim>
void note_braked_rotation(const Start<Dim>& start, Notes& notes);
/// Output and expected numbers after the end of the run.
template <int Dim>
void note_late_output(const Start<Dim>& start, Notes& notes);

/// "(0.1, 0.2) m".
template <int Dim>
std::string place_text(const Vec<Dim>& x);
/// 0.3 and "m", "m2" or "m3" as "0.3 m2": an area in the plane, a volume in space.
template <int Dim>
std::string measure_text(double measure);

}  // namespace crampon
