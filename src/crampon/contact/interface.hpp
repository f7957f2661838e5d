#pragma once
/// Imperfect interfaces (Nairn, CMES 92 (2013) 271): springs between two fields at a node (docs/theory/contact.md, interfaces).

#include "crampon/contact/node_solve.hpp"
#include "crampon/contact/response.hpp"

namespace crampon {

/// An interface has failed at a node when the mean damage of the particles beside it exceeds this number. A node at which it fails gives
/// damage to each particle about it, in the measure of its weight among the particle's nodes in contact. What the node reads back is the
/// mean of this measure, weighted by S_ip: .55 to .67 for each direction along the face. The limit is below that.
template <int Dim>
inline constexpr double interface_failed = Dim == 2 ? 0.5 : 0.25;

/// Is the pair an interface that has not failed?
template <int Dim>
bool holds_as_interface(const ContactPair<Dim>& pair) {
  return pair.law->has_springs() && pair.history < interface_failed<Dim>;
}

/// A spring of stiffness D A between two masses, of reduced mass m. Too stiff for the step (w dt > 2): held.
struct InterfaceSpring {
  double phi_squared = 0;  ///< D A dt^2/m
  bool stiff() const { return !(phi_squared <= 4); }

  /// Relative velocity that the spring leaves: w* with forces but without it, w before them, displacement u. An added mass of a quarter of
  /// D A dt^2 against changes of the relative velocity makes it stable up to any stiffness together with positions that advance with
  /// the new velocity; it keeps the energy of the oscillation and the static displacement. Held springs close a tenth of u a step.
  double next(double w_star, double w, double u, double dt) const {
    if (stiff()) return -0.1 * u / dt;
    return w + ((w_star - w) - phi_squared * u / dt) / (1 + 0.25 * phi_squared);
  }
};

/// Normal and tangential springs of a pair.
template <int Dim>
struct InterfaceSprings {
  double u_n = 0;
  Vec<Dim> u_t;
  double D_n = 0, D_t = 0;
  InterfaceSpring normal, tangential;

  /// The side of the normal law is that of the displacement at the middle of the step.
  InterfaceSprings(const ContactPair<Dim>& pair, double m, double dt) {
    const ContactSprings& law = pair.law->springs();
    u_n = dot(pair.opening, pair.n);
    u_t = pair.opening - pair.n * u_n;
    D_n = u_n + 0.5 * dt * dot(pair.w_settled, pair.n) > 0 ? law.tension : law.compression;
    D_t = law.tangential;
    normal.phi_squared = D_n == 0 ? 0 : D_n * pair.area * dt * dt / m;
    tangential.phi_squared = D_t == 0 ? 0 : D_t * pair.area * dt * dt / m;
  }
};

/// Task 2: only what is held is made to move together. Task 4: all. Task 6: what is held moves together, the other springs as Task 4 has
/// left them. Positions move as Task 4 has left them in any case (find_drift in step/verbs/adjust_contact.cpp).
template <int Dim>
Response<Dim> interface_response(const ContactRules& rules, ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  const ContactSprings& law = pair.law->springs();
  const InterfaceSprings<Dim> springs(pair, m, rules.dt);
  const double w_n = dot(w, pair.n);
  const Vec<Dim> w_t = w - pair.n * w_n;
  Response<Dim> out;
  // A one-sided hold does not pull.
  const bool one_sided = law.tension == 0 && springs.u_n <= 0;
  if (rules.task == ContactTask::six) {
    const double settled_n = dot(pair.w_settled, pair.n);
    const bool closed = springs.normal.stiff() && !(one_sided && settled_n > 0);
    const Vec<Dim> to_t = springs.tangential.stiff() ? Vec<Dim>{} : pair.w_settled - pair.n * settled_n;
    out.aside = pair.n * (m * ((closed ? 0 : settled_n) - w_n)) + (to_t - w_t) * m;
    out.J = out.aside;
    return out;
  }
  if (rules.task == ContactTask::two) {
    const bool closed = springs.normal.stiff() && springs.D_n != 0;
    if (closed && !(one_sided && w_n > 0)) out.push(pair.n, m, w_n, 0);
    if (springs.tangential.stiff()) out.stick(w_t * m);
    return out;
  }
  double to = springs.normal.next(w_n, dot(pair.w_settled, pair.n), springs.u_n, rules.dt);
  if (springs.u_n <= 0 && law.tension == 0 && to < w_n) to = w_n;  // a face that only presses lets go
  // Closing beyond touch where compression is not borne at all, whatever the tension does.
  const bool hard = !(law.compression * pair.area * rules.dt * rules.dt / m <= 4) && law.compression != 0;
  if (hard && springs.u_n > 0) to = std::fmax(to, -springs.u_n / rules.dt);
  const Vec<Dim> u_t = springs.u_t, w_0 = pair.w_settled - pair.n * dot(pair.w_settled, pair.n);
  Vec<Dim> to_t;
  for (int k = 0; k < Dim; ++k) to_t[k] = springs.tangential.next(w_t[k], w_0[k], u_t[k], rules.dt);
  out.aside = pair.n * (m * (to - w_n)) + (to_t - w_t) * m;
  out.J = out.aside;
  pair.state = ContactState::open;  // springs remember by displacement, not by state
  return out;
}

/// Energy in the springs at the end of the step, J; held ones keep none.
template <int Dim>
double interface_energy(const ContactPair<Dim>& pair, double m, const Vec<Dim>& w_end, double dt) {
  const InterfaceSprings<Dim> springs(pair, m, dt);
  const Vec<Dim> u = pair.opening + w_end * dt;
  const double u_n = dot(u, pair.n);
  const ContactSprings& law = pair.law->springs();
  const double D_n = u_n > 0 ? law.tension : law.compression;
  double energy = 0;
  if (!springs.normal.stiff() && std::isfinite(D_n)) energy += 0.5 * D_n * pair.area * u_n * u_n;
  if (!springs.tangential.stiff()) energy += 0.5 * springs.D_t * pair.area * (dot(u, u) - u_n * u_n);
  return energy;
}

/// (S/S_c)^2 + (N/N_c)^2 of the tractions that the impulse of Task 4 stands for.
template <int Dim>
double interface_load(const ContactPair<Dim>& pair, double dt) {
  const ContactSprings& law = pair.law->springs();
  if (!law.can_fail() || !(pair.area > 0)) return 0;
  const double J_n = dot(pair.J, pair.n), scale = 1 / (pair.area * dt);
  const double N = std::fmax(-J_n, 0.) * scale, S = norm(pair.J - pair.n * J_n) * scale;
  double load = 0;
  if (law.normal_strength) load += N * N / (*law.normal_strength * *law.normal_strength);
  if (law.shear_strength) load += S * S / (*law.shear_strength * *law.shear_strength);
  return load;
}

}  // namespace crampon
