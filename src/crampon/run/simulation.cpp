#include "crampon/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/core/error.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/run/build_model.hpp"
#include "crampon/run/check_memory.hpp"
#include "crampon/run/notes/notes.hpp"
#include "crampon/run/sample.hpp"
#include "crampon/shape/bspline.hpp"
#include "crampon/shape/gimp.hpp"
#include "crampon/shape/linear.hpp"
#include "crampon/step/advance.hpp"
#include "crampon/step/face_loads.hpp"
#include "crampon/step/ledger.hpp"
#include "crampon/step/move_cracks.hpp"

namespace crampon {

namespace {

constexpr const char* axis_names[3] = {"x", "y", "z"};

template <int Dim, class Shape>
class Engine final : public Simulation {
 public:
  Engine(const Problem& problem, int threads) : time_(problem.time) {
    BuiltModel<Dim> built = build_model<Dim>(problem, threads);
    model_ = std::move(built.model);
    state_ = std::move(built.state);
    if (time_.end) end_ = *time_.end;
    time_step_ = time_.step ? *time_.step : time_.courant * stable_time_step();
    refuse_endless_run(problem);
    place_probes(problem);
    initial_energy_ = energy();
    cracked_ = std::move(built.cracked);
    for (const Diagnostic& note : find_notes(Start<Dim>{problem, model_, state_, time_step_, end_time()}))
      notes_at_start_.push_back(note.text());
    const StiffestVertex stiffest = find_stiffest_vertex<Dim, Shape>(state_, model_);
    check_traction_step(stiffest);
    if (!time_.step && stiffest.time_step < 0.7 * time_step_) {  // size() counts the steps in any case
      notes_at_start_.push_back(
          fmt::format("the traction law of the crack \"{}\" asks for steps of {:.3g} s; without it they would be of {:.3g} s",
                      state_.cracks.list[stiffest.crack].name, stiffest.time_step, time_step_));
    }
  }

  void step(double longest, const NextLook& next_look) override {
    if (!time_.step && watches_wave_speed_ && state_.step % 10 == 0 && state_.step > 0) time_step_ = time_.courant * stable_time_step();
    double dt = longest_step();
    if (!time_.step && state_.traction_time_step < shortest_for_tractions * time_step_)
      check_traction_step(find_stiffest_vertex<Dim, Shape>(state_, model_));
    const double left = std::fmin(longest, end_time_or_infinity()) - state_.time;
    bool hits = false;
    if (left > 0 && left <= dt * (1 + 1e-9)) {
      dt = left;
      hits = true;
    } else if (left > 0 && !time_.step && left < 2 * dt) {
      dt = 0.5 * left;  // no sliver of a step at the end
    }
    advance<Dim, Shape>(state_, model_, dt, is_watched(dt, next_look) ? Watched::yes : Watched::no);
    if (hits) state_.time = std::fmin(longest, end_time_or_infinity());  // to the bit
    look_for_rest();
  }

  double time() const override { return state_.time; }
  std::int64_t steps_done() const override { return state_.step; }
  bool finished() const override {
    return rests() || (time_.steps && state_.step >= *time_.steps) || (time_.end && state_.time >= *time_.end * (1 - 1e-14));
  }
  double end_time() const override { return time_.end ? end_ : static_cast<double>(*time_.steps) * time_step_; }

  SimulationSize size() const override {
    SimulationSize s;
    s.particles = static_cast<std::int64_t>(state_.particle_count);
    s.cells = 1;
    for (int k = 0; k < Dim; ++k) s.cells *= model_.grid.cells[k];
    s.active_cells = active_cells();
    s.cracks = static_cast<std::int64_t>(state_.cracks.size());
    for (const auto& c : state_.cracks.list) s.crack_segments += static_cast<std::int64_t>(c.facets.size());
    s.time_step = longest_step();
    s.steps = time_.steps ? *time_.steps : static_cast<std::int64_t>(std::ceil(end_ / s.time_step - 1e-9));
    const double blocks = static_cast<double>(s.active_cells) / block_nodes<Dim>;
    s.memory_bytes = static_cast<double>(state_.particles.bytes()) * 2 +  // twice while particles are re-ordered
                     blocks * Tile<Dim, Shape>::nodes * (sizeof(Pack) + sizeof(NodalVector<Dim>)) +
                     blocks * block_nodes<Dim> * (sizeof(Pack) + 2 * sizeof(NodalVector<Dim>) + sizeof(MotionRecord<Dim>)) +
                     static_cast<double>(model_.grid.block_total()) * sizeof(std::uint32_t);
    return s;
  }

