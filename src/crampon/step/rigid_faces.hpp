#pragma once
/// Faces of rigid bodies as points about them see them: by the body's shape, wherever the body is.

#include "crampon/state/rigid.hpp"
#include "crampon/step/model.hpp"
#include "crampon/step/step_work.hpp"

namespace crampon {

/// Normals that differ by less than this (cosine) are those of one face.
constexpr double of_one_face = 0.9;

/// A point as the body had it at the start, m.
template <int Dim>
Vec<3> in_body(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x) {
  const Vec<Dim> arm = x - pose.centre;
  Vec<3> there;
  for (std::size_t j = 0; j < Dim; ++j) {
    there[j] = body.centre[j];
    for (std::size_t k = 0; k < Dim; ++k) there[j] += pose.turn[k][j] * arm[k];
  }
  return there;
}

/// Of x from the body's surface, m; negative inside.
template <int Dim>
double distance_from(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x) {
  return body.shape->distance(in_body(body, pose, x));
}

/// The surface as a point sees it.
template <int Dim>
struct RigidFaceView {
  double distance = 0;  ///< of the point outside the body, m; negative inside
  Vec<Dim> out;         ///< unit normal out of the body; zero where there is none (the centre of a disk)
};

template <int Dim>
RigidFaceView<Dim> see_face(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x) {
  const Vec<3> there = in_body(body, pose, x);
  const Vec<3> out = body.shape->outward(there);
  RigidFaceView<Dim> view;
  view.distance = body.shape->distance(there);
  for (std::size_t k = 0; k < Dim; ++k) {
    for (std::size_t j = 0; j < Dim; ++j) view.out[k] += pose.turn[k][j] * out[j];
  }
  return view;
}

/// Is the point that x takes for the nearest of the surface on it? Distances of combined shapes may be those of a part's face that another part has cut away.
template <int Dim>
bool is_surface(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x, const RigidFaceView<Dim>& view, double cell) {
  return std::fabs(distance_from(body, pose, x - view.out * view.distance)) <= 1e-6 * cell;
}

/// By how much the normal that x sees turns along the face, rad/m: 1/(R + d) at a distance d from a face of radius R, 1/d before an edge. The
/// most along the axes of the grid, by a difference over `step`, m, which may be negative.
template <int Dim>
double turn_along_face(const RigidBody<Dim>& body, const RigidPose<Dim>& pose, const Vec<Dim>& x, const RigidFaceView<Dim>& view,
                       double step) {
  double most = 0;
  for (int k = 0; k < Dim; ++k) {
    Vec<Dim> along;
    along[k] = 1;
    along -= view.out * dot(along, view.out);
    if (norm(along) < 0.5) continue;
    along = normalized(along);
    most = std::fmax(most, norm(see_face(body, pose, x + along * step).out - view.out) / std::fabs(step));
  }
  return most;
}

/// From a node to the furthest face whose body the node's shape function may see, m: `reach` in cells along an axis, n the face's unit normal.
template <int Dim>
double reach_across(const Grid<Dim>& grid, double reach, const Vec<Dim>& n) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) sum += std::fabs(n[k]) * grid.cell[k];
  return reach * sum;
}

/// No node further than this from a face, m, belongs to a contact there.
template <int Dim>
double longest_reach(const Model<Dim>& model) {
  double square = 0;
  for (int k = 0; k < Dim; ++k) square += model.grid.cell[k] * model.grid.cell[k];
  return (boxes_of(model.shape_functions).reach_of_sums() + 0.5) * std::sqrt(square);
}

/// Is x, m, nearer than `reach`, m, to the face of a body that others meet by its shape, or inside?
template <int Dim>
bool is_near_rigid_face(const State<Dim>& state, const Model<Dim>& model, const Vec<Dim>& x, double reach) {
  for (std::size_t r = 0; r < model.rigid_bodies.size(); ++r) {
    const RigidBody<Dim>& body = model.rigid_bodies[r];
    if (body.acts == RigidBody<Dim>::Acts::face && distance_from(body, state.rigid[r].start, x) < reach) return true;
  }
  return false;
}

}  // namespace crampon
