#include "crampon/step/rigid_motion.hpp"

#include <Eigen/Geometry>

namespace crampon {

namespace {

template <int Dim>
Vec<Dim> velocity_of(const RigidBody<Dim>& body, double t) {
  Vec<Dim> v;
  for (std::size_t k = 0; k < body.velocity.size(); ++k) v[k] = body.velocity[k](t, {});
  return v;
}

template <int Dim>
Spin spin_of(const RigidBody<Dim>& body, double t) {
  Spin w;
  if (body.spin.size() == 1) w[2] = body.spin[0](t, {});
  for (std::size_t k = 0; k < body.spin.size() && body.spin.size() == 3; ++k) w[k] = body.spin[k](t, {});
  return w;
}

/// The turn by the angle vector a after `turn`.
template <int Dim>
Turn<Dim> turned(const Turn<Dim>& turn, const Spin& a) {
  const double angle = norm(a);
  if (angle == 0) return turn;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, Eigen::Vector3d(a[0], a[1], a[2]) / angle).toRotationMatrix();
  Eigen::Matrix<double, Dim, Dim> old;
  for (int i = 0; i < Dim; ++i) {
    for (int k = 0; k < Dim; ++k) old(i, k) = turn[i][k];
  }
  Eigen::Matrix<double, Dim, Dim> next = R.topLeftCorner<Dim, Dim>() * old;
  // Steps by the million: what round-off adds to lengths and angles is taken back.
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < i; ++j) next.row(i) -= next.row(i).dot(next.row(j)) * next.row(j);
    next.row(i).normalize();
  }
  Turn<Dim> out{};
  for (int i = 0; i < Dim; ++i) {
    for (int k = 0; k < Dim; ++k) out[i][k] = next(i, k);
  }
  return out;
}

/// The place of a body after it has moved on for `span` from a time, by Simpson's rule.
template <int Dim>
RigidPose<Dim> moved(RigidPose<Dim> pose, const RigidBody<Dim>& body, double from, double span) {
  const auto integrated = [&](auto rate) {
    return (rate(body, from) + rate(body, from + 0.5 * span) * 4. + rate(body, from + span)) * (span / 6);
  };
  pose.centre += integrated(velocity_of<Dim>);
  pose.turn = turned<Dim>(pose.turn, integrated(spin_of<Dim>));
  return pose;
}

}  // namespace

template <int Dim>
void start_rigid_motion(State<Dim>& state, const Model<Dim>& model, double dt) {
  const double t = state.clock.time, lead = position_lead(model, dt);
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const RigidBody<Dim>& body = model.rigid_bodies[b];
    auto& [start, end, present, present_end] = state.rigid[b];
    present_end = moved(present, body, t, dt);
    start = moved(present, body, t, lead);
    start.velocity = velocity_of(body, t);
    start.spin = spin_of(body, t);
    start.pivot = present.centre;
    end = moved(present_end, body, t + dt, lead);
    end.velocity = velocity_of(body, t + dt);
    end.spin = spin_of(body, t + dt);
    end.pivot = present_end.centre;
  }
}

template void start_rigid_motion<2>(State<2>&, const Model<2>&, double);
template void start_rigid_motion<3>(State<3>&, const Model<3>&, double);

}  // namespace crampon
