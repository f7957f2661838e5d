#pragma once
#include <algorithm>

#include "crampon/run/observers/observer.hpp"

namespace crampon {

/// The energy balance since the start of the run, J.
struct EnergyBalance {
  double kinetic = 0, strain = 0;
  EnergyTotals totals;
  CohesiveTotals cohesive;
  double growth = 0;            ///< taken by faces that part as cracks grow
  double material_loss = 0;     ///< taken by material laws
  bool laws_dissipate = false;  ///< a material of the problem can take energy
  double left = 0;              ///< kinetic and strain energy that left the grid
  double at_start = 0;          ///< kinetic and strain energy at the start

  double total() const { return kinetic + strain; }
  double load_work() const { return totals.load_work + cohesive.work_of_pressure; }
  double closure() const {
    const double held = totals.interfaces + cohesive.stored;
    const double lost = totals.damping + totals.transfer_loss + totals.contact_loss + totals.friction_loss + cohesive.dissipated_normal +
                        cohesive.dissipated_shear + material_loss + growth;
    return total() + held + lost + left - load_work() - totals.body_work - totals.boundary_work - at_start;
  }
};

template <int Dim>
class Energies final : public Observer<Dim> {
 public:
  static const auto& table() {
    using B = EnergyBalance;
    static const std::vector<Column<B>> all = {
        {{"kinetic_energy", "J", "of all particles that are not rigid", "sum of m v.v / 2"}, [](const B& b, int) { return b.kinetic; }},
        {{"strain_energy", "J", "in the material", "sum of V_0 W"}, [](const B& b, int) { return b.strain; }},
        {{"total_energy", "J", "kinetic and strain energy", "kinetic_energy + strain_energy"}, [](const B& b, int) { return b.total(); }},
        {{"load_work", "J", "work of loads since the start, and of pressure in cracks", "sum over steps of f.dx"},
         [](const B& b, int) { return b.load_work(); }},
        {{"body_force_work", "J", "work of the body force since the start", "sum over steps of m b.dx"},
         [](const B& b, int) { return b.totals.body_work; }},
        {{"boundary_work", "J", "work of boundaries, rigid bodies and walls on the material since the start",
          "sum over steps of reaction times way"},
         [](const B& b, int) { return b.totals.boundary_work; }},
        {{"damping_loss", "J", "taken by damping since the start", ""}, [](const B& b, int) { return b.totals.damping; }},
        {{"transfer_loss", "J", "taken by what particles take over from nodes (method.transfer) since the start", ""},
         [](const B& b, int) { return b.totals.transfer_loss; }},
        {{"contact_loss", "J", "lost as contact begins, and what the tasks of a step do not agree on, since the start", ""},
         [](const B& b, int) { return b.totals.contact_loss; }},
        {{"friction_loss", "J", "lost to friction since the start", "sum over steps of tangential impulse times mean slip speed"},
         [](const B& b, int) { return b.totals.friction_loss; }},
        {{"material_loss", "J",
          "taken by material laws since the start, as by plastic flow; only where a material of the problem can take energy",
          "sum of V_0 times what the law has taken per initial volume"},
         [](const B& b, int) { return b.material_loss; },
         Axes::none,
         [](const B& b) { return b.laws_dissipate; }},
        {{"interface_energy", "J", "in the springs of interfaces now", ""}, [](const B& b, int) { return b.totals.interfaces; }},
        {{"cohesive_energy", "J", "that traction laws of cracks would give back now", ""},
         [](const B& b, int) { return b.cohesive.stored; }},
        {{"cohesive_loss_I", "J", "spent by traction laws in opening since the start", ""},
         [](const B& b, int) { return b.cohesive.dissipated_normal; }},
        {{"cohesive_loss_II", "J", "spent by traction laws in sliding since the start", ""},
         [](const B& b, int) { return b.cohesive.dissipated_shear; }},
        {{"energy_closure", "J", "what the balance leaves open: an error of the computation",
          "total + interface + cohesive energy + all losses - all work - total energy at the start"},
         [](const B& b, int) { return b.closure(); }},
    };
    return all;
  }

  void start(const StartOfRun<Dim>& run) override { run.observed.initial_energy = run.now.sums().kinetic + run.now.sums().strain; }
  void look(const Present<Dim>& now, Cells& cells) const override {
    EnergyBalance b;
    b.kinetic = now.sums().kinetic;
    b.strain = now.sums().strain;
    b.totals = now.state.ledger.energy;
    b.cohesive = now.state.ledger.cohesive;
    b.growth = now.state.fracture.energy;
    b.material_loss = now.sums().dissipated + now.state.ledger.left.dissipated;
    const auto& materials = now.model.materials;
    b.laws_dissipate =
        std::any_of(materials.begin(), materials.end(), [](const Material<Dim>& m) { return m.law->dissipated(Dim) != nullptr; });
    b.left = now.state.ledger.left.kinetic + now.state.ledger.left.strain;
    b.at_start = now.state.observed.initial_energy;
    cells.add<Dim>(table(), b);
  }
};

}  // namespace crampon
