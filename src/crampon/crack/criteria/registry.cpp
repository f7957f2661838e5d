#include "crampon/crack/criteria/criterion.hpp"
#include "crampon/crack/criteria/critical_j.hpp"
#include "crampon/crack/criteria/critical_opening.hpp"
#include "crampon/crack/criteria/energy_balance.hpp"
#include "crampon/crack/criteria/max_energy_release.hpp"
#include "crampon/crack/criteria/max_hoop_stress.hpp"
#include "crampon/crack/criteria/max_principal_stress.hpp"
#include "crampon/crack/criteria/mixed_power.hpp"
#include "crampon/crack/criteria/steady_state.hpp"
#include "crampon/crack/criteria/strain_energy_density.hpp"

namespace crampon {

std::vector<GrowthCriterionSpec> growth_criterion_examples() {
  growth_criteria();  // criteria join as the family is made
  return examples_of_family<GrowthCriterionSpec>();
}

// A further criterion is one file like critical_j.hpp and one line here.
Family<GrowthCriterionSpec>& growth_criteria() {
  static Family<GrowthCriterionSpec> family = [] {
    Family<GrowthCriterionSpec> f("growth criterion", "law", "When a crack grows, and where to.");
    add_growth_criterion<MaxHoopStress>(f);
    add_growth_criterion<CriticalJ>(f);
    add_growth_criterion<MaxEnergyRelease>(f);
    add_growth_criterion<StrainEnergyDensity>(f);
    add_growth_criterion<MixedPower>(f);
    add_growth_criterion<EnergyDrivenGrowth>(f);
    add_growth_criterion<SteadyState>(f);
    add_growth_criterion<CriticalOpening>(f);
    add_growth_criterion<MaxPrincipalStress>(f);
    return f;
  }();
  return family;
}

}  // namespace crampon
