#pragma once
/// What a shape function must say about itself. Whatever it leaves out, the first error names.

#include <type_traits>

#include "crampon/core/pack.hpp"
#include "crampon/shape/domain.hpp"
#include "crampon/shape/profile.hpp"

namespace crampon {

/// Does S have all members of a shape function?
template <class S>
struct HasShapeMembers {
  static_assert(
      requires { static_cast<const char*>(S::name); },
      "a shape function lacks `name`: the word by which method.shape_functions chooses it");
  static_assert(
      requires { static_cast<const char*>(S::help); },
      "a shape function lacks `help`: a few words that say what it is, for the reference page");
  static_assert(
      requires { int{S::width}; }, "a shape function lacks `width`: the number of nodes of its stencil along an axis");
  static_assert(
      requires { int{S::below}; },
      "a shape function lacks `below`: how many nodes of its stencil lie below the node of the particle's bin");
  static_assert(
      requires { double{S::bin_shift}; },
      "a shape function lacks `bin_shift`: 0 when particles are binned by cell, 0.5 when by the nearest node");
  static_assert(
      requires { bool{S::has_domains}; }, "a shape function lacks `has_domains`: do particles have domains that move with the nodes?");
  static_assert(
      requires { ProfileBoxes{S::boxes}; }, "a shape function lacks `boxes`: the boxes that make its profile (shape/profile.hpp)");
  static_assert(
      requires { double{S::uneven_edge}; },
      "a shape function lacks `uneven_edge`: half sizes of particles by which those at a boundary may lie behind it");
  static_assert(
      requires { double{S::reach(0.5)}; },
      "a shape function lacks `reach(half_size)`: cells from a particle to the furthest node of its stencil");
  /// Functions with domains are computed from their corners (shape/domain.hpp).
  static constexpr bool has_weights = [] {
    if constexpr (requires { bool{S::has_domains}; }) {
      if (S::has_domains) return true;
    }
    return requires { S::weights(Pack{}, 0.5, 1., static_cast<Pack*>(nullptr), static_cast<Pack*>(nullptr)); };
  }();
  static_assert(has_weights, "a shape function lacks `weights(f, half_size, inverse_cell, N, dN)`: values and slopes at its nodes");
};

/// Do the members fit each other?
template <class S>
struct HasFittingStencil {
  static constexpr double reach = S::reach(largest_half_extent);
  static_assert(S::width >= 2 && S::below >= 0 && S::below < S::width,
                "the stencil of a shape function must hold the node of the particle's bin");
  static_assert(S::below + 1 - S::bin_shift >= reach,
                "a shape function reaches a node below its stencil: `below`, `bin_shift` and `reach` do not fit");
  static_assert(S::width - S::below - 1 + S::bin_shift >= reach,
                "a shape function reaches a node above its stencil: `width`, `below`, `bin_shift` and `reach` do not fit");
  // Particles that see two nodes beyond a face or a plane would need a second image (step/folded_pairs.hpp).
  static_assert(reach <= 2,
                "a shape function reaches further than two cells: pairs fold at faces and symmetry planes one node beyond only");
  static_assert(S::boxes.reach(largest_half_extent) == reach, "`reach` of a shape function is not that of its `boxes`");
};

/// CompleteShapeFunction<S>::value is true, or does not compile.
template <class S>
struct CompleteShapeFunction : std::true_type {
  static_assert(std::is_empty_v<HasShapeMembers<S>>);
  static_assert(std::is_empty_v<HasFittingStencil<S>>);
};

/// Has particles before a face or a plane of nodes that see a node beyond it.
template <class S>
inline constexpr bool sees_beyond_faces = S::reach(largest_half_extent) > 1;
/// Cells beside its own whose nodes a particle may reach, on either side.
template <class S>
inline constexpr int cells_beyond = (S::width - 1) / 2;

}  // namespace crampon
