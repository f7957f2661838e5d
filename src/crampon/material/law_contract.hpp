#pragma once
/// What a struct must have to be a material law. A member that is missing or has another form is named by the first error of the compiler.

#include <concepts>
#include <optional>
#include <string_view>

#include "crampon/core/declared.hpp"
#include "crampon/material/elastic_constants.hpp"
#include "crampon/material/law_variable.hpp"
#include "crampon/material/stress_state.hpp"

namespace crampon {

namespace law_contract {

// One concept a member, so that an error can name it. Nothing has a default: a default that a new law forgets to change is a wrong answer without
// a word.
template <class Law>
concept says_what_its_strain_is = requires {
  std::string_view(Law::strain_measure);
};
template <class Law>
concept has_example = requires {
  { Law::example() } -> std::same_as<Law>;
};
template <class Law>
concept has_density = requires(const Law law) {
  { law.density } -> std::convertible_to<double>;
};
template <class Law>
concept has_wave_speed = requires(const Law law) {
  { law.wave_speed(StressState::plane_strain) } -> std::same_as<double>;
};
template <class Law>
concept says_its_elasticity = requires(const Law law) {
  { law.elasticity() } -> std::convertible_to<std::optional<ElasticConstants>>;
};
template <class Law>
concept says_whether_wave_speed_changes = requires {
  requires std::same_as<decltype(Law::wave_speed_changes), const bool>;
};
template <class Law>
concept says_whether_it_follows_deformation = requires {
  requires std::same_as<decltype(Law::starts_with_deformation_gradient), const bool>;
};
template <class Law, int Dim>
concept has_history_size = requires {
  { Law::template history_size<Dim> } -> std::convertible_to<int>;
};
template <class Law, int Dim>
concept has_variables = requires {
  Law::template variables<Dim>.size();
  { Law::template variables<Dim>.data() } -> std::convertible_to<const LawVariable*>;
};
template <class Law, int Dim>
concept has_initialise = requires(Pack* history) {
  Law::template initialise<Dim>(history);
};
template <class Law, int Dim, StressState S>
concept has_update = requires(const Law law, const Pack* L, Pack* stress, Pack* history) {
  { law.template update<Dim, S>(L, 0., stress, history) } -> std::same_as<Pack>;
};
template <class Law, int Dim, StressState S>
concept has_report = requires(const Law law, const Pack* stress, const Pack* history) {
  { law.template report<Dim, S>(stress, history) } -> std::same_as<PackReport>;
};
template <class Law, int Dim, StressState S>
concept has_present_wave_speed = requires(const Law law, const Pack* stress, const Pack* history) {
  { law.template present_wave_speed<Dim, S>(stress, history) } -> std::same_as<Pack>;
};

/// Do the declared variables stand in the history, behind the deformation gradient, each with a name and a unit, and at most one is the dissipated energy?
template <class Law, int Dim>
constexpr bool variables_fit() {
  int dissipated = 0;
  for (const LawVariable& v : Law::template variables<Dim>) {
    if (v.name.empty() || v.unit.empty() || v.help.empty()) return false;
    if (v.components != 1 && v.components != 3 && v.components != 6) return false;
    const int first = Law::starts_with_deformation_gradient ? Dim * Dim : 0;
    if (v.at < first || v.at + v.size(Dim) > Law::template history_size<Dim>) return false;
    if (v.kind == LawVariable::Kind::dissipated && (v.components != 1 || v.unit != "J/m3" || ++dissipated > 1)) return false;
  }
  return true;
}

}  // namespace law_contract

/// Compiles for a struct that is a material law.
template <class Law>
struct MaterialLawContract {
  static_assert(declared::has_name<Law>, "a material law needs: static constexpr const char* name = \"...\";");
  static_assert(law_contract::says_what_its_strain_is<Law>,
                "a material law needs: static constexpr const char* strain_measure = \"...\"; the formula of the strain that it reports");
  static_assert(declared::has_declaration<Law>,
                "a material law needs: static const Declaration<Law>& declaration(); it says which parameters the input may give");
  static_assert(law_contract::has_example<Law>,
                "a material law needs: static Law example(); the parameters of a real material, with which tests check the law");
  static_assert(law_contract::has_density<Law>, "a material law needs: double density; kg/m3 of the initial volume");
  static_assert(law_contract::has_wave_speed<Law>,
                "a material law needs: double wave_speed(StressState) const; the fastest wave of small amplitude, m/s");
  static_assert(
      law_contract::says_its_elasticity<Law>,
      "a material law needs: ElasticConstants elasticity() const; its elasticity of small strain from rest, or std::nullopt where that is "
      "not isotropic");
  static_assert(law_contract::says_whether_wave_speed_changes<Law>,
                "a material law needs: static constexpr bool wave_speed_changes; true if the wave speed depends on the deformation");
  static_assert(
      law_contract::says_whether_it_follows_deformation<Law>,
      "a material law needs: static constexpr bool starts_with_deformation_gradient; true if its history starts with the deformation "
      "gradient, false if it adds up small strains");
  static_assert(law_contract::has_history_size<Law, 2> && law_contract::has_history_size<Law, 3>,
                "a material law needs: template <int Dim> static constexpr int history_size; in Packs");
  static_assert(
      law_contract::has_variables<Law, 2> && law_contract::has_variables<Law, 3>,
      "a material law needs: template <int Dim> static constexpr std::array<LawVariable, N> variables; N is 0 for a law that has none");
  static_assert(law_contract::has_initialise<Law, 2> && law_contract::has_initialise<Law, 3>,
                "a material law needs: template <int Dim> static void initialise(Pack* history)");
  static_assert(
      law_contract::has_update<Law, 2, StressState::plane_strain> && law_contract::has_update<Law, 2, StressState::plane_stress> &&
          law_contract::has_update<Law, 3, StressState::three_dimensional>,
      "a material law needs: template <int Dim, StressState S> Pack update(const Pack* L, double dt, Pack* stress, Pack* history) const; "
      "it returns the volume ratio");
  static_assert(law_contract::has_report<Law, 2, StressState::plane_strain> &&
                    law_contract::has_report<Law, 2, StressState::plane_stress> &&
                    law_contract::has_report<Law, 3, StressState::three_dimensional>,
                "a material law needs: template <int Dim, StressState S> PackReport report(const Pack* stress, const Pack* history) const");
  static constexpr bool knows_present_wave_speed = [] {
    if constexpr (law_contract::says_whether_wave_speed_changes<Law>) {
      if constexpr (Law::wave_speed_changes) {
        return law_contract::has_present_wave_speed<Law, 2, StressState::plane_strain> &&
               law_contract::has_present_wave_speed<Law, 2, StressState::plane_stress> &&
               law_contract::has_present_wave_speed<Law, 3, StressState::three_dimensional>;
      }
    }
    return true;
  }();
  static_assert(
      knows_present_wave_speed,
      "a material law whose wave_speed_changes needs: template <int Dim, StressState S> Pack present_wave_speed(const Pack* stress, "
      "const Pack* history) const");
  static constexpr bool variables_fit = [] {
    if constexpr (law_contract::has_variables<Law, 2> && law_contract::has_variables<Law, 3> && law_contract::has_history_size<Law, 2> &&
                  law_contract::has_history_size<Law, 3> && law_contract::says_whether_it_follows_deformation<Law>)
      return law_contract::variables_fit<Law, 2>() && law_contract::variables_fit<Law, 3>();
    else
      return true;
  }();
  static_assert(variables_fit,
                "each variable of a material law needs a name, a unit and a help text, has 1, 3 or 6 components, and stands in the history "
                "behind the "
                "deformation gradient; at most one is the dissipated energy, with one component in J/m3");
  static constexpr bool complete = true;
};

}  // namespace crampon
