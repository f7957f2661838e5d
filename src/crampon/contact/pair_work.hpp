#pragma once
/// Friction of a pair in contact over a step: its impulse, its work, and the distance slipped (docs/theory/contact.md, energy).

#include <cmath>

#include "crampon/contact/interface.hpp"
#include "crampon/contact/node_solve.hpp"

namespace crampon {

/// What Task 4 has given along the face where it slips.
template <int Dim>
Vec<Dim> rubbing(const ContactPair<Dim>& pair) {
  if (pair.state != ContactState::slip || holds_as_interface(pair)) return {};
  return pair.J - pair.n * dot(pair.J, pair.n);
}

/// Work that friction takes in a step: its impulse times the mean slip (docs/theory/contact.md, energy). The slip is that of the particles,
/// which carry the mass, in the mean about the node: w_start before and `w_end` after they have moved. Nodal velocities of Task 4 grow
/// without bound where a node holds little mass; what particles take of them does not.
template <int Dim>
double friction_work(const ContactPair<Dim>& pair, const Vec<Dim>& w_end) {
  const double share = pair.is_virtual() ? 0.5 : 1;  // there every face is met from both of its sides
  return share * std::fmax(-0.5 * dot(pair.rubbing, pair.w_start + w_end), 0.);
}

/// The distance that a pair whose law remembers slip has slipped in the step, after Task 4 has left w, m/s.
template <int Dim>
void note_slip(ContactPair<Dim>& pair, const Vec<Dim>& w, double dt) {
  if (pair.law->remembers() != Remembered::slip || pair.state != ContactState::slip) return;
  const Vec<Dim> mean = (w + pair.w_settled) * 0.5;
  pair.history_gain = norm(mean - pair.n * dot(mean, pair.n)) * dt;
}

}  // namespace crampon
