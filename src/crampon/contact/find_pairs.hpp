#pragma once
/// Which fields of a node face each other (N13 sec. 2.3, 3; docs/theory/contact.md, who meets whom).

#include <vector>

#include "crampon/contact/face_to_face.hpp"
#include "crampon/contact/node_facts.hpp"
#include "crampon/contact/node_solve.hpp"
#include "crampon/state/contact_memory.hpp"

namespace crampon {

/// At which nodes a run asks for the particles about them one by one (NodeFacts::cloud), because sums at the nodes do not tell what is asked.
struct CloudsWanted {
  bool among_materials = false;  ///< at nodes of several material fields
  bool across_cracks = false;    ///< at all nodes with several velocity fields
};
template <int Dim>
CloudsWanted clouds_wanted(const ContactModel<Dim>& contact, const Grid<Dim>& grid);

/// Are gaps those of the particles' outlines, one by one? In cells of unequal sides what a node sees of an oblique face depends too much on
/// where the face ends for mean positions to tell.
template <int Dim>
bool outlines_tell(ContactDetection detection, const Grid<Dim>& grid) {
  return detection == ContactDetection::regression || (detection == ContactDetection::position && !grid.has_even_cells());
}

/// Finds the pairs of one node after another. Keeps its memory from node to node.
template <int Dim>
class PairFinder {
 public:
  /// \param first_step  pairs whose law adheres, and whose faces touch, are glued from the start
  /// All arguments must outlive it.
  PairFinder(const ContactModel<Dim>& contact, const Grid<Dim>& grid, const ContactMemory& memory, bool first_step)
      : contact_(contact), grid_(grid), memory_(memory), first_step_(first_step), face_to_face_(contact, grid, memory) {}

  /// The pairs of materials, then those across cracks, then those with bodies that no crack parts; valid until the next call. Completes the
  /// cloud of the node: gives its points their groups, and adds their images.
  const std::vector<ContactPair<Dim>>& find(NodeFacts<Dim>& node);

 private:
  void complete_cloud(NodeFacts<Dim>& node) const;
  void pair_materials();
  void pair_with_virtual(std::size_t a);
  void pair_ignoring_cracks();
  void pair_faces(const Face<Dim>& a, const Face<Dim>& b, const Face<Dim>* facing = nullptr);
  void pair_sides();
  bool face_each_other(std::size_t g, std::size_t h) const;
  void pair_across(const Face<Dim>& g, const Face<Dim>& h);
  ContactState previous_state(const ContactPair<Dim>& pair) const;

  const ContactModel<Dim>& contact_;
  const Grid<Dim>& grid_;
  const ContactMemory& memory_;
  bool first_step_;
  FaceToFace<Dim> face_to_face_;
  // Of the node at hand.
  const NodeFacts<Dim>* node_ = nullptr;
  MeetingPlace<Dim> place_;
  std::vector<Face<Dim>> faces_;  ///< by group
  std::vector<Face<Dim>> sides_;  ///< by sides of cracks
  std::vector<ContactPair<Dim>> pairs_;
};

}  // namespace crampon
