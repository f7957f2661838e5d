#pragma once
/// The faces that meet at a node.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "crampon/contact/contact_model.hpp"
#include "crampon/contact/node_facts.hpp"

namespace crampon {

/// One group, or all deformable ones on the same sides of all cracks, with what Task 1 left of them.
template <int Dim>
struct Face {
  GroupSet groups = 0;
  GroupSet company = 0;  ///< all groups of particles at the node, its own too
  Signature cracks;
  double m = 0;                         ///< kg; of rigid bodies the volume
  double volume = 0;                    ///< m3; in 2D m2
  Vec<Dim> x, X, g;                     ///< sums of m (x - x_i), m (X - x_i), V_p G_ip
  double history = 0;                   ///< sum of m c
  std::uint16_t field = 0;              ///< the one with most volume: its laws hold
  std::uint16_t lowest_field = 0xffff;  ///< of its parts
  std::uint16_t known_as = 0xffff;      ///< field by which contact remembers the face: it stays when parts of a bonded group come and go
  double field_volume = -1;
  bool rigid = false;
  bool ignores_cracks = false;  ///< meets faces on all sides of cracks

  void add(const Face& b) {
    groups |= b.groups;
    company |= b.company;
    m += b.m;
    volume += b.volume;
    x += b.x;
    X += b.X;
    g += b.g;
    history += b.history;
    lowest_field = std::min(lowest_field, b.lowest_field);
    known_as = std::min(known_as, b.known_as);
    if (b.field_volume > field_volume) field = b.field, field_volume = b.field_volume;
  }
};

/// The node at which faces meet. On a symmetry plane it sees the images too, as in the whole body: faces and points are with their images,
/// and what a pair gets is the part of the model.
template <int Dim>
struct MeetingPlace {
  std::int64_t number = 0;  ///< in the grid
  double volume = 0;        ///< of all faces there, m3; in 2D m2
  Mirrors mirrors;
  const std::vector<CloudPoint<Dim>>* points = nullptr;
};

/// The faces of a node by group, with their images. Overwrites `faces`.
template <int Dim>
void find_faces(const NodeFacts<Dim>& node, const ContactModel<Dim>& contact, std::vector<Face<Dim>>& faces);

}  // namespace crampon
