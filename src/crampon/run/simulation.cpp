#include "crampon/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/core/error.hpp"
#include "crampon/run/build_model.hpp"
#include "crampon/run/check_memory.hpp"
#include "crampon/run/history_sampler.hpp"
#include "crampon/run/large_stretch.hpp"
#include "crampon/run/notes/notes.hpp"
#include "crampon/run/quantities.hpp"
#include "crampon/run/sample.hpp"
#include "crampon/shape/registry.hpp"
#include "crampon/step/advance.hpp"
#include "crampon/step/face_loads.hpp"
#include "crampon/step/lay_out_blocks.hpp"
#include "crampon/step/particle_sums.hpp"
#include "crampon/step/particle_view.hpp"
#include "crampon/step/verbs.hpp"

namespace crampon {

namespace {

template <int Dim, class Shape>
class Engine final : public Simulation {
 public:
  Engine(const Problem& problem, int threads) : time_(problem.time) {
    BuiltModel<Dim> built = build_model<Dim>(problem, threads);
    model_ = std::move(built.model);
    state_ = std::move(built.state);
    work_ = std::move(built.work);
    if (time_.end) end_ = *time_.end;
    state_.clock.time_step = time_.step ? *time_.step : time_.courant * stable_time_step();
    refuse_endless_run(problem);
    if constexpr (Dim == 2) {
      if (model_.fracture.on) {
        watch_tips<Dim>(state_, work_, model_);
        find_fracture_parameters<Dim>(state_, work_, model_);
      }
    }
    history_.start(problem, state_.observed);
    for (const Diagnostic& note : find_notes(Start<Dim>{problem, model_, state_, state_.clock.time_step, end_time()}))
      notes_at_start_.push_back(note.text());
    const StiffestVertex stiffest = find_stiffest_vertex<Dim, Shape>(state_, work_, model_);
    check_traction_step(stiffest);
    if (!time_.step && stiffest.time_step < 0.7 * state_.clock.time_step) {  // size() counts the steps in any case
      notes_at_start_.push_back(
          fmt::format("the traction law of the crack \"{}\" asks for steps of {:.3g} s; without it they would be of {:.3g} s",
                      state_.cracks.list[stiffest.crack].name, stiffest.time_step, state_.clock.time_step));
    }
  }

  void step(double longest, const NextLook& next_look) override {
    if (!time_.step && watches_wave_speed_ && state_.clock.step % 10 == 0 && state_.clock.step > 0)
      state_.clock.time_step = time_.courant * stable_time_step();
    double dt = longest_step();
    if (!time_.step && state_.clock.traction_time_step < shortest_for_tractions * state_.clock.time_step)
      check_traction_step(find_stiffest_vertex<Dim, Shape>(state_, work_, model_));
    const double left = std::fmin(longest, end_time_or_infinity()) - state_.clock.time;
    bool hits = false;
    if (left > 0 && left <= dt * (1 + 1e-9)) {
      dt = left;
      hits = true;
    } else if (left > 0 && !time_.step && left < 2 * dt) {
      dt = 0.5 * left;  // no sliver of a step at the end
    }
    advance<Dim, Shape>(state_, work_, model_, dt, is_watched(dt, next_look) ? Watched::yes : Watched::no);
    if (hits) state_.clock.time = std::fmin(longest, end_time_or_infinity());  // to the bit
    look_for_rest();
  }

  double time() const override { return state_.clock.time; }
  std::int64_t steps_done() const override { return state_.clock.step; }
  bool finished() const override {
    return rests() || (time_.steps && state_.clock.step >= *time_.steps) || (time_.end && state_.clock.time >= *time_.end * (1 - 1e-14));
  }
  double end_time() const override { return time_.end ? end_ : static_cast<double>(*time_.steps) * state_.clock.time_step; }

