#pragma once
/// Bodies of the input as particles.

#include <array>

#include "crampon/input/problem.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// A particle before the engine's layout: as the body states it.
template <int Dim>
struct NewParticle {
  Vec<Dim> x, v;                ///< m, m/s
  double volume = 0, mass = 0;  ///< m3, kg
  std::uint32_t material = 0;   ///< index into Model::materials
  std::uint16_t body = 0;
  Vec<Dim> surface;  ///< from x to the nearest point of its body's surface, as Model::surface has it, m
};

/// Particles further than this from the surface of their body lie deep in it, m.
template <int Dim>
double depth_of_surface(const Grid<Dim>& grid, const std::array<int, Dim>& per_cell) {
  double square = 0;
  for (std::size_t k = 0; k < Dim; ++k) square += grid.cell[k] * grid.cell[k] / (per_cell[k] * per_cell[k]);
  return 0.75 * std::sqrt(square);
}

/// What the bodies of a problem come to. Particles in the order of bodies, and within a body as filled or as in its file: their ids.
template <int Dim>
struct BuiltBodies {
  std::vector<NewParticle<Dim>> particles;
  std::vector<Material<Dim>> materials;        ///< one for every combination of law, thickness, particle size and velocity field
  std::vector<MaterialField> fields;           ///< velocity fields in the order in which bodies name them; rigid bodies after them
  std::vector<RigidBody<Dim>> rigid_bodies;    ///< with particles, then walls
  std::vector<std::string> names;              ///< of bodies, then of rigid bodies with particles
  std::vector<std::array<int, Dim>> per_cell;  ///< per body
  std::vector<bool> on_lattice;                ///< per body: filled, not from a file
};

/// Errors are added to `errors`; the result is then incomplete.
template <int Dim>
BuiltBodies<Dim> build_bodies(const Problem& problem, const Grid<Dim>& grid, std::vector<Diagnostic>& errors);

/// A point of the problem as three coordinates.
template <int Dim>
Vec<3> in_space(const Vec<Dim>& x) {
  Vec<3> out;
  for (int k = 0; k < Dim; ++k) out[k] = x[k];
  return out;
}

}  // namespace crampon
