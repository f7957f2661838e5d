#pragma once
/// What stays the same during a run: grid, laws, conditions, choices of the algorithm. SI throughout.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "crampon/contact/law.hpp"
#include "crampon/core/function.hpp"
#include "crampon/core/options.hpp"
#include "crampon/crack/symmetry_fold.hpp"
#include "crampon/geometry/shape.hpp"
#include "crampon/material/material_law.hpp"
#include "crampon/shape/stencil.hpp"
#include "crampon/state/grid.hpp"

namespace crampon {

/// A law with what particles made of it share.
template <int Dim>
struct Material {
  std::shared_ptr<const MaterialLaw> law;
  double thickness = 1;       ///< m, 2D
  HalfSize<Dim> half_size{};  ///< of a particle, in cells (uGIMP)
  std::uint16_t field = 0;    ///< material field (N13 sec. 1.2)
};

/// Velocity prescribed on nodes, or a symmetry plane.
template <int Dim>
struct VelocityCondition {
  std::string name;
  struct Component {
    int axis = 0;
    ValueFunction value;  ///< m/s
  };
  std::vector<Component> components;
  std::vector<std::int64_t> nodes;  ///< node numbers (Grid::node_number), ascending
  double start = 0, end = 0;        ///< s
  bool symmetry = false;            ///< normal momentum and force are zero (CONVENTIONS 29)
};

/// Forces on particles, by particle id: value(t) times the particle's share, N.
template <int Dim>
struct ParticleLoad {
  std::string name;
  std::vector<std::uint32_t> particles;  ///< ids, ascending
  std::vector<Vec<Dim>> share;           ///< per particle, per component
  std::vector<ValueFunction> value;      ///< per component, of time
};

template <int Dim>
struct Model {
  Grid<Dim> grid;
  StressState stress_state = StressState::plane_strain;
  std::vector<Material<Dim>> materials;
  int fields = 1;  ///< material velocity fields (N13 sec. 1.2)
  std::vector<std::string> bodies;
  std::vector<ContactLawSpec> crack_laws;  ///< per crack
  std::vector<VelocityCondition<Dim>> conditions;
  std::vector<SymmetryPlane> symmetries;
  std::vector<ParticleLoad<Dim>> loads;
  std::vector<ValueFunction> body_force;  ///< per component or empty, m/s2
  ValueFunction damping;                  ///< 1/s
  bool damped = false;
  StressUpdate stress_update = StressUpdate::usavg;
  ShapeFunctionKind shape_functions = ShapeFunctionKind::linear;
  CrackShapeFunctions crack_shape_functions = CrackShapeFunctions::linear;
  BoundaryOrder boundary_order = BoundaryOrder::contact_first;
  FixedForce fixed_force = FixedForce::incremental;
  LeavingParticle leaving_particle = LeavingParticle::error;
  struct Contact {
    ContactScheme scheme = ContactScheme::consistent;
    ContactDetection detection = ContactDetection::displacement;
    ContactPairs pairs = ContactPairs::joint;
    ReferenceVolume reference_volume = ReferenceVolume::initial;
    double volume_separated = 0.9, volume_contact = 1.1;  ///< V_sep, V_contact (N03 section 2.2)
    bool require_approach = true;                         ///< also above V_contact (CONVENTIONS 6)
    double mass_screen = 1e-6;                            ///< CONVENTIONS 37
  } contact;
  int threads = 1;

  bool any_body_force() const { return !body_force.empty(); }
};

}  // namespace crampon