  std::vector<LoadSummary> loads() const override {
    std::vector<LoadSummary> out(model_.loads.size());
    constexpr int times = 1000;
    for (int i = 0; i <= times; ++i) {
      const double t = end_time() * i / times;
      const std::vector<Vec<Dim>> now = total_loads(state_, model_, t);
      for (std::size_t l = 0; l < out.size(); ++l) {
        Vec<Dim> largest;
        for (std::size_t k = 0; k < out[l].force.size(); ++k) largest[k] = out[l].force[k];
        if (i > 0 && norm(now[l]) <= norm(largest) * (1 + 1e-9)) continue;
        out[l].force.assign(now[l].c.begin(), now[l].c.end());
        out[l].time = t;
      }
    }
    for (std::size_t l = 0; l < out.size(); ++l) out[l].name = model_.loads[l].name;
    for (const FaceColumn& c : model_.faces.columns) out[c.load].area += c.area * c.share;
    return out;
  }

  std::vector<std::string> particle_quantities() const override { return particle_quantity_names(); }
  PointFrame particles(const std::vector<std::string>& names, Precision precision) const override {
    return sample_particles(state_, model_, names, precision);
  }
  CrackFrame cracks() const override { return sample_cracks(state_); }
  PointFrame nodes() const override { return sample_nodes(state_, model_); }

  std::vector<HistoryColumn> history_columns() const override {
    std::vector<HistoryColumn> c = {{"time", "s"},
                                    {"kinetic_energy", "J"},
                                    {"strain_energy", "J"},
                                    {"total_energy", "J"},
                                    {"load_work", "J"},
                                    {"body_force_work", "J"},
                                    {"boundary_work", "J"},
                                    {"damping_loss", "J"},
                                    {"transfer_loss", "J"},
                                    {"contact_loss", "J"},
                                    {"friction_loss", "J"},
                                    {"interface_energy", "J"},
                                    {"cohesive_energy", "J"},
                                    {"cohesive_loss_I", "J"},
                                    {"cohesive_loss_II", "J"},
                                    {"energy_closure", "J"}};
    for (int k = 0; k < Dim; ++k) c.push_back({std::string("momentum_") + axis_names[k], "kg m/s"});
    c.push_back({"angular_momentum_z", "kg m2/s"});
    if (model_.leaving_particle == LeavingParticle::remove) {
      c.insert(c.end(), {{"left_mass", "kg"}, {"left_energy", "J"}});
      for (int k = 0; k < Dim; ++k) c.push_back({std::string("left_momentum_") + axis_names[k], "kg m/s"});
      c.push_back({"left_angular_momentum_z", "kg m2/s"});
    }
    for (const auto& condition : model_.conditions) {
      for (int k = 0; k < Dim; ++k) c.push_back({std::string("reaction_") + axis_names[k] + "." + condition.name, "N"});
    }
    for (const auto& body : model_.rigid_bodies) {
      if (body.prescribes) continue;  // its condition has the columns
      for (int k = 0; k < Dim; ++k) c.push_back({std::string("reaction_") + axis_names[k] + "." + body.name, "N"});
      for (int k = Dim == 2 ? 2 : 0; k < 3; ++k) c.push_back({std::string("torque_") + axis_names[k] + "." + body.name, "N m"});
    }
    for (const auto& load : model_.loads) {
      for (int k = 0; k < Dim; ++k) c.push_back({std::string("load_") + axis_names[k] + "." + load.name, "N"});
    }
    for (const auto& crack : state_.cracks.list) {
      c.push_back({"opening_min." + crack.name, "m"});
      c.push_back({"opening_max." + crack.name, "m"});
      c.push_back({"sliding_max." + crack.name, "m"});
    }
    for (const Probe& probe : probes_) {
      const Field f = probed(probe.quantity).field;
      for (int k = 0; k < f.components; ++k) c.push_back({probe.name + "." + f.name + suffix(f.components, k), f.unit});
    }
    return c;
  }

