#pragma once
/// How the surfaces of bodies face rigid ones: gaps and normals before particles (docs/theory/contact.md, rigid faces).

#include <optional>
#include <vector>

#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

template <int Dim>
class FaceSampler {
 public:
  FaceSampler(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model) : state_(state), work_(work), model_(model) {}

  /// Adds samples for a part of a face to `out`: of the particles `points` of its group, or where nobody knows their surface, one of the group.
  /// slots: FaceNodes::slots of the block.
  void sample(const FaceGroup<Dim>& group, const std::size_t* slots, const FacePart<Dim>& part, const std::vector<CloudPoint<Dim>>& points,
              std::vector<FaceSample<Dim>>& out) const;

 private:
  void sample_particles(const FacePart<Dim>& part, const std::vector<CloudPoint<Dim>>& points, std::vector<FaceSample<Dim>>& out) const;
  void sample_sums(const FaceGroup<Dim>& group, const std::size_t* slots, const FacePart<Dim>& part,
                   std::vector<FaceSample<Dim>>& out) const;
  RigidFaceView<Dim> see(const FacePart<Dim>& part, const Vec<Dim>& x) const;
  template <class Along>
  std::optional<FaceSample<Dim>> before_face(const FacePart<Dim>& part, const Vec<Dim>& x, const Vec<Dim>& to_surface, Along along) const;

  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
};

}  // namespace crampon
