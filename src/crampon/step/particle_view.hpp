#pragma once
/// What one may ask of particles, whatever they are made of. Nobody else hands stress and history of particles to a law but the update of stress.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// One particle in space of three dimensions: components that a plane problem does not have are zero.
struct ParticleView {
  std::uint32_t id = 0;
  int body = 0, material = 0;
  Vec<3> position, velocity;  ///< at the present time, m, m/s; of rigid bodies as prescribed
  Vec<3> original;            ///< position at the start, m
  double mass = 0;            ///< kg
  double volume = 0;          ///< initial, m3
  double stress[6];           ///< Cauchy, Pa: xx, yy, zz, xy, yz, xz
  double strain[6];           ///< as the law measures it: xx, yy, zz, xy, yz, xz
  double energy = 0;          ///< of strain, per initial volume, J/m3
  double volume_ratio = 1;    ///< present over initial volume
  const MaterialLaw* law = nullptr;
  const Pack* history = nullptr;  ///< of its pack
  int lane = 0, dimension = 3;

  /// A variable of its law: 1, 3 (x, y, z) or 6 (xx, yy, zz, xy, yz, xz) components; NaN where the law has no such variable.
  void variable(std::string_view name, int components, double* out) const {
    const LawVariable* of = law->find_variable(dimension, name);
    std::fill_n(out, components, of ? 0. : std::numeric_limits<double>::quiet_NaN());
    static constexpr int from_plane[4] = {0, 1, 3, 2};
    for (int c = 0; of && c < of->size(dimension); ++c)
      out[components == 6 && dimension == 2 ? from_plane[c] : c] = history[of->at + c][lane];
  }
};

/// Four particles of one material. All that is asked is found from the state as it is.
template <int Dim>
class PackView {
 public:
  PackView(const State<Dim>& state, const Model<Dim>& model, std::size_t material, std::size_t pack)
      : state_(state), model_(model), material_(material), pack_(pack) {}

  const MaterialLaw& law() const { return *model_.materials[material_].law; }
  const Pack* stress() const { return &state_.particles.stress[pack_ * stress_size<Dim>]; }  ///< as stored, Pa
  const Pack* history() const { return state_.particles.history.data() + pack_ * static_cast<std::size_t>(state_.particles.history_size); }

  /// Energy, volume ratios and strain; what makes Cauchy stress of the stored one.
  PackReport report() const { return law().report(model_.stress_state, Dim, stress(), history()); }
  /// F[d * Dim + k] = dx_d/dX_k; I + strain for laws of small strain.
  void deformation(Pack* F) const { law().deformation(model_.stress_state, Dim, stress(), history(), F); }
  /// u[d * Dim + k] = du_d/dX_k. Laws of small strain add up their strain; the turn beside it is there where particles keep it.
  void displacement_gradient(Pack* u) const {
    deformation(u);
    for (int k = 0; k < Dim; ++k) u[k * Dim + k] = u[k * Dim + k] - 1.;
    if (!state_.particles.keeps_turn || law().follows_deformation()) return;
    const Pack* turn = &state_.particles.turn[pack_ * turn_size<Dim>];
    for (int c = 0; c < turn_size<Dim>; ++c) {
      const int j = Dim == 2 ? 0 : (c + 1) % 3, i = Dim == 2 ? 1 : (c + 2) % 3;
      u[i * Dim + j] = u[i * Dim + j] + turn[c];
      u[j * Dim + i] = u[j * Dim + i] - turn[c];
    }
  }
  Pack wave_speed() const { return law().wave_speed(model_.stress_state, Dim, stress(), history()); }  ///< m/s

  /// A variable of this law: the Pack of its history that holds a component (LawVariable::size).
  Pack variable(const LawVariable& of, int component = 0) const { return history()[of.at + component]; }
  /// Energy that the law has taken since the start, per initial volume, J/m3.
  Pack dissipated() const {
    const LawVariable* of = law().dissipated(Dim);
    return of ? variable(*of) : splat(0.);
  }

  /// Particle l of the four; report: of this pack.
  ParticleView particle(int l, const PackReport& report) const {
    const Particles<Dim>& particles = state_.particles;
    const std::size_t p = pack_ * lanes + static_cast<std::size_t>(l);
    ParticleView of{};
    const auto [x, v] = present_motion(p);
    for (std::size_t k = 0; k < Dim; ++k) of.position[k] = x[k], of.velocity[k] = v[k], of.original[k] = particles.original[p][k];
    static constexpr int from_2d[6] = {0, 1, 3, 2, -1, -1};
    for (int c = 0; c < 6; ++c) {
      const int at = Dim == 2 ? from_2d[c] : c;
      of.stress[c] = at < 0 ? 0. : stress()[at][l] * report.to_cauchy[l];
      of.strain[c] = report.strain[c][l];
    }
    of.energy = report.energy[l];
    of.volume = particles.volume(p);
    of.mass = particles.mass(p);
    of.volume_ratio = report.volume_ratio[l];
    of.id = particles.id[p];
    of.body = particles.body[p];
    of.material = static_cast<int>(material_);
    of.law = &law();
    of.history = history();
    of.lane = l;
    of.dimension = Dim;
    return of;
  }

 private:
  std::pair<Vec<Dim>, Vec<Dim>> present_motion(std::size_t p) const {
    const Particles<Dim>& particles = state_.particles;
    const MaterialField& field = model_.contact.fields[model_.materials[material_].field];
    if (!field.rigid || particles.lead == 0) return {particles.present_position(p), particles.velocity(p)};
    const RigidMotion<Dim>& motion = state_.rigid[static_cast<std::size_t>(field.body)];
    const Vec<Dim> x = motion.present.place(particles.original[p] - model_.rigid_bodies[static_cast<std::size_t>(field.body)].centre);
    return {x, motion.start.velocity_at(x)};
  }

  const State<Dim>& state_;
  const Model<Dim>& model_;
  std::size_t material_, pack_;
};

}  // namespace crampon