  std::vector<double> history_row() const override {
    const auto sums = sum_particles(state_, model_);
    const EnergyTotals& e = state_.energy;
    const double total = sums.kinetic + sums.strain;
    const CohesiveTotals& cohesive = state_.cohesive;
    const double load_work = e.load_work + cohesive.work_of_pressure;
    const double held = e.interfaces + cohesive.stored, lost = e.damping + e.transfer_loss + e.contact_loss + e.friction_loss +
                                                               cohesive.dissipated_normal + cohesive.dissipated_shear;
    const double left_energy = state_.left.kinetic + state_.left.strain;
    const double closure = total + held + lost + left_energy - load_work - e.body_work - e.boundary_work - initial_energy_;
    std::vector<double> row = {state_.time,
                               sums.kinetic,
                               sums.strain,
                               total,
                               load_work,
                               e.body_work,
                               e.boundary_work,
                               e.damping,
                               e.transfer_loss,
                               e.contact_loss,
                               e.friction_loss,
                               e.interfaces,
                               cohesive.stored,
                               cohesive.dissipated_normal,
                               cohesive.dissipated_shear,
                               closure};
    for (int k = 0; k < Dim; ++k) row.push_back(sums.momentum[k]);
    row.push_back(sums.angular);
    if (model_.leaving_particle == LeavingParticle::remove) {
      row.insert(row.end(), {state_.left.mass, left_energy});
      for (int k = 0; k < Dim; ++k) row.push_back(state_.left.momentum[k]);
      row.push_back(state_.left.angular);
    }
    for (std::size_t c = 0; c < model_.conditions.size(); ++c) {
      for (int k = 0; k < Dim; ++k) row.push_back(c < state_.reactions.size() ? state_.reactions[c][k] : 0.);
    }
    for (std::size_t b = 0; b < model_.rigid_bodies.size(); ++b) {
      if (model_.rigid_bodies[b].prescribes) continue;
      const RigidReaction<Dim> r = b < state_.rigid_reactions.size() ? state_.rigid_reactions[b] : RigidReaction<Dim>{};
      for (int k = 0; k < Dim; ++k) row.push_back(r.force[k]);
      for (int k = Dim == 2 ? 2 : 0; k < 3; ++k) row.push_back(r.torque[k]);
    }
    for (const Vec<Dim>& load : total_loads(state_, model_, state_.time)) row.insert(row.end(), load.c.begin(), load.c.end());
    if constexpr (Dim == 2) {
      for (std::size_t c = 0; c < state_.cracks.size(); ++c) add_openings(present_crack(state_, state_.cracks.list[c]), cracked_[c], row);
    }
    for (const Probe& probe : probes_) {
      const auto& [ids, f] = probed(probe.quantity);
      const auto at = std::lower_bound(ids.begin(), ids.end(), static_cast<double>(probe.particle));
      for (int k = 0; k < f.components; ++k) {
        const bool there = at != ids.end() && *at == probe.particle;
        row.push_back(there ? f.values[static_cast<std::size_t>(at - ids.begin()) * f.components + k]
                            : std::numeric_limits<double>::quiet_NaN());
      }
    }
    return row;
  }

