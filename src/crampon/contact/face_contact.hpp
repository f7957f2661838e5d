#pragma once
/// Contact of bodies with the faces of rigid ones (docs/theory/contact.md, rigid faces). A face lies among the nodes of a body; what the body feels
/// of it is the contact of all of them together, by the nodes' own parts of the face.

#include <cstdint>
#include <vector>

#include "crampon/contact/node_solve.hpp"

namespace crampon {

/// What moves as one at a node, and meets a rigid face.
template <int Dim>
struct FaceGroup {
  std::uint16_t node = 0;                      ///< local node of its block
  std::uint32_t first_slot = 0, end_slot = 0;  ///< of its fields, in FaceNodes::slots
  int contact_group = -1;   ///< the same among the groups of the block's nodes with several (ContactNodes); -1: it is alone there
  Vec<Dim> x;               ///< of the node, m
  double m = 0;             ///< kg
  Vec<Dim> before, v;       ///< before contact of this task and now, m/s
  Vec<Dim> dp;              ///< impulse of all faces in this task, kg m/s
  unsigned fixed_axes = 0;  ///< bit k: component k is prescribed and not changed in this task
  ContactAccount<Dim> account;
};

/// Its part in the contact with one face.
template <int Dim>
struct FacePart {
  std::uint32_t group = 0;                         ///< in FaceNodes::groups of the block
  std::uint16_t body = 0;                          ///< rigid body
  std::uint8_t axis = 0;                           ///< of the column of nodes to which it belongs: along which the face's normal is longest
  bool up = false;                                 ///< the normal into the rigid body points up this axis
  std::int64_t column = 0;                         ///< number of the column's node at 0 of this axis
  int row = 0;                                     ///< in the column
  std::uint16_t known_as = 0;                      ///< field by which contact remembers the material
  std::uint16_t field = 0;                         ///< the one with most volume: its law holds
  Signature cracks;                                ///< that part the material from the node
  unsigned mirror_axes = 0;                        ///< bit k: it lies on a symmetry plane across axis k
  Vec<Dim> gradient;                               ///< sum of V_p G_ip: out of the material, m2 (in 2D m)
  double w = 0;                                    ///< the node's part of the face: of its gradient along the normal
  double history = 0;                              ///< sum of m_p S_ip c
  std::uint32_t first_sample = 0, end_sample = 0;  ///< in FaceNodes::samples
  Vec<Dim> dp;                                     ///< impulse in this task, kg m/s
  ContactAccount<Dim> of_rigid;
};

/// A particle before the face.
template <int Dim>
struct FaceSample {
  double S = 0;       ///< S_ip
  double gap = 0;     ///< of its body's surface from the face, m
  Vec<Dim> n;         ///< unit normal into the rigid body
  bool edge = false;  ///< it is before an edge of the rigid body
};

/// Those of one block.
template <int Dim>
struct FaceNodes {
  std::vector<FaceGroup<Dim>> groups;
  std::vector<std::size_t> slots;  ///< in the nodal arrays
  std::vector<FacePart<Dim>> parts;
  std::vector<FaceSample<Dim>> samples;
  void clear() {
    groups.clear();
    slots.clear();
    parts.clear();
    samples.clear();
  }
};

/// The contact of one column of nodes with a face.
template <int Dim>
struct ContactColumn {
  std::int64_t name = 0;             ///< by which contact remembers it: below zero, as nodes are not
  ContactPair<Dim> pair;             ///< a: the material, b: the rigid body
  double w = 0;                      ///< sum over its parts
  Vec<Dim> w_now;                    ///< velocity of the rigid body against the material after this task, m/s
  std::uint32_t first = 0, end = 0;  ///< in FaceContacts::parts
  std::uint16_t body = 0;
};

/// All of a step.
template <int Dim>
struct FaceContacts {
  struct PartAt {
    std::uint32_t block = 0, part = 0;
  };
  std::vector<PartAt> parts;                ///< by columns
  std::vector<ContactColumn<Dim>> columns;  ///< those that share nodes beside each other
  std::vector<std::uint32_t> first_column;  ///< of each set that shares nodes, and the end
};

}  // namespace crampon
