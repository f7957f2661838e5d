#include "crampon/step/transfer.hpp"

#include <cmath>

namespace crampon {

namespace {

template <class Transfer>
Declaration<Transfer> series(const char* name, const char* help) {
  return Declaration<Transfer>(name, help)
      .integer("order", &Transfer::order, Bounds::between(1, 20), "terms of the series; each beyond the first costs about half a step more")
      .integer("every", &Transfer::every, Bounds::at_least(1), "act in every so many steps, with FLIP in between");
}

template <class Transfer>
int terms_in(const Transfer& transfer, std::int64_t step) {
  return step % transfer.every == 0 ? transfer.order : 0;
}

}  // namespace

const Declaration<FlipTransfer>& FlipTransfer::declaration() {
  static const auto d =
      Declaration<FlipTransfer>("flip", "Particles add the accelerations of nodes to their own velocities (N03 Eq. 30).")
          .quantity("pic", &FlipTransfer::pic, "1", Bounds::between(0, 1),
                    "part of their velocity that particles take from nodes in each step instead: damps what nodes do not see, and more");
  return d;
}

const Declaration<XpicTransfer>& XpicTransfer::declaration() {
  static const auto d = series<XpicTransfer>(
      "xpic", "Particles take the velocities of nodes at the start of the step, filtered to some order, and add accelerations.");
  return d;
}

const Declaration<FmpmTransfer>& FmpmTransfer::declaration() {
  static const auto d =
      series<FmpmTransfer>("fmpm", "Particles take the velocities of nodes at the end of the step, filtered to some order.");
  return d;
}

const Family<TransferSpec>& transfers() {
  static Family<TransferSpec> family = [] {
    Family<TransferSpec> f("transfer", "kind", "How particles take up what nodes have found.");
    f.add(FlipTransfer::declaration()).add(XpicTransfer::declaration()).add(FmpmTransfer::declaration());
    return f;
  }();
  return family;
}

StepTransfer step_transfer(const TransferSpec& transfer, StressUpdate update, PositionUpdate positions, std::int64_t step) {
  StepTransfer out;
  const auto* xpic = std::get_if<XpicTransfer>(&transfer);
  const auto* fmpm = std::get_if<FmpmTransfer>(&transfer);
  if (xpic) out.terms = terms_in(*xpic, step);
  if (fmpm) out.terms = terms_in(*fmpm, step);
  out.of_start = xpic != nullptr;
  out.re_extrapolates = update == StressUpdate::musl || update == StressUpdate::usavg || out.terms > 0 ||
                        (update == StressUpdate::usf && positions == PositionUpdate::strain);
  return out;
}

VelocityRule velocity_rule(const TransferSpec& transfer, const StepTransfer& step, StressUpdate update, double dt,
                           double particle_damping) {
  VelocityRule rule;
  const auto* flip = std::get_if<FlipTransfer>(&transfer);
  rule.nodal = step.terms > 0 ? 1. : flip ? flip->pic : 0.;
  rule.own = 1 - rule.nodal;
  rule.gain = rule.own * dt;
  rule.damped = -std::expm1(-particle_damping * dt);
  rule.dt = dt;
  rule.strain_share = update == StressUpdate::usl && !step.re_extrapolates ? -0.5 : 0.5;
  return rule;
}

}  // namespace crampon
