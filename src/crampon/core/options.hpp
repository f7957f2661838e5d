#pragma once
/// Choices of the algorithm, shared by the input and the engine.

namespace crampon {

enum class StressUpdate { usl, musl, usf, usavg };
/// With which nodal velocity particles move: with the one that strains them, or with that of N03 Eq. 30 (docs/theory/step.md, positions).
enum class PositionUpdate { strain, n03 };

/// Whether momenta carry the rotation of bodies, or are those of N03 Eq. 26 (step/rotation.hpp).
enum class RotationTransfer { carried, n03 };

/// By what crack points read the velocities of nodes: linear functions, or those of a particle without size (B-splines where particles
/// have them).
enum class CrackShapeFunctions { linear, same };

/// N13 contacts first, N03 imposes boundary conditions first (conventions 26).
enum class BoundaryOrder { contact_first, boundary_first };
/// Force on fixed components: incremental (docs/theory/step.md, boundary values), N13 Eq. 1, or zero (N03).
enum class FixedForce { incremental, n13, zero };
enum class LeavingParticle { error, remove };

/// Which bodies have a velocity field of their own (N13 sec. 1.2).
enum class FieldsOf { all, materials, bodies };

/// One state for each pair in contact, carried through the step (docs/theory/contact.md, the scheme), or contact detected anew in Tasks 2,
/// 4 and 6 as in the papers.
enum class ContactScheme { consistent, literal };
/// How far apart two faces are: by the means of their particles' positions or by the particles themselves, by how far they have come since the
/// start, or by N03's relative volume.
enum class ContactDetection { position, regression, displacement, volume };
/// The normal between two materials (docs/theory/contact.md, normals).
enum class ContactNormal { logistic_regression, linear_regression, largest_gradient, average_gradient, more_volume };
/// All pairs of a node solved together, or one after another (N13).
enum class ContactPairs { joint, sequential };
/// Three and more materials at a node: all pairs of them, or each against the virtual material of all others (N13 Eqs. 7-9).
enum class SeveralMaterials { pairwise, virtual_material };
enum class ReferenceVolume { cell, initial };

}  // namespace crampon
