#include "crampon/run/history_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "crampon/core/error.hpp"
#include "crampon/output/quantity.hpp"
#include "crampon/run/sample.hpp"
#include "crampon/step/face_loads.hpp"
#include "crampon/step/ledger.hpp"
#include "crampon/step/move_cracks.hpp"

namespace crampon {

namespace {

constexpr const char* axis_names[3] = {"x", "y", "z"};

std::string suffix(int components, int k) {
  static constexpr const char* tensor[6] = {"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"};
  if (components == 3) return std::string("_") + axis_names[k];
  return components == 6 ? tensor[k] : "";
}

struct Probed {
  std::vector<double> ids;
  Field field;
};
/// A quantity as the output knows it, or a number made of one ("velocity_x", "von_mises"). Throws std::invalid_argument.
template <int Dim>
Probed probed(const State<Dim>& state, const Model<Dim>& model, const std::string& quantity) {
  const std::vector<std::string> known = particle_quantity_names();
  const auto is_known = [&](const std::string& name) { return std::find(known.begin(), known.end(), name) != known.end(); };
  if (is_known(quantity)) {
    PointFrame frame = sample_particles(state, model, {quantity});
    return {frame.fields.front().values.doubles(), std::move(frame.fields.back())};
  }
  const std::string field = quantity.substr(0, quantity.rfind('_'));
  PointFrame frame = sample_particles(state, model, is_known(field) ? std::vector{field} : known);
  Quantity all = evaluate_quantity(frame, quantity);
  return {frame.fields.front().values.doubles(), {quantity, all.unit, 1, std::move(all.values)}};
}

/// Over the vertices with material on both sides but for ends; over all when there are none.
void add_openings(const Crack<2>& crack, const std::vector<bool>& cracked, std::vector<double>& row) {
  const std::size_t n = crack.plane.size();
  const auto counts = [&](std::size_t v) { return cracked[v] && (crack.closed || (v > 0 && v + 1 < n)); };
  bool any = false;
  for (std::size_t v = 0; v < n; ++v) any = any || counts(v);
  double low = std::numeric_limits<double>::infinity(), high = -low, slid = 0;
  for (std::size_t v = 0; v < n; ++v) {
    if (any && !counts(v)) continue;
    const CrackOpening o = opening_at(crack, v);
    low = std::fmin(low, o.opening);
    high = std::fmax(high, o.opening);
    slid = std::fmax(slid, std::fabs(o.sliding));
  }
  row.insert(row.end(), {low, high, slid});
}

}  // namespace

template <int Dim>
void HistorySampler<Dim>::start(const Problem& problem, Observed& observed) {
  const auto sums = sum_particles(state_, model_);
  observed.initial_energy = sums.kinetic + sums.strain;
  std::vector<Diagnostic> errors;
  for (const ProbeInput& in : problem.probes) {
    try {
      probed(state_, model_, in.quantity);
    } catch (const std::invalid_argument& error) {
      errors.push_back({in.at("quantity"), error.what(), "it is a particle quantity or a component of one", "correct the name"});
    }
    double best = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (std::size_t p = 0; p < state_.particles.size(); ++p) {
      if (state_.particles.is_padding(p)) continue;
      if (!in.body.empty() && model_.bodies[state_.particles.body[p]] != in.body) continue;
      Vec<Dim> d = state_.particles.position(p);
      for (int k = 0; k < Dim; ++k) d[k] -= in.point[static_cast<std::size_t>(k)];
      // Of particles equally near, the one made first.
      const double distance = norm(d);
      if (distance < best || (distance == best && state_.particles.id[p] < nearest)) best = distance, nearest = state_.particles.id[p];
    }
    probes_.push_back({in.name, in.quantity});
    observed.probes.push_back(nearest);
  }
  if (!errors.empty()) throw InputError(std::move(errors));
}

template <int Dim>
std::vector<HistoryColumn> HistorySampler<Dim>::columns() const {
  std::vector<HistoryColumn> c = {{"time", "s"},
                                  {"kinetic_energy", "J"},
                                  {"strain_energy", "J"},
                                  {"total_energy", "J"},
                                  {"load_work", "J"},
                                  {"body_force_work", "J"},
                                  {"boundary_work", "J"},
                                  {"damping_loss", "J"},
                                  {"transfer_loss", "J"},
                                  {"contact_loss", "J"},
                                  {"friction_loss", "J"},
                                  {"interface_energy", "J"},
                                  {"cohesive_energy", "J"},
                                  {"cohesive_loss_I", "J"},
                                  {"cohesive_loss_II", "J"},
                                  {"energy_closure", "J"}};
  for (int k = 0; k < Dim; ++k) c.push_back({std::string("momentum_") + axis_names[k], "kg m/s"});
  c.push_back({"angular_momentum_z", "kg m2/s"});
  if (model_.leaving_particle == LeavingParticle::remove) {
    c.insert(c.end(), {{"left_mass", "kg"}, {"left_energy", "J"}});
    for (int k = 0; k < Dim; ++k) c.push_back({std::string("left_momentum_") + axis_names[k], "kg m/s"});
    c.push_back({"left_angular_momentum_z", "kg m2/s"});
  }
  for (const auto& condition : model_.conditions) {
    for (int k = 0; k < Dim; ++k) c.push_back({std::string("reaction_") + axis_names[k] + "." + condition.name, "N"});
  }
  for (const auto& body : model_.rigid_bodies) {
    if (body.prescribes()) continue;  // its condition has the columns
    for (int k = 0; k < Dim; ++k) c.push_back({std::string("reaction_") + axis_names[k] + "." + body.name, "N"});
    for (int k = Dim == 2 ? 2 : 0; k < 3; ++k) c.push_back({std::string("torque_") + axis_names[k] + "." + body.name, "N m"});
  }
  for (const auto& load : model_.loads) {
    for (int k = 0; k < Dim; ++k) c.push_back({std::string("load_") + axis_names[k] + "." + load.name, "N"});
  }
  for (const auto& crack : state_.cracks.list) {
    c.push_back({"opening_min." + crack.name, "m"});
    c.push_back({"opening_max." + crack.name, "m"});
    c.push_back({"sliding_max." + crack.name, "m"});
  }
  for (const Probe& probe : probes_) {
    const Field f = probed(state_, model_, probe.quantity).field;
    for (int k = 0; k < f.components; ++k) c.push_back({probe.name + "." + f.name + suffix(f.components, k), f.unit});
  }
  return c;
}

template <int Dim>
std::vector<double> HistorySampler<Dim>::row() const {
  const auto sums = sum_particles(state_, model_);
  const EnergyTotals& e = state_.ledger.energy;
  const double total = sums.kinetic + sums.strain;
  const CohesiveTotals& cohesive = state_.ledger.cohesive;
  const double load_work = e.load_work + cohesive.work_of_pressure;
  const double held = e.interfaces + cohesive.stored, lost = e.damping + e.transfer_loss + e.contact_loss + e.friction_loss +
                                                             cohesive.dissipated_normal + cohesive.dissipated_shear;
  const double left_energy = state_.ledger.left.kinetic + state_.ledger.left.strain;
  const double closure = total + held + lost + left_energy - load_work - e.body_work - e.boundary_work - state_.observed.initial_energy;
  std::vector<double> row = {state_.clock.time,
                             sums.kinetic,
                             sums.strain,
                             total,
                             load_work,
                             e.body_work,
                             e.boundary_work,
                             e.damping,
                             e.transfer_loss,
                             e.contact_loss,
                             e.friction_loss,
                             e.interfaces,
                             cohesive.stored,
                             cohesive.dissipated_normal,
                             cohesive.dissipated_shear,
                             closure};
  for (int k = 0; k < Dim; ++k) row.push_back(sums.momentum[k]);
  row.push_back(sums.angular);
  if (model_.leaving_particle == LeavingParticle::remove) {
    row.insert(row.end(), {state_.ledger.left.mass, left_energy});
    for (int k = 0; k < Dim; ++k) row.push_back(state_.ledger.left.momentum[k]);
    row.push_back(state_.ledger.left.angular);
  }
  for (std::size_t c = 0; c < model_.conditions.size(); ++c) {
    for (int k = 0; k < Dim; ++k) row.push_back(c < state_.ledger.reactions.size() ? state_.ledger.reactions[c][k] : 0.);
  }
  for (std::size_t b = 0; b < model_.rigid_bodies.size(); ++b) {
    if (model_.rigid_bodies[b].prescribes()) continue;
    const RigidReaction<Dim> r = b < state_.ledger.rigid_reactions.size() ? state_.ledger.rigid_reactions[b] : RigidReaction<Dim>{};
    for (int k = 0; k < Dim; ++k) row.push_back(r.force[k]);
    for (int k = Dim == 2 ? 2 : 0; k < 3; ++k) row.push_back(r.torque[k]);
  }
  for (const Vec<Dim>& load : total_loads(state_, work_, model_, state_.clock.time)) row.insert(row.end(), load.c.begin(), load.c.end());
  if constexpr (Dim == 2) {
    for (std::size_t c = 0; c < state_.cracks.size(); ++c)
      add_openings(present_crack(state_, work_, state_.cracks.list[c]), state_.observed.cracked[c], row);
  }
  for (std::size_t i = 0; i < probes_.size(); ++i) {
    const std::uint32_t particle = state_.observed.probes[i];
    const auto& [ids, f] = probed(state_, model_, probes_[i].quantity);
    const auto at = std::lower_bound(ids.begin(), ids.end(), static_cast<double>(particle));
    for (int k = 0; k < f.components; ++k) {
      const bool there = at != ids.end() && *at == particle;
      row.push_back(there ? f.values[static_cast<std::size_t>(at - ids.begin()) * f.components + k]
                          : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return row;
}

template <int Dim>
std::vector<HistoryColumn> event_columns_of() {
  std::vector<HistoryColumn> c = {{"time", "s"}, {"crack", "1"}};
  for (int k = 0; k < Dim; ++k) c.push_back({axis_names[k], "m"});
  c.insert(c.end(), {{"G_I", "J/m2"}, {"G_II", "J/m2"}});
  return c;
}

template <int Dim>
std::vector<double> event_row_of(const FailureEvent<Dim>& e) {
  std::vector<double> row = {e.time, static_cast<double>(e.crack)};
  for (int k = 0; k < Dim; ++k) row.push_back(e.x[k]);
  row.insert(row.end(), {e.G_I, e.G_II});
  return row;
}

#define CRAMPON_INSTANTIATE(DIM)                               \
  template class HistorySampler<DIM>;                          \
  template std::vector<HistoryColumn> event_columns_of<DIM>(); \
  template std::vector<double> event_row_of(const FailureEvent<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