  std::vector<HistoryColumn> event_columns() const override {
    std::vector<HistoryColumn> c = {{"time", "s"}, {"crack", "1"}};
    for (int k = 0; k < Dim; ++k) c.push_back({axis_names[k], "m"});
    c.insert(c.end(), {{"G_I", "J/m2"}, {"G_II", "J/m2"}});
    return c;
  }
  std::size_t event_count() const override { return state_.events.size(); }
  std::vector<double> event_row(std::size_t event) const override {
    const FailureEvent<Dim>& e = state_.events[event];
    std::vector<double> row = {e.time, static_cast<double>(e.crack)};
    for (int k = 0; k < Dim; ++k) row.push_back(e.x[k]);
    row.insert(row.end(), {e.G_I, e.G_II});
    return row;
  }

  std::uint64_t state_hash() const override { return hash_state(state_); }
  std::vector<PhaseTime> phases() const override {
    std::vector<PhaseTime> out;
    for (const Phase& p : state_.phases) out.push_back({p.name, p.seconds});
    return out;
  }
  std::vector<std::string> notes_at_start() const override { return notes_at_start_; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> out;
    if (rests())
      out.push_back(fmt::format(
          "the run ended at t = {:.6g} s, at rest: kinetic energy stayed under {:g} of the strain energy for {:g} s (time.stop_at_rest)",
          state_.time, time_.stop_at_rest->ratio, time_.stop_at_rest->period));
    if (state_.most_crowded_nodes > 0)
      out.push_back(fmt::format("up to {} nodes saw more than two cracks at once", state_.most_crowded_nodes));
    if (state_.most_unsolved_nodes > 0) {
      out.push_back(fmt::format(
          "contact did not converge at up to {} nodes of a step; smaller cells where cracks or several bodies meet usually help",
          state_.most_unsolved_nodes));
    }
    if (time_.step && *time_.step > state_.least_traction_time_step) {
      out.push_back(
          fmt::format("the time step of {:.3g} s is longer than the {:.3g} s that the stiffest traction law bears: the run may be unstable",
                      *time_.step, state_.least_traction_time_step));
    }
    if (!state_.events.empty())
      out.push_back(fmt::format("traction laws failed at {} crack vertices; see events.csv", state_.events.size()));
    if (state_.removed > 0) out.push_back(fmt::format("{} particles left the grid and were removed", state_.removed));
    return out;
  }

 private:
  /// Is all at rest, and has been for the period asked for?
  bool rests() const { return time_.stop_at_rest && state_.time - rests_since_ >= time_.stop_at_rest->period * (1 - 1e-12); }
  /// Energies are sums over all particles: they are looked at twenty times in a period.
  void look_for_rest() {
    if (!time_.stop_at_rest || state_.time < next_look_) return;
    next_look_ = state_.time + time_.stop_at_rest->period / 20;
    const auto sums = sum_particles(state_, model_);
    if (!(sums.kinetic <= time_.stop_at_rest->ratio * sums.strain)) {
      rests_since_ = std::numeric_limits<double>::infinity();
    } else if (rests_since_ > state_.time) {
      rests_since_ = state_.time;
    }
  }
  struct Probe {
    std::string name, quantity;
    std::uint32_t particle = 0;
  };

  struct Probed {
    std::vector<double> ids;
    Field field;
  };
  /// A quantity as the output knows it, or a number made of one ("velocity_x", "von_mises"). Throws std::invalid_argument.
  Probed probed(const std::string& quantity) const {
    const std::vector<std::string> known = particle_quantity_names();
    const auto is_known = [&](const std::string& name) { return std::find(known.begin(), known.end(), name) != known.end(); };
    if (is_known(quantity)) {
      PointFrame frame = sample_particles(state_, model_, {quantity});
      return {frame.fields.front().values.doubles(), std::move(frame.fields.back())};
    }
    const std::string field = quantity.substr(0, quantity.rfind('_'));
    PointFrame frame = sample_particles(state_, model_, is_known(field) ? std::vector{field} : known);
    Quantity all = evaluate_quantity(frame, quantity);
    return {frame.fields.front().values.doubles(), {quantity, all.unit, 1, std::move(all.values)}};
  }

