#pragma once
/// Particles, laid out by use (docs/decisions/0003-data-layout.md says why):
/// what nodes exchange in records of 32 bytes, what only lanes over particles touch in packs of four.

#include <cstdint>
#include <limits>
#include <vector>

#include "crampon/core/aligned_array.hpp"
#include "crampon/core/members.hpp"
#include "crampon/core/pack.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// Components of a symmetric tensor on particles: {xx, yy, xy, zz} in 2D, {xx, yy, zz, xy, yz, xz} in 3D.
template <int Dim>
inline constexpr int stress_size = Dim == 2 ? 4 : 6;
/// Packs per particle that hold position and velocity: {x, y, vx, vy} in 2D; {x, y, z, 0}, {vx, vy, vz, 1} in 3D.
template <int Dim>
inline constexpr int motion_packs = Dim == 2 ? 1 : 2;
/// Components of the half edges of a particle's domain.
template <int Dim>
inline constexpr int domain_size = Dim* Dim;

/// Components of a small turn: about z in 2D; about x, y and z in 3D.
template <int Dim>
inline constexpr int turn_size = Dim == 2 ? 1 : 3;

/// Layouts of arrays of particles. [particle][width]
struct PerParticle {
  std::size_t width = 1;
};
/// [pack][width], with lanes over the particles of the pack.
struct PerPack {
  std::size_t width = 1;
};

inline constexpr std::uint32_t padding_id = std::numeric_limits<std::uint32_t>::max();

/// All arrays have a multiple of four particles; padding particles (id == padding_id) have no mass and sit on a real one.
/// Positions lead the present time (docs/theory/step.md, time of positions): the step works with position(), all who look at the state from
/// outside ask for present_position().
template <int Dim>
struct Particles {
  std::size_t packs = 0;
  int history_size = 0;            ///< Packs of material history per pack
  bool remembers_contact = false;  ///< there is an array of it
  bool has_domains = false;        ///< ... of domains that stretch
  bool keeps_turn = false;         ///< ... of the turn that laws of small strain leave out
  double lead = 0;                 ///< of positions before the present time, s
  bool watched = false;            ///< there is moved_with, of the last step
  AlignedArray<Pack> motion;       ///< [particle][motion_packs]: m, m/s
  AlignedArray<Pack> mass_volume;  ///< [pack][2]: mass kg, initial volume m3
  AlignedArray<Pack> stress;       ///< [pack][stress_size]: Kirchhoff stress, Pa (N03 material: the stress of Eq. 9's small strain)
  AlignedArray<Pack> history;      ///< [pack][history_size]: strain or deformation gradient and the law's own variables
  AlignedArray<Pack> domain;       ///< [pack][domain_size]: half edges of domains that stretch, m, [axis * Dim + edge]; else empty
  AlignedArray<Pack>
      turn;  ///< [pack][turn_size]: sum of (grad v - grad v^T) dt / 2 where a law of small strain adds up the other half; else empty
  AlignedArray<Vec<Dim>> original;    ///< [particle]: position at the start, m
  AlignedArray<double> contact;       ///< [particle]: what it remembers of contact (ContactPair::history); empty when no law asks
  AlignedArray<Vec<Dim>> moved_with;  ///< [particle]: velocity with which it moved in the last step, m/s; kept where someone will look
  AlignedArray<std::uint32_t> id;     ///< [particle]: number in the order of creation
  AlignedArray<std::uint16_t> body;   ///< [particle]

  std::size_t size() const { return packs * lanes; }