  SimulationSize size() const override {
    SimulationSize s;
    s.particles = static_cast<std::int64_t>(state_.order.particle_count);
    s.cells = 1;
    for (int k = 0; k < Dim; ++k) s.cells *= model_.grid.cells[k];
    s.active_cells = active_cells();
    for (const auto& c : state_.cracks.list) {
      s.cracks += c.plane.empty() ? 0 : 1;
      s.crack_segments += static_cast<std::int64_t>(c.facets.size());
    }
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
      const std::vector<Vec<Dim>> now = total_loads(state_, work_, model_, t);
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

  std::vector<std::string> particle_quantities() const override { return quantity_names_of(model_); }
  PointFrame particles(const std::vector<std::string>& names, Precision precision) const override {
    return sample_particles(state_, model_, names, precision);
  }
  CrackFrame cracks() const override { return sample_cracks(state_, work_, model_); }
  PointFrame nodes() const override { return sample_nodes(state_, work_, model_); }

  std::vector<HistoryColumn> history_columns() const override { return history_.columns(); }
  std::vector<double> history_row() const override { return history_.row(); }
  std::vector<HistoryColumn> event_columns() const override { return event_columns_of<Dim>(); }
  std::size_t event_count() const override { return state_.ledger.events.size(); }
  std::vector<double> event_row(std::size_t event) const override { return event_row_of(state_.ledger.events[event]); }

  std::uint64_t state_hash() const override { return hash_state(state_, model_.threads); }
  SavedState save() const override { return save_state(state_); }
  void load(const SavedState& saved) override {
    load_state(state_, saved);
    if (!state_.order.blocks.empty()) lay_out_blocks<Dim, Shape>(state_, work_, model_);
  }
  std::int64_t last_reordering() const override { return state_.order.step; }

  std::vector<PhaseTime> phases() const override {
    std::vector<PhaseTime> out;
    for (const Phase& p : work_.phases) out.push_back({p.name, p.seconds});
    return out;
  }
  std::vector<std::string> notes_at_start() const override { return notes_at_start_; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> out;
    if (rests())
      out.push_back(fmt::format(
          "the run ended at t = {:.6g} s, at rest: kinetic energy stayed under {:g} of the strain energy for {:g} s (time.stop_at_rest)",
          state_.clock.time, time_.stop_at_rest->ratio, time_.stop_at_rest->period));
    if (state_.ledger.most_crowded_nodes > 0)
      out.push_back(fmt::format("up to {} nodes saw more than two cracks at once", state_.ledger.most_crowded_nodes));
    if (state_.ledger.most_unsolved_nodes > 0) {
      out.push_back(fmt::format(
          "contact did not converge at up to {} nodes of a step; smaller cells where cracks or several bodies meet usually help",
          state_.ledger.most_unsolved_nodes));
    }
    if (time_.step && *time_.step > state_.clock.least_traction_time_step) {
      out.push_back(
          fmt::format("the time step of {:.3g} s is longer than the {:.3g} s that the stiffest traction law bears: the run may be unstable",
                      *time_.step, state_.clock.least_traction_time_step));
    }
    const auto count = [&](typename CrackEvent<Dim>::Kind kind) {
      return std::count_if(state_.ledger.events.begin(), state_.ledger.events.end(), [&](const auto& e) { return e.kind == kind; });
    };
    if (const auto failed = count(CrackEvent<Dim>::Kind::failed); failed > 0)
      out.push_back(fmt::format("traction laws failed at {} crack vertices; see events.csv", failed));
    for (const CrackTip& tip : state_.fracture.tips) {
      const std::string where =
          fmt::format("at the {} of the crack \"{}\"", tip.end == 0 ? "start" : "end", state_.cracks.list[tip.crack].name);
      if (tip.missed > 0) {
        const bool ended = tip.status == TipStatus::joined || tip.status == TipStatus::left;
        const std::string why = ended                               ? "it came near to where it ended"
                                : tip.now.no_J == NoParameter::none ? "the last look found one"
                                                                    : reason(tip.now.no_J);
        out.push_back(fmt::format("{} of {} looks found no J {}: {}; a disk of {:g} cells about the tip must be free", tip.missed,
                                  tip.missed + tip.found, where, why, std::fmin(FractureModel::least_outer, model_.fracture.outer)));
      } else if (tip.now.no_J == NoParameter::none && tip.now.no_K != NoParameter::none) {
        out.push_back(fmt::format("there is J but no K {}: {}", where, reason(tip.now.no_K)));
      }
    }
    for (std::size_t n = 0; n < model_.nucleations.size(); ++n) tell_nucleation(model_.nucleations[n], state_.fracture.nucleations[n], out);
    if (state_.ledger.removed > 0) out.push_back(fmt::format("{} particles left the grid and were removed", state_.ledger.removed));
    if (auto note = tell_large_stretch(state_, model_)) out.push_back(std::move(*note));
    return out;
  }

 private:
  /// Why no crack has started, and where none could.
  static void tell_nucleation(const NucleationModel& model, const NucleationState& state, std::vector<std::string>& out) {
    if (model.most > 0 && state.made == 0 && std::isfinite(state.highest)) {
      out.push_back(
          fmt::format("no crack of the nucleation \"{}\" has started: the largest principal stress of a particle was {:.4g} Pa, the "
                      "strength is {:.4g} Pa, of a mean over {:.4g} m",
                      model.name, state.highest, model.strength, model.radius));
    }
    if (state.at_mirror) {
      out.push_back(fmt::format(
          "stress passed the strength of the nucleation \"{}\" within {:.4g} m of a symmetry plane, where no crack starts; take "
          "the whole body instead",
          model.name, model.distance));
    }
  }
  /// Is all at rest, and has been for the period asked for?
  bool rests() const {
    return time_.stop_at_rest && state_.clock.time - state_.clock.rests_since >= time_.stop_at_rest->period * (1 - 1e-12);
  }
  /// Energies are sums over all particles: they are looked at twenty times in a period.
  void look_for_rest() {
    if (!time_.stop_at_rest || state_.clock.time < state_.clock.next_look_for_rest) return;
    state_.clock.next_look_for_rest = state_.clock.time + time_.stop_at_rest->period / 20;
    const auto sums = sum_particles(state_, model_);
    if (!(sums.kinetic <= time_.stop_at_rest->ratio * sums.strain)) {
      state_.clock.rests_since = std::numeric_limits<double>::infinity();
    } else if (state_.clock.rests_since > state_.clock.time) {
      state_.clock.rests_since = state_.clock.time;
    }
  }
  /// A sum of time steps may fall short of the time of a look by round-off.
  bool is_watched(double dt, const NextLook& look) const {
    const double end = state_.clock.time + dt * (1 + 1e-4);
    const bool last = end >= end_time_or_infinity() || (time_.steps && state_.clock.step + 1 >= *time_.steps);
    return last || state_.clock.step + 1 >= look.step || end >= look.time;
  }

  double end_time_or_infinity() const { return time_.end ? end_ : std::numeric_limits<double>::infinity(); }

  double longest_step() const {
    return time_.step ? state_.clock.time_step : std::fmin(state_.clock.time_step, state_.clock.traction_time_step);
  }

  /// A law that forces far shorter steps than the material does would leave a run that never ends.
  void check_traction_step(const StiffestVertex& stiffest) const {
    if (time_.step || !(stiffest.time_step < shortest_for_tractions * state_.clock.time_step)) return;
    if constexpr (Dim == 2) {
      const Crack<2>& crack = state_.cracks.list[stiffest.crack];
      const Vec<2>& x = crack.plane[stiffest.vertex];
      throw RunError(fmt::format(
          "step {} (t = {:.6g} s): the traction law of the crack \"{}\" at ({:.6g}, {:.6g}) m bears steps of {:.3g} s at most, less than a "
          "thousandth of the {:.3g} s without it; lower its stiffness: 10 to 50 times E over the size of a cell is enough",
          state_.clock.step + 1, state_.clock.time, crack.name, x[0], x[1], stiffest.time_step, state_.clock.time_step));
    }
  }

  /// Steps are counted, and none may vanish beside the time that has passed. A run of so many steps would not end in a lifetime.
  void refuse_endless_run(const Problem& problem) const {
    constexpr double most_steps = 1e12;
    if (!time_.end || end_ / state_.clock.time_step <= most_steps) return;
    std::string why = fmt::format("the time step is {:.3g} s", state_.clock.time_step);
    double fastest = 0;
    for (const MaterialInput& in : problem.materials) {
      const double speed = in.law->wave_speed(model_.stress_state);
      if (time_.step || speed < fastest) continue;
      fastest = speed;
      why = fmt::format("waves in \"{}\" run at {:.3g} m/s through cells of {:.3g} m, so the time step is {:.3g} s", in.name, speed,
                        model_.grid.smallest_cell(), state_.clock.time_step);
    }
    throw InputError({{time_.at("end"), fmt::format("{:.3g} s take {:.3g} time steps", end_, end_ / state_.clock.time_step), why,
                       time_.step ? "correct end or step" : "correct end, the material or the cells"}});
  }

  /// Smallest cell over fastest wave (docs/theory/kinematics.md, waves and the time step). Laws whose waves change with strain are asked
  /// for the present speed.
  double stable_time_step() {
    double fastest = 0;
    watches_wave_speed_ = false;
    for (const auto& m : model_.materials) {
      fastest = std::fmax(fastest, m.law->wave_speed(model_.stress_state));
      watches_wave_speed_ = watches_wave_speed_ || m.law->wave_speed_changes();
    }
    for (const Run& run : state_.order.runs) {
      if (!model_.materials[run.material].law->wave_speed_changes()) continue;
      for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
        const Pack c = PackView<Dim>(state_, model_, run.material, k).wave_speed();
        for (int l = 0; l < lanes; ++l) fastest = std::fmax(fastest, c[l]);
      }
    }
    return model_.grid.smallest_cell() / fastest;
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

  TimeInput time_;
  Model<Dim> model_;
  State<Dim> state_;
  StepWork<Dim> work_;
  HistorySampler<Dim> history_{state_, work_, model_};
  double end_ = 0;
  /// Of the step that waves allow: what traction laws may ask for at least.
  static constexpr double shortest_for_tractions = 1e-3;
  std::vector<std::string> notes_at_start_;
  bool watches_wave_speed_ = false;
};

template <int Dim>
std::unique_ptr<Simulation> create_in(const Problem& problem, int threads) {
  return with_shape(problem.method.shape_functions, [&]<class Shape>(std::type_identity<Shape>) -> std::unique_ptr<Simulation> {
    return std::make_unique<Engine<Dim, Shape>>(problem, threads);
  });
}

}  // namespace

std::unique_ptr<Simulation> Simulation::create(const Problem& problem, int threads) {
  check_memory(problem);
  return problem.dimension() == 3 ? create_in<3>(problem, threads) : create_in<2>(problem, threads);
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): what make_unique made is returned

}  // namespace crampon
