#include "crampon/step/advance.hpp"

#include <cmath>
#include <limits>

#include "crampon/core/parallel.hpp"
#include "crampon/step/assemble_momentum.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

namespace {

/// When lines run.
template <int Dim>
struct Whether {
  using S = const State<Dim>&;
  using W = const StepWork<Dim>&;
  using M = const Model<Dim>&;
  static bool order_is_old(S s, W, M) { return s.order.must_reorder; }
  static bool it_is_the_first_step(S s, W, M) { return s.clock.step == 0; }
  static bool positions_lead_further(S, W w, M) { return w.now.further != 0; }
  static bool rigid_bodies_move(S, W, M m) { return !m.rigid_bodies.empty(); }
  static bool rigid_bodies_prescribe(S, W, M m) { return m.any_prescribing_body(); }
  static bool rigid_faces_meet(S, W, M m) { return m.any_rigid_face(); }
  static bool rigid_faces_meet_anew(S, W w, M m) { return w.now.transfer.re_extrapolates && m.any_rigid_face(); }
  static bool bodies_meet(S, W, M m) { return m.contact.any_contact(); }
  static bool faces_are_loaded(S, W, M m) { return !m.faces.empty(); }
  static bool cracks_bear_tractions(S, W, M m) { return m.any_tractions() || m.any_growth(); }
  static bool there_are_cracks(S s, W, M) { return !s.cracks.empty(); }
  static bool growth_is_due(S, W w, M) { return w.now.growth_due; }
  static bool nucleation_is_due(S, W w, M) { return w.now.nucleation_due; }
  static bool fracture_is_due(S, W w, M) { return w.now.fracture_due; }
  static bool pieces_turn(S s, W, M) { return s.pieces.any(); }

  static bool stress_goes_first(S, W, M m) { return updates_stress_first(m); }
  static bool only_forces(S, W, M m) { return !updates_stress_first(m); }

  static bool there_is_a_series(S, W w, M) { return w.now.transfer.terms > 0; }
  static bool nodes_give_velocities(S, W w, M) { return w.now.rule.nodal != 0; }
  static bool flip_anew(S, W w, M) { return w.now.transfer.re_extrapolates && w.now.rule.is_flip(); }
  static bool taken_anew(S, W w, M) { return w.now.transfer.re_extrapolates && !w.now.rule.is_flip(); }
  static bool taken_once(S, W w, M) { return !w.now.transfer.re_extrapolates && !w.now.rule.is_flip(); }
  static bool momenta_go_anew(S, W w, M) { return w.now.transfer.re_extrapolates; }
  static bool body_works_anew(S, W w, M m) { return w.now.transfer.re_extrapolates && !w.now.rule.is_flip() && m.any_body_force(); }

  static bool moves_only(S s, W w, M m) { return !accelerates(s, w, m) && !updates_stress_last(m); }
  static bool accelerates_and_moves(S s, W w, M m) { return accelerates(s, w, m) && !updates_stress_last(m); }
  static bool strains_and_moves(S s, W w, M m) { return !accelerates(s, w, m) && updates_stress_last(m); }
  static bool strains_accelerates_and_moves(S s, W w, M m) { return accelerates(s, w, m) && updates_stress_last(m); }

