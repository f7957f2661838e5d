#pragma once
/// How two fields of a node face each other: normal, gap and area (N13 sec. 3 step 1; docs/theory/contact.md, detection and normals).

#include <optional>
#include <utility>
#include <vector>

#include "crampon/contact/corner.hpp"
#include "crampon/contact/node_solve.hpp"
#include "crampon/contact/normal.hpp"
#include "crampon/contact/outline_gap.hpp"
#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// The symmetry planes on which a node lies.
struct Mirrors {
  unsigned axes = 0;  ///< bit k: one across axis k
  double images = 1;  ///< how many times what the model has is there

  /// A vector and its image together: the component across is gone.
  template <int Dim>
  Vec<Dim> together(Vec<Dim> a) const {
    for (int k = 0; k < Dim; ++k) a[k] *= axes >> k & 1u ? 0. : images;
    return a;
  }
  /// The mean of both.
  template <int Dim>
  Vec<Dim> mean(Vec<Dim> a) const {
    for (int k = 0; k < Dim; ++k) a[k] *= axes >> k & 1u ? 0. : 1.;
    return a;
  }
};
template <int Dim>
Mirrors mirrors_at(const Model<Dim>& model, std::int64_t node_number);

/// What Task 1 left at a node about one crack: unit normals now and at the start, and the side of the particles across.
template <int Dim>
struct CrackAtNode {
  CrackId crack = 0;
  Vec<Dim> n, N;
  double side = 0;
};

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
  bool whole = false;  ///< meets faces on all sides of cracks

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

/// The node at which they meet. On a symmetry plane it sees the images too, as in the whole body: faces and points are with their images,
/// and what the pair gets is the part of the model.
template <int Dim>
struct MeetingPlace {
  std::int64_t number = 0;  ///< in the grid
  Vec<Dim> x;               ///< m
  double volume = 0;        ///< of all faces there, m3; in 2D m2
  Mirrors mirrors;
  const std::vector<CloudPoint<Dim>>* points = nullptr;
};

template <int Dim>
class FaceToFace {
 public:
  FaceToFace(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model);

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

  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::vector<LabelledPoint<Dim>> labelled_;
  std::vector<OutlinedParticle<Dim>> outlined_;
  std::vector<OutlinedPoint<Dim>> corner_points_;
};

}  // namespace crampon
