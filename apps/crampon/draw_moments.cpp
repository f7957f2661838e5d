#include "draw_moments.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "crampon/input/read_problem.hpp"
#include "crampon/run/rigid_shapes.hpp"
#include "terminal.hpp"

namespace crampon::app {
namespace {

std::optional<Problem> read_input(const ResultsFolder& folder) {
  if (!std::filesystem::exists(folder.resolved_input())) return std::nullopt;
  try {
    return read_problem(folder.resolved_input().string());
  } catch (const InputError&) {
    tell(fmt::format("{}: this version of Crampon does not understand it; walls and the shapes of rigid bodies are not drawn",
                     folder.resolved_input().string()));
    return std::nullopt;
  }
}

}  // namespace

std::vector<bool> Moment::of_rigid_bodies() const {
  const std::size_t count = particles.positions.size() / 3;
  std::vector<bool> rigid_particle(count, false);
  const std::vector<double> body = evaluate_quantity(particles, "body").values;
  for (std::size_t p = 0; p < count; ++p)
    rigid_particle[p] = std::any_of(rigid.begin(), rigid.end(), [&](const RigidShape& r) { return body[p] == r.body; });
  return rigid_particle;
}

Moments::Moments(const ResultsFolder& folder)
    : folder_(folder), frames_(folder.particle_frames()), cracks_(folder.crack_frames()), problem_(read_input(folder)) {
  if (!cracks_.empty()) start_ = folder.read_cracks(cracks_.front());
}

Moment Moments::read(std::size_t frame) const {
  const PvdEntry& entry = frames_[frame];
  Moment moment{folder_.read_particles(entry), std::nullopt, {}, start_ ? &*start_ : nullptr};
  const auto found = std::find_if(cracks_.begin(), cracks_.end(), [&entry](const PvdEntry& c) { return c.time == entry.time; });
  if (found != cracks_.end()) moment.cracks = folder_.read_cracks(*found);
  if (problem_) moment.rigid = rigid_shapes(*problem_, moment.particles);
  return moment;
}

void tell(const std::string& note) { fmt::print(stderr, "{} {}\n", styled(stderr, Style::yellow, "note:"), note); }

}  // namespace crampon::app
