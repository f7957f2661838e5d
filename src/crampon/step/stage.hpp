#pragma once
/// A step as a table of stages, and the executor that walks it (docs/architecture.md, the time step).

#include <cstdint>
#include <type_traits>
#include <vector>

#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// What stages hand to each other, one bit each.
enum class Data : std::uint32_t {
  none = 0,
  order = 1u << 0,        ///< of particles; blocks; who refers to them
  motion = 1u << 1,       ///< positions and velocities of particles
  stress = 1u << 2,       ///< stress, history of laws and domains of particles
  slip = 1u << 3,         ///< what particles remember of contact
  cracks = 1u << 4,       ///< vertices and surface points
  tractions = 1u << 5,    ///< of crack faces: histories, forces of the next step
  contacts = 1u << 6,     ///< what contact remembers of the last step
  rigid = 1u << 7,        ///< where rigid bodies are, and where they go
  prescribed = 1u << 8,   ///< velocities on nodes, loads, body force, damping in this step
  fields = 1u << 9,       ///< velocity fields: layers, targets of pairs, slots
  tiles = 1u << 10,       ///< sums of blocks over their particles, before assembly
  shared = 1u << 11,      ///< which nodes hold several fields
  pairs = 1u << 12,       ///< contacts found at nodes and at rigid faces
  momenta = 1u << 13,     ///< of nodes
  forces = 1u << 14,      ///< of nodes
  velocities = 1u << 15,  ///< of nodes, as stress updates read them
  answers = 1u << 16,     ///< of nodes, as particles read them: {v', a}; what contact has gained
  rotations = 1u << 17,   ///< of pieces, and the couples on them
  faces = 1u << 18,       ///< faces under load
  books = 1u << 19,       ///< sums of a step, and what went wrong in it
  tips = 1u << 20,        ///< of cracks: particles about them, fracture parameters
};
constexpr Data operator|(Data a, Data b) { return static_cast<Data>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b)); }
constexpr bool meet(Data a, Data b) { return (static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b)) != 0; }

/// What a stage takes and gives. `beside`: what it reads of the blocks around its own, or of all when it runs once.
struct Reach {
  Data reads = Data::none, beside = Data::none, writes = Data::none;
};

/// A line of the step: one verb or several that run one after another on the same block while it is in the cache.
template <int Dim>
struct Stage {
  using Once = void (*)(State<Dim>&, StepWork<Dim>&, const Model<Dim>&);
  using OnBlock = void (*)(State<Dim>&, StepWork<Dim>&, const Model<Dim>&, std::size_t);
  using When = bool (*)(const State<Dim>&, const StepWork<Dim>&, const Model<Dim>&);

  const char* name = "";  ///< as the summary of a run has it; lines of one name are one phase there
  Reach reach;
  When when = nullptr;             ///< null: always
  Once once = nullptr;             ///< for all blocks together ...
  OnBlock on_block = nullptr;      ///< ... or for each block, in parallel
  std::vector<Stage<Dim>> series;  ///< ... or these lines, again and again while there are further terms (StepValues::term)
};

/// Verbs take what they need of (state, work, model, block), in this order.
template <int Dim, auto... verbs>
void run_on_block(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block) {
  const auto call = [&](auto f) {
    using F = decltype(f);
    using S = State<Dim>&;
    using W = StepWork<Dim>&;
    using M = const Model<Dim>&;
    if constexpr (std::is_invocable_v<F, S, W, M, std::size_t>) {
      f(state, work, model, block);
    } else if constexpr (std::is_invocable_v<F, W, M, std::size_t>) {
      f(work, model, block);
    } else if constexpr (std::is_invocable_v<F, S, W, std::size_t>) {
      f(state, work, block);
    } else {
      static_assert(std::is_invocable_v<F, W, std::size_t>,
                    "a verb on blocks takes (state, work, model, block), or some of the first three");
      f(work, block);
    }
  };
  (call(verbs), ...);
}
template <int Dim, auto... verbs>
void run_once(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const auto call = [&](auto f) {
    using F = decltype(f);
    using S = State<Dim>&;
    using W = StepWork<Dim>&;
    using M = const Model<Dim>&;
    if constexpr (std::is_invocable_v<F, S, W, M>) {
      f(state, work, model);
    } else if constexpr (std::is_invocable_v<F, S, W>) {
      f(state, work);
    } else if constexpr (std::is_invocable_v<F, S, M>) {
      f(state, model);
    } else {
      static_assert(std::is_invocable_v<F, S>,
                    "a verb that runs once takes (state, work, model), or some of them beginning with the state");
      f(state);
    }
  };
  (call(verbs), ...);
}

/// The contact verb, in a task.
template <int Dim, auto verb, ContactTask task>
void in_task(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block) {
  verb(state, work, model, block, task);
}
template <int Dim, auto verb, ContactTask task>
void in_task_once(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  verb(state, work, model, task);
}

/// The verb, where a condition on the model holds.
template <int Dim, bool (*holds)(const Model<Dim>&), auto verb>
void run_where(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t block) {
  if (holds(model)) run_on_block<Dim, verb>(state, work, model, block);
}

/// Runs the lines in their order. Lines on blocks that follow each other under one name run block by block together, unless the later reads of
/// blocks beside what the earlier writes. Wall time goes to StepWork::phases, by name.
template <int Dim>
void run_stages(const std::vector<Stage<Dim>>& stages, State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model);

}  // namespace crampon
