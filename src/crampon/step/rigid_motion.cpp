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

}  // namespace

template <int Dim>
void start_rigid_motion(State<Dim>& state, const Model<Dim>& model, double dt) {
  const double t = state.time;
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const RigidBody<Dim>& body = model.rigid_bodies[b];
    RigidPose<Dim>&start = state.rigid[b].start, &end = state.rigid[b].end;
    start.velocity = velocity_of(body, t);
    start.spin = spin_of(body, t);
    end.velocity = velocity_of(body, t + dt);
    end.spin = spin_of(body, t + dt);
    end.centre = start.centre + (start.velocity + velocity_of(body, t + 0.5 * dt) * 4. + end.velocity) * (dt / 6);
    end.turn = turned<Dim>(start.turn, (start.spin + spin_of(body, t + 0.5 * dt) * 4. + end.spin) * (dt / 6));
  }
}

template <int Dim>
void end_rigid_motion(State<Dim>& state) {
  for (RigidMotion<Dim>& motion : state.rigid) motion.start = motion.end;
}

#define CRAMPON_INSTANTIATE(DIM)                                                 \
  template void start_rigid_motion<DIM>(State<DIM>&, const Model<DIM>&, double); \
  template void end_rigid_motion<DIM>(State<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
