#pragma once
/// How two fields of a node face each other: normal, gap and area (N13 sec. 3 step 1; docs/theory/contact.md, detection and normals).

#include <optional>
#include <utility>
#include <vector>

#include "crampon/contact/corner.hpp"
#include "crampon/contact/face.hpp"
#include "crampon/contact/normal.hpp"
#include "crampon/contact/outline_gap.hpp"
#include "crampon/state/contact_memory.hpp"
#include "crampon/state/grid.hpp"

namespace crampon {

template <int Dim>
class FaceToFace {
 public:
  /// All three must outlive it.
  FaceToFace(const ContactModel<Dim>& contact, const Grid<Dim>& grid, const ContactMemory& memory);

  /// These set normal, gap and area of a pair; false when there is no direction: nothing to hold against.
  /// Materials: `facing` gives law and normal, b itself or the most of what N13's virtual material b is made of.
  bool see_material(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, const Face<Dim>& facing,
                    ContactPair<Dim>& pair);
  /// A pair that see_material has seen: where one body fills a corner of the other, it becomes several, one for each face of the corner.
  void part_corner(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, std::vector<ContactPair<Dim>>& pairs);
  /// a above and b below a crack.
  bool see_across(const MeetingPlace<Dim>& place, const CrackAtNode<Dim>& crack, const Face<Dim>& a, const Face<Dim>& b,
                  ContactPair<Dim>& pair);

 private:
  std::pair<Face<Dim>, Face<Dim>> before(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b,
                                         const CornerFace<Dim>& face) const;
  void recall_history(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, ContactPair<Dim>& pair) const;
  double cell_volume() const;
  double thickness(const Face<Dim>& a, const Face<Dim>& b) const;
  double area_between(const Face<Dim>& a, const Face<Dim>& b, const Vec<Dim>& n) const;
  double area_on_rigid(const Face<Dim>& a, const Face<Dim>& b, double depth, const Vec<Dim>& n, const PlaneInCells& plane) const;
  double gap_of_outlines(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b, const Vec<Dim>& n);
  double relative_volume(const MeetingPlace<Dim>& place) const;
  double gap_by_volume(double volume_ratio) const;
  double gap(ContactDetection detection, const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b,
             const ContactPair<Dim>& pair, const Vec<Dim>& original_normal);
  std::optional<Vec<Dim>> regress(const MeetingPlace<Dim>& place, GroupSet a, GroupSet b);
  bool are_alone(const Face<Dim>& a, const Face<Dim>& b) const;
  Vec<Dim> normal_among_others(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b);
  Vec<Dim> found_normal(const MeetingPlace<Dim>& place, const Face<Dim>& a, const Face<Dim>& b);

  const ContactModel<Dim>& contact_;
  const Grid<Dim>& grid_;
  const ContactMemory& memory_;
  std::vector<LabelledPoint<Dim>> labelled_;
  std::vector<OutlinedParticle<Dim>> outlined_;
  std::vector<OutlinedPoint<Dim>> corner_points_;
};

}  // namespace crampon
