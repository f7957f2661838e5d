#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "crampon/output/quantity.hpp"
#include "crampon/run/observers/observer.hpp"
#include "crampon/run/quantities.hpp"
#include "crampon/run/sample.hpp"

namespace crampon {

/// Quantities of single particles, which the input chooses.
template <int Dim>
class Probes final : public Observer<Dim> {
 public:
  static std::vector<ColumnDescription> describe() {
    return {{"PROBE.QUANTITY", "", "a quantity of the particle that a [[probe]] watches; nan once it has left the grid",
             "components as PROBE.velocity_x, PROBE.stress_xy"}};
  }

  void start(const StartOfRun<Dim>& run) override {
    const State<Dim>& state = run.now.state;
    for (const ProbeInput& in : run.problem.probes) {
      try {
        measured(run.now, in.quantity);
      } catch (const std::invalid_argument& error) {
        run.errors.push_back({in.at("quantity"), error.what(), "it is a particle quantity or a component of one", "correct the name"});
      }
      double best = std::numeric_limits<double>::infinity();
      std::uint32_t nearest = 0;
      for (std::size_t p = 0; p < state.particles.size(); ++p) {
        if (state.particles.is_padding(p)) continue;
        if (!in.body.empty() && run.now.model.bodies[state.particles.body[p]] != in.body) continue;
        Vec<Dim> d = state.particles.position(p);
        for (int k = 0; k < Dim; ++k) d[k] -= in.point[static_cast<std::size_t>(k)];
        // Of particles equally near, the one made first.
        const double distance = norm(d);
        if (distance < best || (distance == best && state.particles.id[p] < nearest)) best = distance, nearest = state.particles.id[p];
      }
      probes_.push_back({in.name, in.quantity});
      run.observed.probes.push_back(nearest);
    }
  }

  void look(const Present<Dim>& now, Cells& cells) const override {
    for (std::size_t i = 0; i < probes_.size(); ++i) {
      const Probe& probe = probes_[i];
      const std::uint32_t particle = now.state.observed.probes[i];
      const auto& [ids, f] = measured(now, probe.quantity);
      const auto at = std::lower_bound(ids.begin(), ids.end(), static_cast<double>(particle));
      const bool there = at != ids.end() && *at == particle;
      for (int k = 0; k < f.components; ++k) {
        cells.add({probe.name + "." + f.name + suffix(f.components, k), f.unit},
                  there ? f.values[static_cast<std::size_t>(at - ids.begin()) * static_cast<std::size_t>(f.components) +
                                   static_cast<std::size_t>(k)]
                        : std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

 private:
  struct Probe {
    std::string name, quantity;
  };
  struct Measured {
    std::vector<double> ids;
    DataArray field;
  };

  static std::string suffix(int components, int k) {
    static constexpr const char* tensor[6] = {"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"};
    if (components == 3) return std::string("_") + "xyz"[k];
    return components == 6 ? tensor[k] : "";
  }
  /// A quantity as the output knows it, or a number made of one ("velocity_x", "von_mises"). Throws std::invalid_argument.
  static Measured measured(const Present<Dim>& now, const std::string& quantity) {
    const std::vector<std::string> known = quantity_names_of(now.model);
    const auto is_known = [&](const std::string& name) { return std::find(known.begin(), known.end(), name) != known.end(); };
    if (is_known(quantity)) {
      PointFrame frame = sample_particles(now.state, now.model, {quantity});
      return {frame.fields.front().values.doubles(), std::move(frame.fields.back())};
    }
    const std::string field = quantity.substr(0, quantity.rfind('_'));
    PointFrame frame = sample_particles(now.state, now.model, is_known(field) ? std::vector{field} : known);
    PointValues all = evaluate_quantity(frame, quantity);
    return {frame.fields.front().values.doubles(), {quantity, all.unit, 1, std::move(all.values)}};
  }

  std::vector<Probe> probes_;  ///< of the particles Observed::probes
};

}  // namespace crampon
