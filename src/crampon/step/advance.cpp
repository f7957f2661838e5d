#include "crampon/step/advance.hpp"

#include <chrono>

#include "crampon/core/parallel.hpp"
#include "crampon/step/assign_velocity_fields.hpp"
#include "crampon/step/boundary.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/crack_tractions.hpp"
#include "crampon/step/face_loads.hpp"
#include "crampon/step/filter_velocities.hpp"
#include "crampon/step/find_contacts.hpp"
#include "crampon/step/guard.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/lead_positions.hpp"
#include "crampon/step/ledger.hpp"
#include "crampon/step/link_face_columns.hpp"
#include "crampon/step/meet_faces.hpp"
#include "crampon/step/mirrored_forces.hpp"
#include "crampon/step/move_cracks.hpp"
#include "crampon/step/nodes_phase.hpp"
#include "crampon/step/project.hpp"
#include "crampon/step/project_loads.hpp"
#include "crampon/step/reorder.hpp"
#include "crampon/step/rigid_motion.hpp"
#include "crampon/step/rotation.hpp"
#include "crampon/step/take_velocities.hpp"
#include "crampon/step/update_particles.hpp"

namespace crampon {

namespace {

/// Runs the lines of a step, timed under the names that users see in the run summary.
template <int Dim>
class Phases {
 public:
  Phases(State<Dim>& state, int threads) : state_(state), threads_(threads) {}

  template <class F>
  void serial(const char* name, F f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    book(name, start);
  }
  template <class F>
  void blocks(const char* name, F f) {
    const auto start = std::chrono::steady_clock::now();
    parallel_for(state_.blocks.size(), threads_, f);
    book(name, start);
  }

 private:
  void book(const char* name, std::chrono::steady_clock::time_point start) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (Phase& phase : state_.phases) {
      if (phase.name == name) {
        phase.seconds += seconds;
        return;
      }
    }
    state_.phases.push_back({name, seconds});
  }
  State<Dim>& state_;
  int threads_;
};

/// Makes ready to keep what particles move with, where someone will look and positions lead.
template <int Dim>
void watch_motion(Particles<Dim>& particles, Watched watched, double lead) {
  particles.watched = watched == Watched::yes && lead > 0;
  if (particles.watched) particles.moved_with.resize_discarding(particles.size());
}

}  // namespace