  /// A sum of time steps may fall short of the time of a look by round-off.
  bool is_watched(double dt, const NextLook& look) const {
    const double end = state_.time + dt * (1 + 1e-4);
    const bool last = end >= end_time_or_infinity() || (time_.steps && state_.step + 1 >= *time_.steps);
    return last || state_.step + 1 >= look.step || end >= look.time;
  }

  double end_time_or_infinity() const { return time_.end ? end_ : std::numeric_limits<double>::infinity(); }

  double longest_step() const { return time_.step ? time_step_ : std::fmin(time_step_, state_.traction_time_step); }

  /// A law that forces far shorter steps than the material does would leave a run that never ends.
  void check_traction_step(const StiffestVertex& stiffest) const {
    if (time_.step || !(stiffest.time_step < shortest_for_tractions * time_step_)) return;
    if constexpr (Dim == 2) {
      const Crack<2>& crack = state_.cracks.list[stiffest.crack];
      const Vec<2>& x = crack.plane[stiffest.vertex];
      throw RunError(fmt::format(
          "step {} (t = {:.6g} s): the traction law of the crack \"{}\" at ({:.6g}, {:.6g}) m bears steps of {:.3g} s at most, less than a "
          "thousandth of the {:.3g} s without it; lower its stiffness: 10 to 50 times E over the size of a cell is enough",
          state_.step + 1, state_.time, crack.name, x[0], x[1], stiffest.time_step, time_step_));
    }
  }

  /// Steps are counted, and none may vanish beside the time that has passed. A run of so many steps would not end in a lifetime.
  void refuse_endless_run(const Problem& problem) const {
    constexpr double most_steps = 1e12;
    if (!time_.end || end_ / time_step_ <= most_steps) return;
    std::string why = fmt::format("the time step is {:.3g} s", time_step_);
    double fastest = 0;
    for (const MaterialInput& in : problem.materials) {
      const double speed = in.law->wave_speed(model_.stress_state);
      if (time_.step || speed < fastest) continue;
      fastest = speed;
      why = fmt::format("waves in \"{}\" run at {:.3g} m/s through cells of {:.3g} m, so the time step is {:.3g} s", in.name, speed,
                        model_.grid.smallest_cell(), time_step_);
    }
    throw InputError({{time_.at("end"), fmt::format("{:.3g} s take {:.3g} time steps", end_, end_ / time_step_), why,
                       time_.step ? "correct end or step" : "correct end, the material or the cells"}});
  }

  /// Smallest cell over fastest wave (kinematics.md 12); laws whose waves change with strain are asked for the present speed.
  double stable_time_step() {
    double fastest = 0;
    watches_wave_speed_ = false;
    for (const auto& m : model_.materials) {
      fastest = std::fmax(fastest, m.law->wave_speed(model_.stress_state));
      watches_wave_speed_ = watches_wave_speed_ || m.law->wave_speed_changes();
    }
    for (const Run& run : state_.blocks.runs) {
      const MaterialLaw& law = *model_.materials[run.material].law;
      if (!law.wave_speed_changes()) continue;
      for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
        const Pack c = law.wave_speed(model_.stress_state, Dim, &state_.particles.stress[k * stress_size<Dim>],
                                      state_.particles.history.data() + k * state_.particles.history_size);
        for (int l = 0; l < lanes; ++l) fastest = std::fmax(fastest, c[l]);
      }
    }
    return model_.grid.smallest_cell() / fastest;
  }

  double energy() const {
    const auto sums = sum_particles(state_, model_);
    return sums.kinetic + sums.strain;
  }

  std::int64_t active_cells() const {
    std::vector<std::int64_t> blocks;
    for (std::size_t p = 0; p < state_.particles.size(); ++p) {
      IndexVector<Dim> b{};
      const Vec<Dim> x = state_.particles.position(p);
      for (int k = 0; k < Dim; ++k) {
        b[k] = Grid<Dim>::block_of(
            static_cast<int>(std::floor((x[k] - model_.grid.origin[k]) * model_.grid.inverse_cell[k] + Shape::bin_shift)));
      }
      blocks.push_back(model_.grid.block_number(b));
    }
    std::sort(blocks.begin(), blocks.end());
    return (std::unique(blocks.begin(), blocks.end()) - blocks.begin()) * block_nodes<Dim>;
  }

