#include <string>

#include "crampon/material/elastic_large_rotation.hpp"
#include "crampon/material/elastic_small_strain.hpp"
#include "crampon/material/j2_plasticity.hpp"
#include "crampon/material/material.hpp"
#include "crampon/material/neo_hookean.hpp"

namespace crampon {

namespace {

/// The three parameters that the isotropic elastic laws share.
template <class Law>
Declaration<Law> isotropic(const char* help) {
  return Declaration<Law>(Law::name, help)
      .quantity("E", &Law::E, "Pa", Bounds::positive(), "Young's modulus", Presence::required)
      .quantity("nu", &Law::nu, "1", Bounds::inside(-1, 0.5), "Poisson's ratio", Presence::required)
      .quantity("density", &Law::density, "kg/m3", Bounds::positive(), "mass per initial volume", Presence::required);
}

}  // namespace

const Declaration<ElasticSmallStrain>& ElasticSmallStrain::declaration() {
  static const auto d = isotropic<ElasticSmallStrain>(
      "Isotropic elasticity for small strain, exactly as N03 (Eqs. 9, 28, 35). Rotations of more than a few degrees build up stress.");
  return d;
}

const Declaration<ElasticLargeRotation>& ElasticLargeRotation::declaration() {
  static const auto d = isotropic<ElasticLargeRotation>(
      "Isotropic elasticity for small strain and any rotation: stored energy of the stretch U of F = R U, lambda/2 tr(U - I)^2 + mu |U - "
      "I|^2.");
  return d;
}

const Declaration<NeoHookean>& NeoHookean::declaration() {
  static const auto d = isotropic<NeoHookean>("Coupled neo-Hookean solid for large strain: tau = lambda ln J I + mu (b - I).");
  return d;
}

const Declaration<J2Plasticity>& J2Plasticity::declaration() {
  static const auto d = isotropic<J2Plasticity>(
                            "Plasticity of von Mises (J2) with linear isotropic hardening, for any stretch and rotation: F = F_e F_p, "
                            "Hooke's law between elastic "
                            "logarithmic strain and Kirchhoff stress.")
                            .quantity("yield_stress", &J2Plasticity::yield_stress, "Pa", Bounds::positive(),
                                      "stress of first yield in uniaxial tension, Kirchhoff stress", Presence::required)
                            .quantity("hardening_modulus", &J2Plasticity::hardening_modulus, "Pa", Bounds::non_negative(),
                                      "rise of the yield stress per equivalent plastic strain; 0: perfectly plastic");
  return d;
}

std::vector<MaterialSpec> material_examples() {
  materials();  // laws join as the family is made
  return examples_of_family<MaterialSpec>();
}

// A further law is one file like neo_hookean.hpp and one line here.
Family<MaterialSpec>& materials() {
  static Family<MaterialSpec> family = [] {
    Family<MaterialSpec> f("material", "law", "How a material answers to deformation.");
    add_material<ElasticSmallStrain>(f);
    add_material<ElasticLargeRotation>(f);
    add_material<NeoHookean>(f);
    add_material<J2Plasticity>(f);
    return f;
  }();
  return family;
}

}  // namespace crampon
