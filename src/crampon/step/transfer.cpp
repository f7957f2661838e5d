#include "crampon/step/transfer.hpp"

#include <cmath>

namespace crampon {

namespace {

const Bounds most_terms = Bounds::between(1, 20);
constexpr const char* order_help = "terms of the series; each beyond the first costs about half a step more";

}  // namespace

const Declaration<FlipTransfer>& FlipTransfer::declaration() {
  static const auto d =
      Declaration<FlipTransfer>("flip", "Particles add the accelerations of nodes to their own velocities (N03 Eq. 30).")
          .quantity("pic", &FlipTransfer::pic, "1", Bounds::between(0, 1),
                    "part of their velocity that particles take from nodes in each step instead: damps what nodes do not see, and more");
  return d;
}

const Declaration<XpicTransfer>& XpicTransfer::declaration() {
  static const auto d =
      Declaration<XpicTransfer>(
          "xpic", "Particles take the velocities of nodes at the start of the step, filtered to some order, and add accelerations.")
          .integer("order", &XpicTransfer::order, most_terms, order_help)
          .integer("every", &XpicTransfer::every, Bounds::at_least(1), "act in every so many steps, with FLIP in between");
  return d;
}

const Declaration<FmpmTransfer>& FmpmTransfer::declaration() {
  static const auto d =
      Declaration<FmpmTransfer>("fmpm", "Particles take the velocities of nodes at the end of the step, filtered to some order.")
          .integer("order", &FmpmTransfer::order, most_terms, order_help);
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
  if (xpic && step % xpic->every == 0) out.terms = xpic->order;
  if (fmpm) out.terms = fmpm->order;
  out.of_start = xpic != nullptr;
  out.re_extrapolates = update == StressUpdate::musl || update == StressUpdate::usavg || out.terms > 0 ||
                        (update == StressUpdate::usf && positions == PositionUpdate::strain);
  return out;
}

VelocityRule velocity_rule(const TransferSpec& transfer, const StepTransfer& step, StressUpdate update, PositionUpdate positions, double dt,
                           double damping, double particle_damping) {
  VelocityRule rule;
  const auto* flip = std::get_if<FlipTransfer>(&transfer);
  const double of_transfer = step.terms > 0 ? 1.
                             : flip         ? flip->pic
                                            : 0.,
               of_damping = positions == PositionUpdate::n03 ? 0. : -std::expm1(-damping * dt) * (1 - of_transfer);
  rule.nodal = of_transfer + of_damping;
  rule.own = 1 - rule.nodal;
  rule.share_of_damping = of_damping > 0 ? of_damping / rule.nodal : 0.;
  rule.gain = rule.own * dt;
  rule.damped = -std::expm1(-particle_damping * dt);
  rule.dt = dt;
  rule.strain_share = update == StressUpdate::usl && !step.re_extrapolates ? -0.5 : 0.5;
  return rule;
}

}  // namespace crampon
