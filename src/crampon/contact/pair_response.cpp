#include "crampon/contact/pair_response.hpp"

#include <cmath>

#include "crampon/contact/interface.hpp"

namespace crampon {

namespace {

/// What is known of a pair before its law speaks.
template <int Dim>
Sliding sliding_of(const ContactRules& rules, const ContactPair<Dim>& pair, double m) {
  return {0, 0, m, rules.dt, pair.area, pair.history};
}

/// No detection (conventions 44). Such pairs are there only when pairs are done one after another or one is rigid; else bonded fields are
/// one group.
template <int Dim>
Response<Dim> bonded_response(const ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  Response<Dim> out;
  const double w_n = dot(w, pair.n);
  out.push(pair.n, m, w_n, 0);
  out.stick((w - pair.n * w_n) * m);
  return out;
}

/// Does glue between faces that have met hold?
template <int Dim>
bool glue_holds(const ContactRules& rules, const ContactPair<Dim>& pair, double m, double w_n, const Vec<Dim>& D_t) {
  return pair.law->adheres() && pair.law->holds({m * w_n, norm(D_t), rules.dt, pair.area});
}

/// A term of a series for velocities: what Task 4 found to touch does not part by it, what stuck does not slip, and the springs of an interface
/// keep the stretch that they have found.
template <int Dim>
Response<Dim> term_response(const ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  if (holds_as_interface(pair)) return bonded_response(pair, m, w);
  Response<Dim> out;
  if (pair.state == ContactState::open) return out;
  const double w_n = dot(w, pair.n);
  out.push(pair.n, m, w_n, 0);
  if (pair.state == ContactState::stick) out.stick((w - pair.n * w_n) * m);
  return out;
}

/// The papers' rule, anew in each task (N03 section 2.2, N13 section 3).
template <int Dim>
Response<Dim> literal_response(const ContactRules& rules, ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  const double w_n = dot(w, pair.n);
  const Vec<Dim> D_t = (w - pair.n * w_n) * m;
  bool touching = false;
  if (rules.by_volume(pair.name) && !pair.by_gap) {
    if (pair.volume_ratio > rules.volume_contact) {
      touching = w_n < 0 || !rules.require_approach;
    } else if (pair.volume_ratio >= rules.volume_separated) {
      touching = w_n < 0;
    }
  } else {
    touching = w_n < 0 && pair.gap + w_n * rules.dt < 0;
  }
  Response<Dim> out;
  if (touching && w_n != 0) {
    out.push(pair.n, m, w_n, 0);
    out.rub(*pair.law, D_t, sliding_of(rules, pair, m));
  } else if (pair.previous != ContactState::open && glue_holds(rules, pair, m, w_n, D_t)) {
    out.push(pair.n, m, w_n, 0);
    out.stick(D_t);
  }
  if (rules.task == ContactTask::four)
    pair.state = !out.pushes ? ContactState::open : out.sticks ? ContactState::stick : ContactState::slip;
  return out;
}

/// The lagged, consistent active set (docs/theory/contact.md, the scheme).
template <int Dim>
Response<Dim> consistent_response(const ContactRules& rules, ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  const double w_n = dot(w, pair.n);
  const Vec<Dim> D_t = (w - pair.n * w_n) * m;
  const bool held = pair.previous != ContactState::open && pair.gap <= rules.stays_closed_within;
  const double gap = held ? std::fmin(pair.gap, 0.) : pair.gap;
  const double bound = -std::fmax(gap, 0.) / rules.dt;
  Response<Dim> out;
  // What Task 2 has stopped is zero but for round-off, which must not decide (MUSL and USL have no forces yet when bodies meet): neither
  // whether they touch, nor whether what has stuck slips.
  const double slack = rules.task == ContactTask::four ? 1e-12 * pair.met_at : 0;
  const auto test = [&] {
    if (w_n < bound + slack) {
      out.push(pair.n, m, w_n, bound);
      if (pair.stuck && norm(D_t) < slack * m) {
        out.stick(D_t);
      } else {
        out.rub(*pair.law, D_t, sliding_of(rules, pair, m));
      }
    } else if (held && glue_holds(rules, pair, m, w_n, D_t)) {
      out.push(pair.n, m, w_n, 0);
      out.stick(D_t);
    }
  };
  switch (rules.task) {
    case ContactTask::two:
      if (!held) {
        test();
      } else {
        out.push(pair.n, m, w_n, 0);
        if (pair.previous == ContactState::stick) out.stick(D_t);
      }
      if (out.pushes) pair.met_at = std::fmax(pair.met_at, norm(w));
      pair.stuck = out.sticks;
      break;
    case ContactTask::four:
      test();
      pair.state = !out.pushes ? ContactState::open : out.sticks ? ContactState::stick : ContactState::slip;
      break;
    case ContactTask::six: {
      if (pair.state == ContactState::open) break;
      const double least = std::fmin(pair.w_end, 0.);
      if (w_n > 0 || w_n < least) out.push(pair.n, m, w_n, w_n > 0 ? 0. : least);
      if (pair.state == ContactState::stick) out.stick(D_t);
      break;
    }
    case ContactTask::term:  // not by detection
      break;
  }
  return out;
}

}  // namespace

template <int Dim>
Response<Dim> respond(const ContactRules& rules, ContactPair<Dim>& pair, double m, const Vec<Dim>& w) {
  if (pair.law->bonds()) return bonded_response(pair, m, w);
  if (rules.task == ContactTask::term) return term_response(pair, m, w);
  if (holds_as_interface(pair)) return interface_response(rules, pair, m, w);
  return rules.literal ? literal_response(rules, pair, m, w) : consistent_response(rules, pair, m, w);
}

template Response<2> respond(const ContactRules&, ContactPair<2>&, double, const Vec<2>&);
template Response<3> respond(const ContactRules&, ContactPair<3>&, double, const Vec<3>&);

}  // namespace crampon
