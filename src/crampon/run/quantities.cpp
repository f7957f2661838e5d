#include "crampon/run/quantities.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "crampon/output/stress_measures.hpp"

namespace crampon {

namespace {

ParticleQuantity of_stress(const char* name) {
  const StressMeasure& measure = *find_stress_measure(name);
  return {std::string(measure.name),
          measure.unit.empty() ? "1" : std::string(measure.unit),
          1,
          false,
          std::string(measure.help),
          std::string(measure.formula),
          [&measure](const ParticleView& p, double* o) { *o = measure.of(p.stress, 0); }};
}

// A further quantity of all particles is one line here.
std::vector<ParticleQuantity>& table() {
  using View = ParticleView;
  static std::vector<ParticleQuantity> list = {
      {"velocity", "m/s", 3, true, "velocity", "v", [](const View& p, double* o) { std::copy_n(p.velocity.c.data(), 3, o); }},
      {"displacement", "m", 3, true, "way from where the particle began", "u = x - X",
       [](const View& p, double* o) {
         for (std::size_t k = 0; k < 3; ++k) o[k] = p.position[k] - p.original[k];
       }},
      {"stress", "Pa", 6, true, "Cauchy stress, tension positive", "sigma = tau / J, tau by the law of the material",
       [](const View& p, double* o) { std::copy_n(p.stress, 6, o); }},
      {"strain", "1", 6, false, "strain as the law of the material measures it; tensor components, not engineering shear",
       "by the law of the material", [](const View& p, double* o) { std::copy_n(p.strain, 6, o); }},
      of_stress("pressure"),
      of_stress("von_mises"),
      {"energy_density", "J/m3", 1, false, "strain energy per initial volume", "W by the law of the material",
       [](const View& p, double* o) { *o = p.energy; }},
      {"volume", "m3", 1, false, "present volume, in 2D with the thickness of the body", "J V_0",
       [](const View& p, double* o) { *o = p.volume * p.volume_ratio; }},
      {"mass", "kg", 1, false, "mass, which stays the same", "m", [](const View& p, double* o) { *o = p.mass; }},
      {"density", "kg/m3", 1, false, "present density", "m / (J V_0)",
       [](const View& p, double* o) { *o = p.mass / (p.volume * p.volume_ratio); }},
      {"material", "1", 1, false,
       "number of the material, from 0 in the order of bodies; it counts again where bodies of it differ in thickness, particle size or "
       "field",
       "", [](const View& p, double* o) { *o = p.material; }},
  };
  return list;
}

}  // namespace

const std::vector<ParticleQuantity>& general_quantities() { return table(); }

void add_quantity(ParticleQuantity quantity) {
  for (const ParticleQuantity& q : table()) {
    if (q.name == quantity.name) throw std::logic_error("there is a quantity \"" + q.name + "\" already");
  }
  table().push_back(std::move(quantity));
}

std::vector<ParticleQuantity> quantities_of_laws(const std::vector<const MaterialLaw*>& laws) {
  std::vector<ParticleQuantity> found;
  const auto named = [](const std::vector<ParticleQuantity>& list, std::string_view name) {
    return std::find_if(list.begin(), list.end(), [&](const ParticleQuantity& q) { return q.name == name; });
  };
  for (const MaterialLaw* law : laws) {
    for (const LawVariable& v : law->variables(2)) {  // the same in space but for their places
      const auto at = named(found, v.name);
      if (named(general_quantities(), v.name) != general_quantities().end() ||
          (at != found.end() && (at->unit != v.unit || at->components != v.components)))
        throw std::logic_error("the variable \"" + std::string(v.name) + "\" of the law \"" + law->name() +
                               "\" bears the name of something else");
      if (at != found.end()) continue;
      found.push_back(
          {std::string(v.name), std::string(v.unit), v.components, v.common, std::string(v.help), "",
           [name = std::string(v.name), components = v.components](const ParticleView& p, double* o) { p.variable(name, components, o); }});
    }
  }
  return found;
}

}  // namespace crampon
