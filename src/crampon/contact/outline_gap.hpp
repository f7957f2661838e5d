#pragma once
/// Distance of two bodies at a node from the outlines of their particles, whatever piece of the faces the node sees.

#include <array>
#include <span>

#include "crampon/contact/normal.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

/// A particle as a (deformed) box.
template <int Dim>
struct OutlinedParticle {
  Vec<Dim> x;                              ///< its middle, from the node, m
  std::array<Vec<Dim>, Dim> half_edges{};  ///< from its middle to the middles of its faces, m
  double weight = 1;                       ///< its part in the node, kg
  ContactSide side = ContactSide::a;
  Vec<Dim> to_surface{};  ///< from its middle to the nearest point of its body's surface, m; zero or not a number: nobody knows one near
};

/// Gap between a and b, m; negative when they overlap. Two bodies are as far apart as any direction shows their outlines: of `directions` (any
/// length and sign; zeros are left out), of the normals of their surfaces, of the sides of both bodies' particles in the mean, and of some on the way
/// to their closest points, the one that shows most counts. Outlines are points of surfaces, and corners of particles that these do not cut off.
/// Exact for flat faces whose surface is known, and for those with particles in rows along them, up to their ends; elsewhere a staircase of
/// particles reads as close as its teeth come.
template <int Dim>
double outline_gap(std::span<const OutlinedParticle<Dim>> particles, std::span<const Vec<Dim>> directions);

}  // namespace crampon
