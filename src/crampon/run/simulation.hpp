#pragma once
/// A problem brought to life: the one door between the engine and everything around it (program, output, tests).

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "crampon/core/saved_state.hpp"
#include "crampon/input/problem.hpp"
#include "crampon/output/frame.hpp"

namespace crampon {

/// Wall seconds spent in one line of the time step since the start.
struct PhaseTime {
  std::string name;
  double seconds = 0;
};

/// Size of a problem, known before it runs.
struct SimulationSize {
  std::int64_t particles = 0;
  std::int64_t cells = 0;         ///< of the whole grid
  std::int64_t active_cells = 0;  ///< in blocks that hold particles
  std::int64_t cracks = 0, crack_segments = 0;
  std::int64_t steps = 0;   ///< planned; estimated when the time step may change
  double time_step = 0;     ///< s, first step
  double memory_bytes = 0;  ///< estimate of the engine's arrays
};

/// What a load comes to.
struct LoadSummary {
  std::string name;
  std::vector<double> force;  ///< on all that it acts on, when it is largest, N
  double time = 0;            ///< ... s
  double area = 0;            ///< of the faces that it acts on, m2; 0: it acts on particles
};

/// The next state that someone will look at: the first after so many steps since the start, or at or after a time.
struct NextLook {
  std::int64_t step = 0;                                  ///< 0: any state
  double time = std::numeric_limits<double>::infinity();  ///< s
};

class Simulation {
 public:
  /// Builds particles, cracks and grid. threads <= 0: all cores. Throws InputError for what does not fit into memory, before anything is
  /// built, for more steps than can be done, and for what only building can find (empty body, particle or crack outside the grid).
  static std::unique_ptr<Simulation> create(const Problem& problem, int threads = 0);
  virtual ~Simulation() = default;

  /// Advances by one time step. Throws RunError (NaN, particle out of the grid, inverted particle); the state before the step is
  /// then no longer complete, but particles() still shows it for inspection.
  /// longest: do not step further than this time (s), so that output times are hit exactly; a time that is not ahead is no limit.
  /// next_look: positions, probes of displacements and what follows from them are exact in the states announced; in others they are only
  /// close, for the step works with positions half a step ahead and keeps what is needed to take them back only where someone will look.
  virtual void step(double longest, const NextLook& next_look) = 0;
  void step(double longest) { step(longest, {}); }

  virtual double time() const = 0;  ///< s
  virtual std::int64_t steps_done() const = 0;
  virtual bool finished() const = 0;    ///< the end time or the number of steps is reached
  virtual double end_time() const = 0;  ///< s; estimated when only steps are given
  virtual SimulationSize size() const = 0;
  virtual std::vector<LoadSummary> loads() const { return {}; }  ///< on bodies as they are now

  /// Names that particles() understands, in the order of the reference page.
  virtual std::vector<std::string> particle_quantities() const = 0;
  /// Empty list: the common ones. precision: of the frame's numbers; single takes half the memory.
  virtual PointFrame particles(const std::vector<std::string>& quantities = {}, Precision precision = Precision::full) const = 0;
  virtual CrackFrame cracks() const = 0;
  /// Nodes with mass, momentum and force of each velocity field of the last step.
  virtual PointFrame nodes() const = 0;

  virtual std::vector<HistoryColumn> history_columns() const = 0;
  virtual std::vector<double> history_row() const = 0;  ///< at the present time, SI, one value per column; the first column is the time

  /// What failed since the start, for events.csv: crack vertices whose traction law is used up.
  virtual std::vector<HistoryColumn> event_columns() const { return {}; }
  virtual std::size_t event_count() const { return 0; }
  virtual std::vector<double> event_row(std::size_t /*event*/) const { return {}; }

  /// Hash of all on which the further course depends, to the last bit: equal for any number of threads.
  virtual std::uint64_t state_hash() const = 0;
  /// A copy of the state, as named arrays: all that changes during a run (state/state.hpp).
  virtual SavedState save() const = 0;
  /// Takes up a state that a simulation of the same problem had; what follows is equal to the bit. Throws std::runtime_error that names what is
  /// missing or of another kind; the simulation is then of no further use.
  virtual void load(const SavedState& saved) = 0;
  /// The step that began with the last re-ordering of particles; -1: none did.
  virtual std::int64_t last_reordering() const = 0;
  virtual std::vector<PhaseTime> phases() const = 0;
  /// What the input says that is legal but probably not meant (run/notes/notes.hpp), one text each with its place: worth telling before the
  /// first step.
  virtual std::vector<std::string> notes_at_start() const { return {}; }
  /// What happened that is worth telling once at the end ("3 nodes saw more than two cracks").
  virtual std::vector<std::string> notes() const = 0;
};

}  // namespace crampon