  /// visit(member, array, layout) for every array: who makes, moves, counts, hashes or keeps them walks this list. A width of 0: there is none.
  template <class Self, class Visit>
  static void for_arrays(Self& self, Visit&& visit) {
    visit(Member{"motion", "m, m/s"}, self.motion, PerParticle{motion_packs<Dim>});
    visit(Member{"mass_volume", "kg, m3"}, self.mass_volume, PerPack{2});
    visit(Member{"stress", "Pa"}, self.stress, PerPack{stress_size<Dim>});
    visit(Member{"history", "of the law"}, self.history, PerPack{static_cast<std::size_t>(self.history_size)});
    visit(Member{"domain", "m"}, self.domain, PerPack{self.has_domains ? std::size_t{domain_size<Dim>} : 0});
    visit(Member{"turn", "rad"}, self.turn, PerPack{self.keeps_turn ? std::size_t{turn_size<Dim>} : 0});
    visit(Member{"original", "m"}, self.original, PerParticle{});
    visit(Member{"contact", "of the law"}, self.contact, PerParticle{self.remembers_contact ? 1u : 0u});
    visit(Member{"moved_with", "m/s", Use::display}, self.moved_with, PerParticle{self.watched ? 1u : 0u});
    visit(Member{"id"}, self.id, PerParticle{});
    visit(Member{"body"}, self.body, PerParticle{});
  }
  template <class Self, class Visit>
  static void for_members(Self& self, Visit&& visit) {
    auto& [packs, history_size, remembers_contact, has_domains, keeps_turn, lead, watched, motion, mass_volume, stress, history, domain,
           turn, original, contact, moved_with, id, body] = self;
    visit(Member{"packs"}, packs);
    visit(Member{"history_size"}, history_size);
    visit(Member{"remembers_contact"}, remembers_contact);
    visit(Member{"has_domains"}, has_domains);
    visit(Member{"keeps_turn"}, keeps_turn);
    visit(Member{"lead", "s"}, lead);
    visit(Member{"watched", "1", Use::display}, watched);
    for_arrays(self, [&](const Member& m, auto& array, auto) { visit(m, array); });
  }

  /// Room for `packs`; what was there is lost.
  void allocate() {
    for_arrays(*this, [&](const Member&, auto& array, auto layout) { array.resize_discarding(count(layout)); });
  }
  /// Records in an array of some layout.
  std::size_t count(PerParticle layout) const { return size() * layout.width; }
  std::size_t count(PerPack layout) const { return packs * layout.width; }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for_arrays(*this, [&](const Member&, const auto& array, auto) { sum += array.bytes(); });
    return sum;
  }

  bool is_padding(std::size_t p) const { return id[p] == padding_id; }
  Vec<Dim> position(std::size_t p) const {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = motion[p * motion_packs<Dim>][k];
    return x;
  }
  /// At the present time. After a step that nobody was to watch the particle's own velocity stands for the one that moved it.
  Vec<Dim> present_position(std::size_t p) const { return position(p) - (watched ? moved_with[p] : velocity(p)) * lead; }
  Vec<Dim> velocity(std::size_t p) const {
    Vec<Dim> v;
    for (int k = 0; k < Dim; ++k) v[k] = Dim == 2 ? motion[p][2 + k] : motion[2 * p + 1][k];
    return v;
  }
  void set_motion(std::size_t p, const Vec<Dim>& x, const Vec<Dim>& v) {
    if constexpr (Dim == 2) {
      motion[p] = Pack{x[0], x[1], v[0], v[1]};
    } else {
      motion[2 * p] = Pack{x[0], x[1], x[2], 0.};
      motion[2 * p + 1] = Pack{v[0], v[1], v[2], 1.};
    }
  }
  double mass(std::size_t p) const { return mass_volume[p / lanes * 2][p % lanes]; }
  double volume(std::size_t p) const { return mass_volume[p / lanes * 2 + 1][p % lanes]; }

  /// Positions of a pack, lanes over particles.
  void pack_positions(std::size_t pack, Pack* x) const {
    const Pack* r = &motion[pack * lanes * motion_packs<Dim>];
    constexpr int s = motion_packs<Dim>;
    Pack a = r[0], b = r[s], c = r[2 * s], d = r[3 * s];
    transpose(a, b, c, d);
    x[0] = a;
    x[1] = b;
    if constexpr (Dim == 3) x[2] = c;
  }
  /// The same of velocities.
  void pack_velocities(std::size_t pack, Pack* v) const {
    const Pack* r = &motion[pack * lanes * motion_packs<Dim>];
    constexpr int s = motion_packs<Dim>;
    Pack a = r[s - 1], b = r[2 * s - 1], c = r[3 * s - 1], d = r[4 * s - 1];
    transpose(a, b, c, d);
    v[0] = Dim == 2 ? c : a;
    v[1] = Dim == 2 ? d : b;
    if constexpr (Dim == 3) v[2] = c;
  }
  /// {m v, m} of particle p, the mass in lane Dim (N03 Eq. 26).
  Pack momentum_record(std::size_t p, double mass) const {
    if constexpr (Dim == 2) {
      return __builtin_shufflevector(motion[p], Pack{1., 0., 0., 0.}, 2, 3, 4, 5) * mass;
    } else {
      return motion[2 * p + 1] * mass;
    }
  }
};

}  // namespace crampon
