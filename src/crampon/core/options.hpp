#pragma once
/// Choices of the algorithm, shared by the input and the engine.

namespace crampon {

enum class ShapeFunctionKind { linear, gimp, bspline };
enum class StressUpdate { usl, musl, usf, usavg };

/// By what crack points read the velocities of nodes: linear functions, or those of a particle without size (B-splines where particles
/// have them).
enum class CrackShapeFunctions { linear, same };

/// N13 contacts first, N03 imposes boundary conditions first (CONVENTIONS 26).
enum class BoundaryOrder { contact_first, boundary_first };
/// Force on fixed components: incremental (contact-consistency.md), N13 Eq. 1, or zero (N03).
enum class FixedForce { incremental, n13, zero };
enum class LeavingParticle { error, remove };

/// contact-consistency.md, or contact detected anew in Tasks 2, 4 and 6 as in the papers.
enum class ContactScheme { consistent, literal };
enum class ContactDetection { displacement, volume };
/// All pairs of a node solved together, or one after another (N13).
enum class ContactPairs { joint, sequential };
enum class ReferenceVolume { cell, initial };

}  // namespace crampon