 private:
  /// Are velocities updated as particles move (N03 Eq. 30), instead of before Task 6?
  static bool accelerates(S, W w, M) { return !w.now.transfer.re_extrapolates && w.now.rule.is_flip(); }
};

template <int Dim, auto... verbs>
Stage<Dim> once(const char* name, typename Stage<Dim>::When when, const Reach& reach) {
  return {name, reach, when, run_once<Dim, verbs...>, nullptr, {}};
}
template <int Dim, auto... verbs>
Stage<Dim> blocks(const char* name, typename Stage<Dim>::When when, const Reach& reach) {
  return {name, reach, when, nullptr, run_on_block<Dim, verbs...>, {}};
}
/// The lines that a transfer repeats for every term of its series beyond the first.
template <int Dim>
Stage<Dim> series(const char* name, typename Stage<Dim>::When when, std::vector<Stage<Dim>> lines) {
  return {name, {}, when, nullptr, nullptr, std::move(lines)};
}

/// When the next tip may grow, s.
template <int Dim>
double next_growth_check(const State<Dim>& state, const Model<Dim>& model) {
  double next = std::numeric_limits<double>::infinity();
  for (const CrackTip& tip : state.fracture.tips) {
    if (may_grow(tip, model.growth[tip.crack])) next = std::fmin(next, tip.next_check);
  }
  return next;
}

/// When stress is looked at for the next crack, s.
template <int Dim>
double next_nucleation_check(const State<Dim>& state, const Model<Dim>& model) {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < model.nucleations.size(); ++n) {
    if (state.fracture.nucleations[n].made < model.nucleations[n].most) next = std::fmin(next, state.fracture.nucleations[n].next);
  }
  return next;
}

template <int Dim>
void begin_step(const State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, double dt, Watched watched) {
  StepValues& now = work.now;
  now.dt = dt;
  now.watched = watched == Watched::yes;
  const double end = state.clock.time + dt * (1 + 1e-9);
  now.growth_due = end >= next_growth_check(state, model);
  now.nucleation_due = end >= next_nucleation_check(state, model);
  now.fracture_due = model.fracture.on && !state.fracture.tips.empty() && (now.watched || now.growth_due || end >= state.fracture.next);
  now.lead = position_lead(model, dt);
  now.further = now.lead - state.particles.lead;
  // N03 Eq. 35: half at a time for USAVG. The others strain in time with positions: USF to where they are, USL and MUSL along with them.
  const StressUpdate scheme = model.stress_update;
  now.stress_dt = scheme == StressUpdate::usavg ? 0.5 * dt : scheme == StressUpdate::usf ? dt - now.further : dt + now.further;
  now.transfer = model.transfer_in(state.clock.step);
  now.term = 1;
}

template <int Dim>
bool boundary_comes_first(const Model<Dim>& model) {
  return model.boundary_order == BoundaryOrder::boundary_first;  // N03 Tasks 2, 3
}
template <int Dim>
bool contact_comes_first(const Model<Dim>& model) {
  return model.boundary_order == BoundaryOrder::contact_first;  // N13 sec. 2.3
}

}  // namespace

