#pragma once
/// The verbs of the time step in the order of the table in step/advance.cpp. Each is defined in the file of its name in step/verbs.
///
/// A verb with a block works for the particles or the own nodes of that block, in parallel with other blocks. The others run once for all blocks.

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

// Before Task 0: order, positions, and what is prescribed.

/// Orders particles by block, material, base node and id, and finds the blocks they need; every run is padded to whole packs.
/// Done when some particle has left its block's margin (docs/theory/space.md, order of particles). Particles marked by id == padding_id are
/// dropped. Throws RunError when a particle is out of the grid.
template <int Dim, class Shape>
void reorder(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Poses and velocities of rigid bodies at the start and the end of the step (start_rigid_motion in step/rigid_motion.hpp). Serial, since
/// expressions are evaluated.
template <int Dim>
void move_rigid_bodies(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Chooses the carriers of all surface points, once, where particles and cracks are at the start. Fills StepWork::crack_view.
template <int Dim, class Shape>
void choose_carriers(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// At the start of a run: the pieces of material, and about which axes they may turn. Rigid bodies belong to no piece. A piece at a symmetry plane
/// turns about the normal of that plane alone. Whatever is a piece at the start counts as one for good.
template <int Dim>
void start_rotations(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Before the first step of a run, and before each that is longer or shorter than the one before: takes particles, crack points and rigid bodies
/// (after move_rigid_bodies) to where they are in the middle of the step (docs/theory/step.md, time of positions). Orders particles anew where
/// that takes them too far.
template <int Dim, class Shape>
void lead_positions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Makes ready to keep what particles move with (Particles::moved_with), where someone will look and positions lead.
template <int Dim>
void watch_motion(State<Dim>& state, StepWork<Dim>& work);

/// Keeps velocities and displacement gradients of the particles about tips of cracks, where fracture parameters are due.
template <int Dim>
void watch_tips(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Values of all fixed components at the start and the end of the step. Serial, since expressions are evaluated.
template <int Dim>
void evaluate_conditions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// The nodes of a block that are in the shapes of prescribing rigid bodies at the start of the step, and the velocities of the bodies there.
template <int Dim>
void prescribe_by_rigid(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Loads, body force and damping at the time of the positions with which the step works, and how particles take up velocities under that
/// damping (StepValues::rule). Serial, since expressions are evaluated.
template <int Dim>
void evaluate_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Looks at what the input prescribes for this step: motion of rigid bodies, velocities on nodes, loads, body force, damping. Throws RunError
/// that names the first that is not a number, and for damping below zero.
template <int Dim>
void check_prescribed(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model);

// Task 0: velocity fields.

/// Task 0: finds the velocity field of every pair of a particle and a node near a crack, a symmetry plane or a held face. The field follows
/// from the set of cracks that the line between the two crosses (N03 Eq. 2, N13 sec. 1.1; docs/theory/space.md, layers). Also collects
/// the normals of crossed facets per node and crack, and lays out tiles and nodes of the layers found.
/// Throws RunError when a line crosses more than Signature::capacity cracks or a block needs more than 255 layers.
template <int Dim, class Shape>
void assign_velocity_fields(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// In the first step, and when contact by volume is measured against the body as it was: nodal volumes of the uncut body at the
/// start, sum V_p S (conventions 10).
template <int Dim, class Shape>
void record_initial_volume(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

// Task 1: particles to tiles, and which nodes several fields share.

/// Tile sums of m v S and m S per layer (N03 Eq. 26), for one block.
template <int Dim, class Shape>
void project_momentum(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Centre, inertia and spin of every piece, from what project_momentum() has summed up.
template <int Dim>
void find_rotations(State<Dim>& state, StepWork<Dim>& work);

/// Marks the own nodes of a block that hold several fields or are near a rigid face (BlockLayers::shared), and assembles momenta where
/// there may be some.
template <int Dim, class Shape>
void find_shared_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Only where fields or walls meet: tile sums of volume and its gradient, position and original position (N03 Eq. 27; N13 sec. 3).
template <int Dim, class Shape>
void project_contact_sums(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

// Task 2 on the own nodes of a block: momenta, contact, and what is prescribed.

/// Momenta at the start of the step (N03 Eq. 26), with the rotation that they carry.
template <int Dim, class Shape>
void assemble_start_momenta(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Adds up the sums of project_contact_sums at the own nodes of a block that hold several fields, and those of the normals of cracks.
template <int Dim, class Shape>
void assemble_contact_sums(StepWork<Dim>& work, std::size_t block);

/// Finds the nodes with several fields, their groups and pairs, and the normals, gaps and areas of these, which hold for the whole step (N03
/// section 2.2; N13 sections 1.1, 1.2 and 3, step 1). Who meets whom says contact/find_pairs.hpp.
template <int Dim, class Shape>
void find_contacts(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Which nodes of deformable bodies meet the faces of rigid ones (docs/theory/contact.md, rigid faces). After find_contacts: what moves as one
/// at the own nodes of a block, its parts of faces, and the particles before these.
template <int Dim, class Shape>
void find_face_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Takes the normal momentum from nodes on symmetry planes, where mirror images meet. Own nodes of one block. Also in Task 6.
template <int Dim>
void impose_symmetry(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Keeps p_int and gives fixed components the prescribed momentum at the start of the step. Own nodes of one block.
template <int Dim>
void impose_start_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

// Contact of bodies with the faces of rigid ones (docs/theory/contact.md, rigid faces), together with the pairs of the nodes there, in each
// ContactTask.

/// Before contact of a task at the nodes of a block: velocities of what meets faces; in Task 4, room for what contact is to remember.
template <int Dim>
void start_meeting_faces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, ContactTask task);

/// In what columns nodes meet the faces of rigid bodies, with what normal and gap. Gathers the parts that find_face_nodes has found in all
/// blocks in columns, and columns that share nodes in sets. Serial.
template <int Dim>
void link_face_columns(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Finds the impulses of all columns, and of the pairs of their nodes.
template <int Dim>
void meet_faces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, ContactTask task);

/// Contact between the velocity fields at the own nodes of a block (N03 section 2.2, N13 section 3; docs/theory/contact.md, the scheme). Tasks 2
/// and 6 change momenta alone; Task 4 changes momenta and forces together and leaves fixed components alone. Nodes that meet_faces() has solved
/// together with rigid faces take what it found.
template <int Dim>
void adjust_contact(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, ContactTask task);

/// Gives the impulses to the nodes of a block: momentum, in Task 4 momentum and force; books energy and reactions.
template <int Dim>
void take_face_impulses(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block, ContactTask task);

// Task 2, when momenta are known: velocities, and faces under load.

/// v = p/m, zero where there is no mass: what the next stress update reads. Also in Task 6.
template <int Dim>
void find_velocities(StepWork<Dim>& work, std::size_t block);

/// What the links of a block's particles sum to over all nodes, how the particles are deformed, and the faces of the outermost ones.
/// Where stress goes first, laws are behind positions here, and are about to follow with the velocities of nodes.
template <int Dim, class Shape>
void weigh_face_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// The traction of each column, and what its links lack. Serial.
template <int Dim>
void find_face_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

// Tasks 2 and 3: stress, and the forces of particles.

/// project_forces() after the stress update of Task 2 (USF, USAVG) with the nodal velocities at hand, pack by pack (N03 Eqs. 34-36).
template <int Dim, class Shape>
void update_stress_and_project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 3, for one block: tile sums of internal forces (N03 Eq. 28), of loads and of what keeps rigid bodies on their way. Of body force and
/// damping only what is special to folded pairs; nodes add the rest.
template <int Dim, class Shape>
void project_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Shares the forces on the surface points of cracks among the nodes that move them (spread_tractions in step/crack_tractions.hpp). Serial.
template <int Dim, class Shape>
void share_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

// Tasks 3 and 4 on the own nodes of a block: forces, new momenta, accelerations (N03 Eqs. 28, 29).

/// Sums the forces of tiles.
template <int Dim, class Shape>
void assemble_forces(StepWork<Dim>& work, std::size_t block);

/// Adds the forces of tractions on cracks.
template <int Dim>
void add_tractions(StepWork<Dim>& work, std::size_t block);

/// f += m g - damping p, in deformable fields.
template <int Dim>
void add_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 3: the force on fixed components; books reactions. Restores p_int where the rule asks for it (conventions 27).
template <int Dim>
void impose_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// p += f dt.
template <int Dim>
void add_forces(StepWork<Dim>& work, std::size_t block);

/// Work of the body force, and what damping takes, by the mean of the velocities before and after Task 4.
template <int Dim>
void account_body_forces(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// {v', a} = {p, f}/m: what particles read in Task 5; and v' as velocities, where these are read.
template <int Dim>
void find_accelerations(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Couples of the accelerations of a block's nodes (step/rotation.hpp).
template <int Dim>
void sum_couples(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Work of loads over the step to the block's ledger, f_i . (v_i + v'_i)/2 dt. Where velocities are extrapolated anew it is
/// f_i . v_i/2 dt, and account_loads_anew() adds the other half.
template <int Dim, class Shape>
void account_loads(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After Task 4. The reaction of a plane or a face is the rate at which it changes the momentum of the particles (docs/theory/step.md,
/// symmetry planes). impose_forces() has booked the part of the nodes on it; this function books the part of the folded pairs. Nodes
/// computed the work of body force and damping as if none of their mass were that of an image; this function corrects it.
template <int Dim, class Shape>
void account_mirrored_forces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Where particles do more than add accelerations, takes back half of the work of the body force in Task 4. add_body_work() puts half of that on
/// the velocities of Task 6 in its place.
template <int Dim>
void take_back_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

// Task 5 of XPIC and FMPM: the velocities of nodes by a series (step/velocity_series.hpp).

/// First term, own nodes of a block: w = v at the start (XPIC) or at the end (FMPM) of the step, as Tasks 2 and 4 left it.
template <int Dim>
void start_series(StepWork<Dim>& work, std::size_t block);

/// The angular momentum that particles get by taking a term of the series from a block's nodes.
template <int Dim>
void sum_rotation_of_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Tile sums {m u, m} of a block's particles, u = sum S w, for term 2, 3, ...
template <int Dim, class Shape>
void project_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// The spin of particles that take a term of the series from nodes.
template <int Dim>
void find_term_spins(State<Dim>& state, StepWork<Dim>& work);

/// Own nodes of a block: the next term w - A w. Faces that Task 4 found in contact part or slide by it no more than the state of their contact
/// lets them.
template <int Dim, class Shape>
void gather_term(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Takes all momentum from prescribed components: they have no part in further terms. Own nodes of one block.
template <int Dim>
void clear_fixed_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Adds the term to the velocity that particles read. Prescribed components have none.
template <int Dim>
void add_term(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

// Tasks 5 and 6: velocities of particles, and the momenta that are extrapolated from them anew.

/// The angular momentum that particles get by taking v' of Task 4 from a block's nodes.
template <int Dim>
void sum_rotation_of_motion(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// How particles answer couples, and the spin that they have after Task 5 by the rule of the step.
template <int Dim>
void answer_couples(State<Dim>& state, StepWork<Dim>& work);

/// Task 5, velocities: v += dt sum S a (N03 Eq. 30), and Task 6c: tile sums of the new momenta with the S and
/// fields of the start of the step (N03 Eq. 31).
template <int Dim, class Shape>
void update_velocities_and_project(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// take_velocities(), and Task 6 after that: tile sums of the new momenta (N03 Eq. 31).
template <int Dim, class Shape>
void take_velocities_and_project(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 5, velocities, where particles do not just add accelerations (step/transfer.hpp). Books what that takes of their energy.
template <int Dim, class Shape>
void take_velocities(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 6: the re-extrapolated momenta (N03 Eq. 31).
template <int Dim, class Shape>
void assemble_end_momenta(State<Dim>& state, StepWork<Dim>& work, std::size_t block);

/// Task 6: the prescribed momentum at the end of the step.
template <int Dim>
void impose_end_momenta(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Task 6: particles are to move with the nodal velocities at hand, and as far as springs between them give way; not where N03 Eq. 30 is chosen.
template <int Dim>
void move_with_velocities(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After Task 6: half of the work with the velocities that were extrapolated anew. The sum is what particles gain (docs/theory/loads.md).
template <int Dim, class Shape>
void account_loads_anew(StepWork<Dim>& work, std::size_t block);

/// After Task 6: half of the work of the body force on the velocities that were extrapolated anew (take_back_body_work).
template <int Dim>
void add_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// After Task 6: what the next step must know about every contact. Serial.
template <int Dim>
void remember_contacts(State<Dim>& state, StepWork<Dim>& work);

/// Remembers for the next step which components prescribe_by_rigid() has prescribed. Serial.
template <int Dim>
void remember_rigid_conditions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

// Task 5, positions: x += dt sum S v with the velocities of Task 6, or of Task 4 where there are no others (N03 Eq. 30). What positions were led
// on by before the step (lead_positions) is corrected for the velocity that moves them. These verbs also find the box that particles now reach
// and their health, and what particles remember of contact follows.

/// Positions alone.
template <int Dim, class Shape>
void move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Positions after v += dt sum S a (N03 Eq. 30), where velocities are not updated before Task 6.
template <int Dim, class Shape>
void accelerate_and_move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// Positions after the stress update of Task 6 with the nodal velocities at hand (N03 Eqs. 34-36), pack by pack.
template <int Dim, class Shape>
void update_stress_and_move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

/// All three: the stress update, v += dt sum S a, and positions.
template <int Dim, class Shape>
void update_stress_accelerate_and_move_particles(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block);

// Task 8: cracks, and the tractions on them.

/// Task 8, after particles have moved. Surface points go with their carriers (step/crack_carriers.hpp). Vertices of the plane move with the
/// centre-of-mass velocity of all fields (N03 Eq. 32; conventions 39), v = sum S v_cm with linear S; where some of the nodes about have no
/// mass, with the mean of their surface points. The plane stays between its surfaces. Vertices without any of these go with the nearest
/// vertex of their crack that has one.
template <int Dim>
void move_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Task 8, after the cracks have moved: tractions where they are now, what is stored and dissipated, and failures. Serial.
template <int Dim>
void update_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Task 8: work of the tractions that fade behind tips that have grown (step/release_faces.hpp), and what is left of them in the next step. Serial.
template <int Dim>
void fade_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

// After Task 8: the end of the step.

/// The next step starts where this one ended. Serial.
template <int Dim>
void end_rigid_motion(State<Dim>& state);

/// The step is done: its time has passed.
template <int Dim>
void close_step(State<Dim>& state, StepWork<Dim>& work);

/// Adds up the blocks' sums of the step in block order and clears them (docs/theory/contact.md, energy); decides whether particles are
/// re-ordered.
template <int Dim>
void close_ledger(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Looks at what the blocks reported. Throws RunError naming step, time, particle, its position, the nearest crack and the advice that
/// usually helps; removes particles that left the grid when the input says so.
template <int Dim, class Shape>
void check_health(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

// Task 7

/// J and stress intensities at the tips of cracks (docs/theory/fracture.md), from what watch_tips has kept and what has become of it.
template <int Dim>
void find_fracture_parameters(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Tips whose time has come grow where their criterion says so (docs/theory/fracture.md, growth): a crack gets vertices, and those near its tip new
/// carriers. Nothing of particles or nodes is changed; the next step finds the new velocity fields.
template <int Dim, class Shape>
void grow_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

/// Cracks start where the mean of stress passes a strength (docs/theory/fracture.md, nucleation): a crack that had no vertices gets them. Nothing of
/// particles or nodes is changed.
template <int Dim, class Shape>
void nucleate_cracks(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
