#pragma once
/// Forces, works and reactions of folded pairs (step/folded_pairs.hpp), which nodes alone would get wrong.

#include <vector>

#include "crampon/step/packs.hpp"

namespace crampon {

/// f(pack, stencil, lane, index in the stencil, target) for the folded pairs of a block; not those of rigid bodies, whose mass is a volume.
template <int Dim, class Shape, class F>
[[gnu::always_inline]] inline void for_folded(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b,
                                              const std::vector<std::uint32_t>& packs, F f) {
  using T = Tile<Dim, Shape>;
  for_packs<Dim, Shape>(state, work, model, b, packs,
                        [&](std::uint32_t pack, const Stencil<Dim, Shape>& stencil, const PairTarget* targets, const Run& run) {
                          if (model.is_rigid(model.materials[run.material].field)) return;
                          for (int l = 0; l < lanes; ++l) {
                            if (state.particles.is_padding(std::size_t{pack} * lanes + l)) continue;
                            for (int n = 0; n < T::stencil; ++n) {
                              const PairTarget& t = targets[l * T::stencil + n];
                              if (t.mirrored != 0) f(pack, stencil, l, n, t);
                            }
                          }
                        });
}

inline bool is_flipped(unsigned flip, int k) { return flip >> k & 1u; }

/// Task 3. Nodes apply body force and damping to all their mass. A folded pair has brought them mass of a mirror image, and on an image the
/// body force acts with the sign of its normal component changed. An image also needs the force that lets it follow a face which speeds up.
/// Adds what is missing to the block's tiles.
/// \param body_force  m/s2  \param damping  1/s
template <int Dim, class Shape>
void project_mirrored_forces(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t block,
                             NodalVector<Dim>* tiles);

}  // namespace crampon
