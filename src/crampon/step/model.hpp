#pragma once
/// What stays the same during a run: grid, laws, conditions, choices of the algorithm. SI throughout.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crampon/contact/contact_model.hpp"
#include "crampon/core/function.hpp"
#include "crampon/core/options.hpp"
#include "crampon/crack/symmetry_fold.hpp"
#include "crampon/crack/traction/law.hpp"
#include "crampon/geometry/region.hpp"
#include "crampon/material/material_law.hpp"
#include "crampon/shape/registry.hpp"
#include "crampon/shape/stencil.hpp"
#include "crampon/state/grid.hpp"
#include "crampon/state/layers.hpp"
#include "crampon/step/fracture_model.hpp"
#include "crampon/step/growth_model.hpp"
#include "crampon/step/loaded_faces.hpp"
#include "crampon/step/nucleation_model.hpp"
#include "crampon/step/transfer.hpp"

namespace crampon {

/// A law with what particles made of it share.
template <int Dim>
struct Material {
  std::shared_ptr<const MaterialLaw> law;
  double thickness = 1;       ///< m, 2D
  HalfSize<Dim> half_size{};  ///< of a particle, in cells (uGIMP)
  std::uint16_t field = 0;    ///< material field (N13 sec. 1.2)
};

/// A body that moves as prescribed (N13 sec. 3, rigid materials).
template <int Dim>
struct RigidBody {
  std::string name;
  std::vector<ValueFunction> velocity;  ///< of its centre, per component, m/s; of time; empty: none
  std::vector<ValueFunction> spin;      ///< about its centre, rad/s: one in 2D, three in 3D; of time; empty: none
  Vec<Dim> centre;                      ///< at the start, m
  RegionPtr shape;                      ///< as it was at the start
  std::uint16_t field = 0;              ///< its velocity field
  /// face: meets others at the face of its shape. particles: as a field of particles among others (N13 sec. 3). nodes: gives its velocity to
  /// the nodes in its shape, instead of meeting what is there.
  enum class Acts { face, particles, nodes } acts = Acts::face;
  bool is_empty = false;        ///< it has no particles
  std::uint16_t condition = 0;  ///< nodes: as this condition, whose components say which
  bool prescribes() const { return acts == Acts::nodes; }
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
  bool symmetry = false;            ///< normal momentum and force are zero (conventions 29)
  int rigid_body = -1;              ///< that prescribes it; its nodes are found anew in each step
};

/// A traction law on a crack.
struct CrackTraction {
  TractionLawSpec law;
  double thickness = 1;  ///< m
  bool acts() const { return law->acts(); }
};

/// Forces on particles, or stress on faces of bodies.
template <int Dim>
struct Load {
  std::string name;
  /// forces: value(t) times a particle's share, N; traction: per area of the undeformed face, in a fixed direction, Pa; pressure: per area of
  /// the face as it is, against its normal, Pa.
  enum class Kind { forces, traction, pressure } kind = Kind::forces;
  std::vector<ValueFunction> value;      ///< per component, of time; pressure: the first
  std::vector<std::uint32_t> particles;  ///< forces: ids, ascending
  std::vector<double> share;             ///< ... per particle
};

template <int Dim>
struct Model {
  Grid<Dim> grid;
  StressState stress_state = StressState::plane_strain;
  std::vector<Material<Dim>> materials;
  std::vector<RigidBody<Dim>> rigid_bodies;
  /// By number of a particle: from its middle at the start to the nearest point of its body's surface, m. Zero: deep in its body; not a number:
  /// nobody knows (particles from a file). Kept where rigid faces or outlines ask for it.
  std::vector<Vec<Dim>> surface;
  std::vector<RegionPtr> shapes;  ///< of bodies, as they were at the start; null: nobody knows
  /// By number of a particle: columns of the inverse of its deformation gradient at the start; empty where none bears stress from the start.
  std::vector<std::array<Vec<Dim>, Dim>> undeformed;
  std::vector<std::string> bodies;
  std::vector<CrackTraction> tractions;  ///< per crack
  FractureModel fracture;
  std::vector<GrowthModel> growth;  ///< per crack
  std::vector<NucleationModel> nucleations;
  std::vector<VelocityCondition<Dim>> conditions;
  std::vector<SymmetryPlane> symmetries;
  std::vector<Load<Dim>> loads;
  LoadedFaces<Dim> faces;                 ///< that loads act on
  std::vector<ValueFunction> body_force;  ///< per component or empty, m/s2
  ValueFunction damping;                  ///< 1/s
  bool damped = false;
  ValueFunction particle_damping;  ///< 1/s
  TransferSpec transfer;
  StressUpdate stress_update = StressUpdate::usavg;
  PositionUpdate positions = PositionUpdate::strain;
  RotationTransfer rotation = RotationTransfer::carried;
  ShapeFunctionKind shape_functions = kind_of<LinearShape>;
  CrackShapeFunctions crack_shape_functions = CrackShapeFunctions::linear;
  BoundaryOrder boundary_order = BoundaryOrder::contact_first;
  FixedForce fixed_force = FixedForce::incremental;
  LeavingParticle leaving_particle = LeavingParticle::error;
  ContactModel<Dim> contact;
  int threads = 1;

  StepTransfer transfer_in(std::int64_t step) const { return step_transfer(transfer, stress_update, positions, step); }
  bool any_prescribing_body() const {
    return std::any_of(rigid_bodies.begin(), rigid_bodies.end(), [](const RigidBody<Dim>& body) { return body.prescribes(); });
  }
  bool any_rigid_face() const {
    return std::any_of(rigid_bodies.begin(), rigid_bodies.end(),
                       [](const RigidBody<Dim>& body) { return body.acts == RigidBody<Dim>::Acts::face; });
  }
  bool any_body_force() const { return !body_force.empty(); }
  bool any_tractions() const {
    return std::any_of(tractions.begin(), tractions.end(), [](const CrackTraction& t) { return t.acts(); });
  }
  bool any_growth() const {
    return std::any_of(growth.begin(), growth.end(), [](const GrowthModel& g) { return g.acts(); });
  }
  bool is_rigid(std::uint16_t field) const { return contact.fields[field].rigid; }
  bool ignores_cracks(std::uint16_t field) const { return contact.fields[field].ignores_cracks; }
};

/// Is stress updated with the velocities of Task 2, or with those of Task 6? USAVG does both, half of the step each (N03 Eq. 35).
template <int Dim>
bool updates_stress_first(const Model<Dim>& model) {
  return model.stress_update == StressUpdate::usf || model.stress_update == StressUpdate::usavg;
}
template <int Dim>
bool updates_stress_last(const Model<Dim>& model) {
  return model.stress_update != StressUpdate::usf;
}

/// Time by which positions lead velocities in a step of dt, s: half of it, so that forces find them in the middle of the coming step
/// (docs/theory/step.md, time of positions). Nothing with N03 Eq. 30, which is taken as it stands.
template <int Dim>
double position_lead(const Model<Dim>& model, double dt) {
  return model.positions == PositionUpdate::strain ? 0.5 * dt : 0.;
}

}  // namespace crampon