/// The time step of N13, Tasks 0 to 8. Read it as the page of a paper: a line has a name, when it runs, what it reads (of its own block; of others),
/// what it writes, and its verbs, each a function in the file of its name in step/verbs. Several verbs on a line run one after another on a block
/// while it is in the cache.
template <int Dim, class Shape>
std::vector<Stage<Dim>> stages() {
  using enum Data;
  using enum ContactTask;
  using If = Whether<Dim>;
  constexpr auto always = nullptr;
  constexpr auto boundary_first = boundary_comes_first<Dim>;
  constexpr auto contact_first = contact_comes_first<Dim>;
  // Domains stretch with the velocities of Task 6 as particles move, whenever stress does.
  constexpr Data by_domains = Shape::has_domains ? velocities : none, of_domains = Shape::has_domains ? stress : none;
  return {
      once<Dim, reorder<Dim, Shape>>("re-order particles", If::order_is_old, {motion, none, order | motion | stress | slip}),
      once<Dim, move_rigid_bodies<Dim>>("move rigid bodies", If::rigid_bodies_move, {rigid, none, rigid}),
      once<Dim, choose_carriers<Dim, Shape>, start_rotations<Dim>>("begin", If::it_is_the_first_step,
                                                                   {order | motion | cracks, none, cracks | rotations}),
      once<Dim, lead_positions<Dim, Shape>>("lead positions", If::positions_lead_further,
                                            {order | motion | rigid, none, order | motion | cracks}),
      once<Dim, watch_motion<Dim>>("lead positions", always, {order, none, motion}),
      once<Dim, watch_tips<Dim>>("fracture", If::fracture_is_due, {order | motion | stress | cracks, none, tips}),

      once<Dim, evaluate_conditions<Dim>>("prescribe", always, {order | prescribed, none, prescribed}),
      blocks<Dim, prescribe_by_rigid<Dim>>("prescribe", If::rigid_bodies_prescribe, {rigid | prescribed, none, prescribed}),
      once<Dim, evaluate_loads<Dim>, check_prescribed<Dim>>("prescribe", always, {prescribed, none, prescribed}),

      // Task 0
      once<Dim, assign_velocity_fields<Dim, Shape>>("velocity fields", always, {order | motion | cracks | prescribed, none, fields}),
      once<Dim, record_initial_volume<Dim, Shape>>("velocity fields", If::it_is_the_first_step, {motion | fields, none, contacts}),

      // Task 1
      blocks<Dim, project_momentum<Dim, Shape>>("project momentum", always, {motion | fields, none, tiles | rotations}),
      once<Dim, find_rotations<Dim>>("project momentum", If::pieces_turn, {rotations, none, rotations}),
      blocks<Dim, find_shared_nodes<Dim, Shape>>("find contact", If::bodies_meet, {fields | rigid, tiles, shared | momenta}),
      blocks<Dim, project_contact_sums<Dim, Shape>>("find contact", If::bodies_meet, {motion | stress | slip | fields, shared, tiles}),

      // Task 2
      blocks<Dim, assemble_start_momenta<Dim, Shape>, assemble_contact_sums<Dim, Shape>, find_contacts<Dim, Shape>,
             find_face_nodes<Dim, Shape>, impose_symmetry<Dim>, run_where<Dim, boundary_first, impose_start_momenta<Dim>>,
             in_task<Dim, start_meeting_faces<Dim>, two>>(
          "contact and boundaries", always,
          {fields | shared | rotations | contacts | prescribed | rigid, tiles | motion | stress, momenta | pairs}),
      once<Dim, link_face_columns<Dim>, in_task_once<Dim, meet_faces<Dim>, two>>("contact and boundaries", If::rigid_faces_meet,
                                                                                 {pairs | momenta | rigid | contacts, none, pairs}),
      blocks<Dim, in_task<Dim, adjust_contact<Dim>, two>, in_task<Dim, take_face_impulses<Dim>, two>,
             run_where<Dim, contact_first, impose_start_momenta<Dim>>, find_velocities<Dim>>(
          "contact and boundaries", always, {pairs | momenta | prescribed, none, momenta | velocities | books}),
      blocks<Dim, weigh_face_loads<Dim, Shape>>("face loads", If::faces_are_loaded, {motion | stress | fields, velocities, faces}),
      once<Dim, find_face_tractions<Dim>>("face loads", If::faces_are_loaded, {faces | prescribed, none, faces}),

      // Tasks 2 and 3: stress of each pack is updated and its forces follow (USF, USAVG), or the forces alone (USL, MUSL).
      blocks<Dim, update_stress_and_project_forces<Dim, Shape>>("stress and forces", If::stress_goes_first,
                                                                {motion | fields | prescribed | faces, velocities, stress | tiles}),
      blocks<Dim, project_forces<Dim, Shape>>("stress and forces", If::only_forces,
                                              {motion | stress | fields | prescribed | faces, none, tiles}),
      once<Dim, share_tractions<Dim, Shape>>("crack tractions", If::cracks_bear_tractions,
                                             {cracks | tractions | momenta | fields, none, forces}),

      // Tasks 3 and 4
      blocks<Dim, assemble_forces<Dim, Shape>, add_tractions<Dim>, add_body_forces<Dim>, impose_forces<Dim>, add_forces<Dim>,
             in_task<Dim, start_meeting_faces<Dim>, four>>(
          "update momenta", always, {fields | momenta | forces | prescribed, tiles, momenta | forces | answers | books}),
      once<Dim, in_task_once<Dim, meet_faces<Dim>, four>>("update momenta", If::rigid_faces_meet,
                                                          {pairs | momenta | rigid, none, pairs | answers | books}),
      blocks<Dim, in_task<Dim, adjust_contact<Dim>, four>, in_task<Dim, take_face_impulses<Dim>, four>, account_body_forces<Dim>,
             find_accelerations<Dim>, sum_couples<Dim>>(
          "update momenta", always, {pairs | momenta | forces | velocities | prescribed, none, answers | velocities | rotations | books}),
      blocks<Dim, account_loads<Dim, Shape>, account_mirrored_forces<Dim, Shape>>(
          "account loads", always, {tiles | fields | motion | stress | faces | prescribed, answers, books}),
      blocks<Dim, take_back_body_work<Dim>>("account loads", If::body_works_anew, {momenta | velocities, none, books}),

      // Task 5 of XPIC and FMPM: the velocities of nodes by a series
      blocks<Dim, start_series<Dim>>("filter velocities", If::there_is_a_series, {answers, none, velocities}),
      series<Dim>(
          "filter velocities", If::there_is_a_series,
          {
              blocks<Dim, sum_rotation_of_term<Dim>>("filter velocities", always, {velocities, none, rotations}),
              blocks<Dim, project_term<Dim, Shape>>("filter velocities", always, {motion | fields, velocities, tiles}),
              once<Dim, find_term_spins<Dim>>("filter velocities", always, {rotations, none, rotations}),
              blocks<Dim, gather_term<Dim, Shape>, in_task<Dim, start_meeting_faces<Dim>, term>>(
                  "filter velocities", always, {fields | rotations | velocities, tiles, momenta | pairs}),
              once<Dim, in_task_once<Dim, meet_faces<Dim>, term>>("filter velocities", If::rigid_faces_meet,
                                                                  {pairs | momenta | rigid, none, pairs}),
              blocks<Dim, in_task<Dim, adjust_contact<Dim>, term>, in_task<Dim, take_face_impulses<Dim>, term>, clear_fixed_momenta<Dim>,
                     add_term<Dim>>("filter velocities", always, {pairs | momenta | prescribed, none, velocities | answers}),
          }),

      // Tasks 5 and 6
      blocks<Dim, sum_rotation_of_motion<Dim>>("update velocities", If::nodes_give_velocities, {answers | momenta, none, rotations}),
      once<Dim, answer_couples<Dim>>("update velocities", always, {rotations, none, rotations}),
      blocks<Dim, update_velocities_and_project<Dim, Shape>>("update velocities", If::flip_anew,
                                                             {motion | fields | rotations, answers, motion | tiles}),
      blocks<Dim, take_velocities_and_project<Dim, Shape>>("update velocities", If::taken_anew,
                                                           {motion | fields | rotations, answers, motion | tiles | books}),
      blocks<Dim, take_velocities<Dim, Shape>>("update velocities", If::taken_once, {motion | fields | rotations, answers, motion | books}),
      blocks<Dim, assemble_end_momenta<Dim, Shape>, impose_symmetry<Dim>, run_where<Dim, boundary_first, impose_end_momenta<Dim>>,
             in_task<Dim, start_meeting_faces<Dim>, six>>("contact and boundaries again", If::momenta_go_anew,
                                                          {fields | rotations | prescribed, tiles, momenta | pairs}),
      once<Dim, in_task_once<Dim, meet_faces<Dim>, six>>("contact and boundaries again", If::rigid_faces_meet_anew,
                                                         {pairs | momenta | rigid, none, pairs | books}),
      blocks<Dim, in_task<Dim, adjust_contact<Dim>, six>, in_task<Dim, take_face_impulses<Dim>, six>,
             run_where<Dim, contact_first, impose_end_momenta<Dim>>, find_velocities<Dim>, move_with_velocities<Dim>>(
          "contact and boundaries again", If::momenta_go_anew,
          {pairs | momenta | prescribed, none, momenta | velocities | answers | books}),
      blocks<Dim, account_loads_anew<Dim, Shape>>("account loads", If::momenta_go_anew, {tiles, velocities, books}),
      blocks<Dim, add_body_work<Dim>>("account loads", If::body_works_anew, {momenta | velocities, none, books}),
      once<Dim, remember_contacts<Dim>, remember_rigid_conditions<Dim>>("remember contacts", always,
                                                                        {pairs | prescribed, none, contacts | prescribed}),

      // Tasks 5 and 6: stress of each pack is updated and its particles move (USL, MUSL, USAVG), or they move alone (USF).
      blocks<Dim, move_particles<Dim, Shape>>("stress and positions", If::moves_only,
                                              {motion | fields, answers | by_domains, motion | of_domains | slip | order | books}),
      blocks<Dim, accelerate_and_move_particles<Dim, Shape>>(
          "stress and positions", If::accelerates_and_moves,
          {motion | fields | rotations, answers | by_domains, motion | of_domains | slip | order | books}),
      blocks<Dim, update_stress_and_move_particles<Dim, Shape>>(
          "stress and positions", If::strains_and_moves, {motion | fields, answers | velocities, motion | stress | slip | order | books}),
      blocks<Dim, update_stress_accelerate_and_move_particles<Dim, Shape>>(
          "stress and positions", If::strains_accelerates_and_moves,
          {motion | fields | rotations, answers | velocities, motion | stress | slip | order | books}),

      // Task 8
      once<Dim, move_cracks<Dim>, update_tractions<Dim>, fade_tractions<Dim>>("move cracks", If::there_are_cracks,
                                                                              {motion | momenta | fields, none, cracks | tractions}),
      once<Dim, end_rigid_motion<Dim>, close_step<Dim>, close_ledger<Dim>, check_health<Dim, Shape>>(
          "close the step", always, {books | motion, none, order | motion | cracks | prescribed | rigid}),

      // Task 7
      once<Dim, find_fracture_parameters<Dim>>("fracture", If::fracture_is_due,
                                               {tips | motion | stress | cracks | tractions | prescribed, none, tips}),
      once<Dim, grow_cracks<Dim, Shape>>("fracture", If::growth_is_due,
                                         {tips | momenta | motion | cracks, none, cracks | tractions | tips}),
      once<Dim, nucleate_cracks<Dim, Shape>>("fracture", If::nucleation_is_due,
                                             {motion | stress | momenta | cracks, none, cracks | tractions | tips}),
  };
}

template <int Dim, class Shape>
void advance(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, double dt, Watched watched) {
  static const std::vector<Stage<Dim>> table = stages<Dim, Shape>();
  begin_step(state, work, model, dt, watched);
  run_stages(table, state, work, model);
}

template <int Dim, class Shape>
StiffestVertex find_stiffest_vertex(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  if (!model.any_tractions()) return {};
  if (state.order.must_reorder) reorder<Dim, Shape>(state, work, model);
  work.now = {};
  work.now.dt = 1;  // no face moves yet: any time step
  assign_velocity_fields<Dim, Shape>(state, work, model);
  choose_carriers<Dim, Shape>(state, work, model);
  parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) { project_momentum<Dim, Shape>(state, work, model, b); });
  parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) { assemble_momentum<Dim, Shape>(work, b); });
  return spread_tractions<Dim, Shape>(state, work, model);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                               \
  template std::vector<Stage<DIM>> stages<DIM, SHAPE>();                                              \
  template void advance<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, double, Watched); \
  template StiffestVertex find_stiffest_vertex<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
