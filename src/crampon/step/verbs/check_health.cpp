#include "crampon/step/verbs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "crampon/core/error.hpp"
#include "crampon/step/crack_carriers.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/particle_sums.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

template <int Dim>
std::string text_of(const Vec<Dim>& x) {
  std::string out = "(";
  for (int k = 0; k < Dim; ++k) out += fmt::format("{}{:.6g}", k ? ", " : "", x[k]);
  return out + ") m";
}

template <int Dim>
std::string nearest_crack(const State<Dim>& state, const Vec<Dim>& x) {
  double best = std::numeric_limits<double>::infinity();
  std::string name;
  for (const auto& crack : state.cracks.list) {
    for (const auto& v : crack.plane) {
      const double d = norm(v - x);
      if (d < best) best = d, name = crack.name;
    }
  }
  return name.empty() ? "" : fmt::format("; nearest crack: \"{}\", {:.4g} m away", name, best);
}

/// Calls f(slot, run) for the particles of a block.
template <int Dim, class F>
void for_particles(const State<Dim>& state, const StepWork<Dim>& work, std::size_t b, F f) {
  const Block<Dim>& block = work.blocks.list[b];
  for (std::uint32_t r = block.first_run; r < block.end_run; ++r) {
    const Run& run = state.order.runs[r];
    for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
      if (!state.particles.is_padding(p)) f(p, run);
    }
  }
}

template <int Dim>
[[noreturn]] void stop(const State<Dim>& state, std::size_t p, const std::string& what, const std::string& advice) {
  const Vec<Dim> x = state.particles.position(p);
  throw RunError(fmt::format("step {} (t = {:.6g} s): particle {} at {} {}{}; {}", state.clock.step, state.clock.time,
                             state.particles.id[p], text_of(x), what, nearest_crack(state, x), advice));
}

template <int Dim>
void report_bad_number(const State<Dim>& state, const StepWork<Dim>& work, std::size_t b) {
  for_particles(state, work, b, [&](std::size_t p, const Run&) {
    if (is_finite(state.particles.position(p)) && is_finite(state.particles.velocity(p))) return;
    stop(state, p, "has a position or velocity that is not a number",
         "lower the Courant factor, or look for a load or a velocity that is too large");
  });
}

template <int Dim>
void report_inverted(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  for_particles(state, work, b, [&](std::size_t p, const Run& run) {
    const double ratio = PackView<Dim>(state, model, run.material, p / lanes).report().volume_ratio[p % lanes];
    if (ratio > 0) return;
    stop(state, p, fmt::format("has turned inside out (volume ratio {:.4g})", ratio),
         "lower the Courant factor, use usavg with gimp or bspline shape functions, or a material for large strain (neo_hookean)");
  });
}

template <int Dim>
void report_fast(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, double dt) {
  std::size_t fastest = 0;
  double speed = -1;
  for_particles(state, work, b, [&](std::size_t p, const Run&) {
    const double v = norm(state.particles.velocity(p));
    if (v > speed) speed = v, fastest = p;
  });
  stop(state, fastest,
       fmt::format("moves more than a cell ({:.4g} m) in one step of {:.4g} s: {:.4g} m/s", model.grid.smallest_cell(), dt, speed),
       "the run is unstable or the step too long: lower the Courant factor or the fixed time step");
}

/// Nothing refers to a particle that is about to be removed: no load, no face, no crack.
template <int Dim>
void forget_particle(StepWork<Dim>& work, std::size_t b, std::uint32_t id, std::size_t slot) {
  if (id < work.places.slot_of_id.size()) work.places.slot_of_id[id] = padding_id;
  BlockScratch<Dim>& scratch = work.scratch[b];
  std::erase_if(scratch.loaded, [&](const LoadedParticle& p) { return p.slot == slot; });
  for (const FaceParticle& p : scratch.faces) {
    if (p.slot == slot) work.faces.present[p.number] = false;
  }
  std::erase_if(scratch.faces, [&](const FaceParticle& p) { return p.slot == slot; });
}

}  // namespace

template <int Dim, class Shape>
void check_health(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  bool any_left = false;
  const double dt = work.now.dt;
  for (std::size_t b = 0; b < work.blocks.size(); ++b) {
    const BlockHealth& health = work.scratch[b].health;
    if (!health.trouble()) continue;
    if (health.bad_number) report_bad_number(state, work, b);
    if (health.inverted) report_inverted(state, work, model, b);
    if (health.moved_too_far) report_fast(state, work, model, b, dt);
    if (health.left_grid) {
      for_particles(state, work, b, [&](std::size_t p, const Run& run) {
        if (model.grid.contains(state.particles.position(p))) return;
        if (model.leaving_particle == LeavingParticle::error) {
          stop(state, p, "has left the grid", "enlarge the grid, or set method.leaving_particle = \"remove\"");
        }
        book_departure(state, model, run, p);
        forget_particle(work, b, state.particles.id[p], p);
        any_left = true;
        state.particles.id[p] = padding_id;
        state.particles.mass_volume[p / lanes * 2][p % lanes] = 0.;
        state.particles.mass_volume[p / lanes * 2 + 1][p % lanes] = 0.;
        ++state.ledger.removed;
        state.order.must_reorder = true;
      });
    }
    work.scratch[b].health = {};
  }
  if (any_left) drop_lost_carriers(state, work);
  if (state.ledger.removed > 0 &&
      static_cast<std::size_t>(state.ledger.removed) == state.order.particle_count + static_cast<std::size_t>(state.ledger.removed)) {
    throw RunError(fmt::format("step {} (t = {:.6g} s): every particle has left the grid; enlarge the grid or end the run earlier",
                               state.clock.step, state.clock.time));
  }
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void check_health<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
