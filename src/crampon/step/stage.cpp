#include "crampon/step/stage.hpp"

#include <chrono>
#include <cstring>

#include "crampon/core/parallel.hpp"

namespace crampon {

namespace {

using Stopwatch = std::chrono::steady_clock;

void book(std::vector<Phase>& phases, const char* name, Stopwatch::time_point start) {
  const double seconds = std::chrono::duration<double>(Stopwatch::now() - start).count();
  for (Phase& phase : phases) {
    if (phase.name == name) {
      phase.seconds += seconds;
      return;
    }
  }
  phases.push_back({name, seconds});
}

}  // namespace

template <int Dim>
void run_stages(const std::vector<Stage<Dim>>& stages, State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const auto holds = [&](const Stage<Dim>& s) { return !s.when || s.when(state, work, model); };
  constexpr std::size_t most_together = 4;
  for (std::size_t i = 0; i < stages.size();) {
    const Stage<Dim>& first = stages[i++];
    if (!holds(first)) continue;
    if (!first.series.empty()) {
      while (++work.now.term <= work.now.transfer.terms) run_stages(first.series, state, work, model);
      continue;
    }
    const Stopwatch::time_point start = Stopwatch::now();
    if (first.once) {
      first.once(state, work, model);
    } else {
      typename Stage<Dim>::OnBlock together[most_together] = {first.on_block};
      std::size_t count = 1;
      Data written = first.reach.writes;
      for (std::size_t j = i; j < stages.size() && count < most_together; ++j) {
        const Stage<Dim>& next = stages[j];
        if (!holds(next)) continue;
        if (!next.on_block || std::strcmp(next.name, first.name) != 0 || meet(next.reach.beside, written)) break;
        together[count++] = next.on_block;
        written = written | next.reach.writes;
        i = j + 1;
      }
      parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) {
        for (std::size_t k = 0; k < count; ++k) together[k](state, work, model, b);
      });
    }
    book(work.phases, first.name, start);
  }
}

template void run_stages<2>(const std::vector<Stage<2>>&, State<2>&, StepWork<2>&, const Model<2>&);
template void run_stages<3>(const std::vector<Stage<3>>&, State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