  void place_probes(const Problem& problem) {
    std::vector<Diagnostic> errors;
    for (const ProbeInput& in : problem.probes) {
      try {
        probed(in.quantity);
      } catch (const std::invalid_argument& error) {
        errors.push_back({in.at("quantity"), error.what(), "it is a particle quantity or a component of one", "correct the name"});
      }
      double best = std::numeric_limits<double>::infinity();
      Probe probe{in.name, in.quantity, 0};
      for (std::size_t p = 0; p < state_.particles.size(); ++p) {
        if (state_.particles.is_padding(p)) continue;
        if (!in.body.empty() && model_.bodies[state_.particles.body[p]] != in.body) continue;
        Vec<Dim> d = state_.particles.position(p);
        for (int k = 0; k < Dim; ++k) d[k] -= in.point[static_cast<std::size_t>(k)];
        // Of particles equally near, the one made first.
        const double distance = norm(d);
        if (distance < best || (distance == best && state_.particles.id[p] < probe.particle))
          best = distance, probe.particle = state_.particles.id[p];
      }
      probes_.push_back(probe);
    }
    if (!errors.empty()) throw InputError(std::move(errors));
  }

  static std::string suffix(int components, int k) {
    static constexpr const char* tensor[6] = {"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"};
    if (components == 3) return std::string("_") + axis_names[k];
    return components == 6 ? tensor[k] : "";
  }

  /// Over the vertices with material on both sides but for ends; over all when there are none.
  void add_openings(const Crack<2>& crack, const std::vector<bool>& cracked, std::vector<double>& row) const {
    const std::size_t n = crack.plane.size();
    const auto counts = [&](std::size_t v) { return cracked[v] && (crack.closed || (v > 0 && v + 1 < n)); };
    bool any = false;
    for (std::size_t v = 0; v < n; ++v) any = any || counts(v);
    double low = std::numeric_limits<double>::infinity(), high = -low, slid = 0;
    for (std::size_t v = 0; v < n; ++v) {
      if (any && !counts(v)) continue;
      const CrackOpening o = opening_at(crack, v);
      low = std::fmin(low, o.opening);
      high = std::fmax(high, o.opening);
      slid = std::fmax(slid, std::fabs(o.sliding));
    }
    row.insert(row.end(), {low, high, slid});
  }

  TimeInput time_;
  Model<Dim> model_;
  State<Dim> state_;
  double time_step_ = 0, end_ = 0, initial_energy_ = 0;
  /// Of the step that waves allow: what traction laws may ask for at least.
  static constexpr double shortest_for_tractions = 1e-3;
  std::vector<std::vector<bool>> cracked_;  ///< BuiltModel::cracked
  std::vector<std::string> notes_at_start_;
  double next_look_ = 0;                                          ///< for rest, s
  double rests_since_ = std::numeric_limits<double>::infinity();  ///< at every look, s
  bool watches_wave_speed_ = false;
  std::vector<Probe> probes_;
};

template <int Dim>
std::unique_ptr<Simulation> create_in(const Problem& problem, int threads) {
  switch (problem.method.shape_functions) {
    case ShapeFunctionKind::linear:
      return std::make_unique<Engine<Dim, LinearShape>>(problem, threads);
    case ShapeFunctionKind::gimp:
      return std::make_unique<Engine<Dim, GimpShape>>(problem, threads);
    case ShapeFunctionKind::bspline:
      return std::make_unique<Engine<Dim, BsplineShape>>(problem, threads);
  }
  throw std::logic_error("unknown shape functions");
}

}  // namespace

std::unique_ptr<Simulation> Simulation::create(const Problem& problem, int threads) {
  check_memory(problem);
  return problem.dimension() == 3 ? create_in<3>(problem, threads) : create_in<2>(problem, threads);
}

}  // namespace crampon
