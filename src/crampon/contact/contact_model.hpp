#pragma once
/// What contact knows of a run: the velocity fields that meet, the laws between them and across cracks, and the choices of the scheme.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crampon/contact/edge_map.hpp"
#include "crampon/contact/law.hpp"
#include "crampon/core/options.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/state/layers.hpp"

namespace crampon {

/// A velocity field of its own (N13 sec. 1.2): of one material, of one body, or of a group that the input names.
struct MaterialField {
  std::string name;
  bool rigid = false;           ///< of a rigid body: masses on its nodes are volumes, 1 kg/m3
  bool ignores_cracks = false;  ///< cracks do not part it: rigid, or as the input has it
  bool meets_at_nodes = true;   ///< by its particles; else at the face of its shape, or not at all
  int body = -1;                ///< rigid: index into Model::rigid_bodies
  std::uint16_t bonded_to = 0;  ///< the lowest field to which a chain of bonded laws joins it; itself where there is none
  double thickness = 1;         ///< m, 2D
  double half_size = 0;         ///< of its particles, along their longest side, cells
  double uneven_edge = 0;       ///< how deep behind its surface its particles may fill space unevenly, cells
  EdgeMap edge;                 ///< from the mean position of its particles about a node to its edge
};

/// How contact is detected and solved (docs/theory/contact.md).
struct ContactChoices {
  ContactScheme scheme = ContactScheme::consistent;
  ContactDetection detection = ContactDetection::displacement;
  ContactPairs pairs = ContactPairs::joint;
  ReferenceVolume reference_volume = ReferenceVolume::initial;
  double volume_separated = 0.9, volume_contact = 1.1;  ///< V_sep, V_contact (N03 section 2.2)
  bool require_approach = true;                         ///< also above V_contact (conventions 6)
  double mass_screen = 1e-6;                            ///< conventions 37
  ContactDetection material_detection = ContactDetection::position;
  std::optional<double> position_cutoff;  ///< cells; none: by MaterialField::edge
  ContactNormal normal = ContactNormal::logistic_regression;
  double rigid_bias = 10;  ///< a rigid body's gradient is taken unless it is smaller by more than this
  SeveralMaterials several_materials = SeveralMaterials::pairwise;
};

template <int Dim>
struct ContactModel : ContactChoices {
  std::vector<MaterialField> fields{1};
  std::vector<ContactLawSpec> field_laws{1};  ///< [field][field], symmetric
  std::vector<Vec<Dim>> field_normals{1};     ///< [field][field]: normal from the first to the second; zero: to be found
  std::vector<ContactLawSpec> crack_laws;     ///< per crack

  bool several_fields() const { return fields.size() > 1; }
  bool any_contact() const { return several_fields() || !crack_laws.empty(); }
  const ContactLaw& law_between(int a, int b) const { return *field_laws[at(a, b)]; }
  const Vec<Dim>& normal_between(int a, int b) const { return field_normals[at(a, b)]; }
  /// Images of cracks in symmetry planes, which have the same laws, follow the cracks (CrackView::seen).
  const ContactLaw& law_across(CrackId crack) const { return *crack_laws[crack % crack_laws.size()]; }
  /// Do fields on both sides of a crack or of a law move as one group? One after another, bonded pairs are pairs like others (N13, conventions 14).
  bool makes_one_group(const ContactLaw& law) const { return law.bonds() && pairs == ContactPairs::joint; }

  template <class F>
  bool any_law(F asks) const {
    const auto any = [&](const std::vector<ContactLawSpec>& laws) {
      return std::any_of(laws.begin(), laws.end(), [&](const ContactLawSpec& law) { return asks(*law); });
    };
    return any(field_laws) || any(crack_laws);
  }
  /// Does some law ask for areas, or for what particles remember of contact?
  bool needs_areas() const {
    return any_law([](const ContactLaw& law) { return law.needs_area(); });
  }
  bool remembers_contact() const {
    return any_contact() && any_law([](const ContactLaw& law) { return law.needs_history(); });
  }

 private:
  std::size_t at(int a, int b) const { return static_cast<std::size_t>(a) * fields.size() + static_cast<std::size_t>(b); }
};

}  // namespace crampon
