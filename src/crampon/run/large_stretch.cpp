#include "crampon/run/large_stretch.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "crampon/core/parallel.hpp"
#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/particle_view.hpp"

namespace crampon {

namespace {

struct Stretched {
  double square = 0;  ///< of the stretch
  std::size_t particle = 0;
};

/// The most stretched particle of a run.
template <int Dim>
Stretched most_stretched(const State<Dim>& state, const Model<Dim>& model, const Run& run) {
  const Particles<Dim>& particles = state.particles;
  Stretched most;
  for (std::size_t pack = run.first_pack; pack < run.end_pack; ++pack) {
    Pack F_pack[Dim * Dim];
    PackView<Dim>(state, model, run.material, pack).deformation(F_pack);
    for (int l = 0; l < lanes; ++l) {
      const std::size_t p = pack * lanes + static_cast<std::size_t>(l);
      if (particles.is_padding(p)) continue;
      std::array<Vec<Dim>, Dim> columns;
      for (std::size_t c = 0; c < Dim * Dim; ++c) columns[c % Dim][c / Dim] = F_pack[c][l];
      columns = since_start<Dim>(model, particles.id[p], columns);
      Eigen::Matrix<double, Dim, Dim> F;
      for (std::size_t c = 0; c < Dim * Dim; ++c) F(static_cast<int>(c / Dim), static_cast<int>(c % Dim)) = columns[c % Dim][c / Dim];
      if (F.squaredNorm() <= most.square) continue;  // no singular value is larger than this norm
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> stretches;
      const double square = stretches.computeDirect(F.transpose() * F, Eigen::EigenvaluesOnly).eigenvalues()[Dim - 1];
      if (square > most.square) most = {square, p};
    }
  }
  return most;
}

}  // namespace

template <int Dim>
std::optional<std::string> tell_large_stretch(const State<Dim>& state, const Model<Dim>& model) {
  if (state.particles.has_domains) return std::nullopt;
  std::vector<Stretched> of_runs(state.order.runs.size());
  parallel_for(of_runs.size(), model.threads, [&](std::size_t r) {
    const Run& run = state.order.runs[r];
    if (!model.is_rigid(model.materials[run.material].field)) of_runs[r] = most_stretched(state, model, run);
  });
  Stretched most;
  for (const Stretched& of : of_runs) {
    if (of.square > most.square) most = of;
  }
  if (!(most.square > large_stretch * large_stretch)) return std::nullopt;
  return fmt::format(
      "a particle of the body \"{}\" (number {}) is stretched to {:.3g} times its length: from {:g} on, particles whose domains do not "
      "stretch leave gaps, and a body that is held so may tear by itself; compare with method.shape_functions = \"cpdi\"",
      model.bodies[state.particles.body[most.particle]], state.particles.id[most.particle], std::sqrt(most.square), large_stretch);
}

template std::optional<std::string> tell_large_stretch(const State<2>&, const Model<2>&);
template std::optional<std::string> tell_large_stretch(const State<3>&, const Model<3>&);

}  // namespace crampon