template <int Dim, class Shape>
void advance(State<Dim>& state, const Model<Dim>& model, double dt, Watched watched) {
  const StressUpdate scheme = model.stress_update;
  const bool stress_first = scheme == StressUpdate::usf || scheme == StressUpdate::usavg;
  const bool stress_last = scheme != StressUpdate::usf;
  const double lead = position_lead(model, dt), further = lead - state.particles.lead;
  // N03 Eq. 35: half at a time for USAVG. The others strain in time with positions: USF to where they are, USL and MUSL along with them.
  const double stress_dt = scheme == StressUpdate::usavg ? 0.5 * dt : scheme == StressUpdate::usf ? dt - further : dt + further;
  const StepTransfer transfer = model.transfer_in(state.step);
  std::vector<Vec<Dim>> load_values;
  Vec<Dim> body_force;
  double damping = 0, particle_damping = 0;

  Phases<Dim> phases(state, model.threads);
  using B = std::size_t;
  // Contact of a task: with rigid faces, whose columns of nodes belong to several blocks, there is something to do between what blocks do.
  const bool rigid_faces = model.any_rigid_face();
  const auto contact = [&](const char* name, ContactTask task, auto gather, auto settle) {
    if (!rigid_faces) return phases.blocks(name, [&](B b) { gather(b), settle(b); });
    phases.blocks(name, gather);
    phases.serial(name, [&] {
      if (task == ContactTask::two) link_face_columns(state, model);
      meet_faces(state, model, task, dt);
    });
    phases.blocks(name, settle);
  };
  phases.serial("prepare", [&] {
    if (state.must_reorder) reorder<Dim, Shape>(state, model);
    start_rigid_motion(state, model, dt);
    if (state.step == 0) {
      choose_carriers<Dim, Shape>(state, model);
      start_rotations(state, model);
    }
    lead_positions<Dim, Shape>(state, model, dt);
    watch_motion(state.particles, watched, lead);
    evaluate_conditions(state, model, dt);
    if (model.any_prescribing_body()) parallel_for(state.blocks.size(), model.threads, [&](B b) { prescribe_by_rigid(state, model, b); });
    evaluate_loads(state.time + lead, model, load_values, body_force, damping);
    particle_damping = model.particle_damping(state.time + lead, {});
    check_prescribed(state, model, load_values, body_force, damping, particle_damping);
    assign_velocity_fields<Dim, Shape>(state, model, dt);  // Task 0
    record_initial_volume<Dim, Shape>(state, model);
  });
  phases.blocks("project momentum", [&](B b) { project_momentum<Dim, Shape>(state, model, b); });  // Task 1
  phases.serial("project momentum", [&] { find_rotations(state); });
  if (model.any_contact()) {
    phases.blocks("find contact", [&](B b) { find_shared_nodes<Dim, Shape>(state, model, b); });
    phases.blocks("find contact", [&](B b) { project_contact_sums<Dim, Shape>(state, model, b); });
  }
  contact(
      "contact and boundaries", ContactTask::two, [&](B b) { gather_start_momenta<Dim, Shape>(state, model, b); },  // Tasks 1, 2
      [&](B b) { settle_start_momenta(state, model, b, dt); });
  if (!model.faces.empty()) {
    phases.blocks("face loads", [&](B b) { weigh_face_loads<Dim, Shape>(state, model, b, stress_first ? stress_dt : 0.); });
    phases.serial("face loads", [&] { settle_face_loads(state, model, load_values); });
  }
  phases.blocks("stress and forces", [&](B b) {  // Tasks 2, 3
    update_stress_and_project_forces<Dim, Shape>(state, model, b, dt, stress_first ? stress_dt : 0., load_values, body_force, damping);
  });
  if (model.any_tractions()) phases.serial("crack tractions", [&] { spread_tractions<Dim, Shape>(state, model); });
  contact(
      "update momenta", ContactTask::four,
      [&](B b) { update_momenta<Dim, Shape>(state, model, b, dt, body_force, damping); },  // Tasks 3, 4
      [&](B b) {
        settle_updated_momenta(state, model, b, dt, body_force, damping);
        sum_couples(state, model, b);
      });
  phases.blocks("account loads", [&](B b) {
    account_loads<Dim, Shape>(state, model, b, dt);
    account_mirrored_forces<Dim, Shape>(state, model, b, dt, load_values, body_force, damping);
  });
  const VelocityRule rule = velocity_rule(model.transfer, transfer, scheme, model.positions, dt, damping, particle_damping);
  const bool body_works_anew = transfer.re_extrapolates && !rule.is_flip() && model.any_body_force();
  if (body_works_anew) phases.blocks("account loads", [&](B b) { account_body_force(state, model, b, -0.5 * dt, body_force); });
  if (transfer.terms > 0) {  // XPIC, FMPM
    phases.blocks("filter velocities", [&](B b) { start_series(state, transfer, b, dt); });
    for (int term = 2; term <= transfer.terms; ++term) {
      phases.blocks("filter velocities", [&](B b) {
        sum_read_rotation(state, model, b, ReadVelocity::term);
        project_term<Dim, Shape>(state, model, transfer, b, term);
      });
      phases.serial("filter velocities", [&] { find_term_spins(state); });
      contact(
          "filter velocities", ContactTask::term, [&](B b) { gather_term<Dim, Shape>(state, model, transfer, b, dt); },
          [&](B b) { add_term(state, model, b, dt); });
    }
  }
  if (rule.nodal != 0) phases.blocks("update velocities", [&](B b) { sum_read_rotation(state, model, b, ReadVelocity::motion); });
  phases.serial("update velocities", [&] { answer_couples(state, rule); });
  if (transfer.re_extrapolates) {
    phases.blocks("update velocities", [&](B b) {  // Tasks 5, 6
      if (rule.is_flip()) {
        update_velocities_and_project<Dim, Shape>(state, model, b, dt);
      } else {
        take_velocities_and_project<Dim, Shape>(state, model, b, rule);
      }
    });
    contact(
        "contact and boundaries again", ContactTask::six, [&](B b) { gather_end_momenta<Dim, Shape>(state, model, b, dt); },  // Task 6
        [&](B b) { settle_end_momenta(state, model, b, dt); });
    phases.blocks("account loads", [&](B b) {
      account_loads_anew<Dim, Shape>(state, b, dt);
      if (body_works_anew) account_body_force(state, model, b, 0.5 * dt, body_force);
    });
  } else if (!rule.is_flip()) {
    phases.blocks("update velocities", [&](B b) { take_velocities<Dim, Shape>(state, model, b, rule); });  // Task 5
  }
  phases.serial("remember contacts", [&] {
    remember_contacts(state);
    remember_rigid_conditions(state, model);
  });
  phases.blocks("stress and positions", [&](B b) {  // Tasks 5, 6
    finish_particles<Dim, Shape>(state, model, b, dt, further, stress_last ? stress_dt : 0., !transfer.re_extrapolates && rule.is_flip());
  });
  phases.serial("move cracks", [&] {  // Task 8
    move_cracks(state, model, dt);
    update_tractions(state, model, state.time + dt);
  });
  end_rigid_motion(state);
  state.time += dt;
  ++state.step;
  close_ledger(state, model);
  check_health<Dim, Shape>(state, model, dt);
}

template <int Dim, class Shape>
StiffestVertex find_stiffest_vertex(State<Dim>& state, const Model<Dim>& model) {
  if (!model.any_tractions()) return {};
  if (state.must_reorder) reorder<Dim, Shape>(state, model);
  assign_velocity_fields<Dim, Shape>(state, model, 1.);  // no face moves yet: any time step
  choose_carriers<Dim, Shape>(state, model);
  parallel_for(state.blocks.size(), model.threads, [&](std::size_t b) { project_momentum<Dim, Shape>(state, model, b); });
  parallel_for(state.blocks.size(), model.threads, [&](std::size_t b) { assemble_momentum<Dim, Shape>(state, b); });
  return spread_tractions<Dim, Shape>(state, model);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                               \
  template void advance<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, double, Watched); \
  template StiffestVertex find_stiffest_vertex<DIM, SHAPE>(State<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
