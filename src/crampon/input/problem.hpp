#pragma once
/// A problem as the user states it: what one input file says, in SI, before anything is built from it.
/// Each struct declares its keys in problem.cpp (core/declaration.hpp); parser, checks, schema and reference page follow from that.

#include <any>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crampon/contact/law.hpp"
#include "crampon/core/error.hpp"
#include "crampon/core/function.hpp"
#include "crampon/core/options.hpp"
#include "crampon/core/vector.hpp"
#include "crampon/crack/traction/law.hpp"
#include "crampon/geometry/region.hpp"
#include "crampon/material/material.hpp"
#include "crampon/shape/registry.hpp"
#include "crampon/step/fracture_model.hpp"
#include "crampon/step/growth_model.hpp"
#include "crampon/step/transfer.hpp"

namespace crampon {

enum class Analysis { plane_strain, plane_stress, three_dimensional };

/// [grid]: uniform Cartesian background grid.
struct GridInput : Located {
  std::vector<double> origin;  ///< lowest corner, m, one per dimension
  std::vector<double> size;    ///< extent, m; a whole number of cells within 1e-6 of a cell
  std::vector<double> cell;    ///< cell size, m; one value for all axes or one per axis
};

/// [time] stop_at_rest: when all has come to rest.
struct RestInput : Located {
  double ratio = 1e-6;  ///< kinetic over strain energy
  double period = 0;    ///< for which it must stay below, s
};

/// [time]: how far, and in what steps. Exactly one of end and steps.
struct TimeInput : Located {
  std::optional<double> end;          ///< s
  std::optional<std::int64_t> steps;  ///< number of steps
  std::optional<double> step;         ///< fixed time step, s; else from the Courant factor
  double courant = 0.4;               ///< time step = courant * cell / wave speed (smallest over materials and axes)
  std::optional<RestInput> stop_at_rest;
};

/// [method]: the choices of the algorithm.
struct MethodInput : Located {
  StressUpdate stress_update = StressUpdate::usavg;
  PositionUpdate positions = PositionUpdate::strain;
  RotationTransfer rotation = RotationTransfer::carried;
  ShapeFunctionKind shape_functions = kind_of<LinearShape>;
  CrackShapeFunctions crack_shape_functions = CrackShapeFunctions::linear;
  ValueFunction damping;           ///< grid damping kappa of N03 Eq. 4, 1/s, may vary in time
  ValueFunction particle_damping;  ///< the same of particles, 1/s, may vary in time
  TransferSpec transfer;
  std::vector<ValueFunction> body_force;  ///< acceleration b, m/s2, one per dimension or empty; uniform in space
  using BoundaryOrder = crampon::BoundaryOrder;
  using FixedForce = crampon::FixedForce;
  using LeavingParticle = crampon::LeavingParticle;
  BoundaryOrder boundary_order = BoundaryOrder::contact_first;
  FixedForce fixed_force = FixedForce::incremental;
  LeavingParticle leaving_particle = LeavingParticle::error;
};

/// [contact]: which bodies have velocity fields of their own, and how contact between them and across cracks is found and enforced.
struct ContactInput : Located {
  FieldsOf fields = FieldsOf::all;
  ContactLawSpec between_fields;  ///< law between two fields unless a contact_pair says otherwise
  ContactDetection material_detection = ContactDetection::position;
  std::optional<double> position_cutoff;  ///< cells; left out: by tables (contact/edge_map.hpp)
  ContactNormal normal = ContactNormal::logistic_regression;
  double rigid_bias = 10;
  SeveralMaterials several_materials = SeveralMaterials::pairwise;
  using Scheme = ContactScheme;
  using Detection = ContactDetection;
  using Pairs = ContactPairs;
  using ReferenceVolume = crampon::ReferenceVolume;
  Scheme scheme = Scheme::consistent;
  Detection detection = Detection::displacement;  ///< across cracks
  Pairs pairs = Pairs::joint;
  double volume_separated = 0.9;  ///< V_sep of N03
  double volume_contact = 1.1;    ///< V_contact of N03
  bool require_approach = true;   ///< also above V_contact (N13); false: N03's normal sticking
  ReferenceVolume reference_volume = ReferenceVolume::initial;
  double mass_screen = 1e-6;  ///< pairs with a mass fraction below this are left alone
};

/// [[contact_pair]]: what two of them do when they meet.
struct ContactPairInput : Located {
  std::vector<std::string> between;  ///< two names of bodies, rigid bodies, walls, materials or fields
  ContactLawSpec contact;
  std::vector<double> normal;  ///< from the first to the second; empty: found
};

/// [[rigid]]: a body of particles that moves as prescribed.
struct RigidInput : Located {
  std::string name;
  RegionPtr shape;
  std::vector<std::int64_t> particles_per_cell{2};
  double thickness = 1;                 ///< m, 2D only
  std::vector<ValueFunction> velocity;  ///< of its centre, m/s, of time
  std::vector<ValueFunction> spin;      ///< rad/s, of time: one in 2D, three in 3D
  std::vector<double> spin_centre;      ///< at the start, m; default: its centre of volume
  enum class Role { contact, boundary } role = Role::contact;
  enum class Faces { shape, particles };
  std::optional<Faces> faces;           ///< what bodies meet: its shape, or its particles (N13 sec. 3); none: by contact.scheme
  std::vector<std::string> components;  ///< boundary: of the velocity; empty: all
};

/// [[wall]]: a rigid body known by a formula.
struct WallInput : Located {
  std::string name;
  enum class Kind { half_space, ball, hollow_ball } kind = Kind::half_space;
  std::vector<double> point, normal;  ///< half_space: a point of its surface, m, and a vector out of it
  std::vector<double> centre;         ///< ball, hollow_ball, m
  std::optional<double> radius;       ///< m
  std::vector<ValueFunction> velocity, spin;
};

/// [[material]]: a named constitutive law.
struct MaterialInput : Located {
  std::string name;
  MaterialSpec law;  ///< parameters of the chosen law (material/material.hpp)
};

/// [[body]] initial_stress: none; Cauchy stress by components, Pa, of position; or that of a body at rest under gravity.
struct NoInitialStress {};
struct ComponentStress {
  ValueFunction xx, yy, xy;
  std::optional<ValueFunction> zz, yz, xz;  ///< 3D
};
struct GravityStress {
  std::vector<double> surface;  ///< a point of the free surface, m
  double lateral = 0;           ///< horizontal over vertical stress
};
using InitialStressInput = std::variant<NoInitialStress, ComponentStress, GravityStress>;

/// [[body]]: a shape filled with particles, or particles from a file.
struct BodyInput : Located {
  std::string name;
  std::string material;
  std::optional<std::string> field;                 ///< velocity field; left out: what contact.fields says
  RegionPtr shape;                                  ///< either shape or particles
  std::optional<std::string> particles;             ///< CSV file, relative to the input: x,y[,z],volume[,vx,vy[,vz]], SI
  std::vector<std::int64_t> particles_per_cell{2};  ///< per direction; one value or one per axis; also the uGIMP particle size
  std::optional<bool> match_mass;                   ///< do particles follow the boundary of the shape? Left out: they do not
  double thickness = 1;                             ///< m, 2D only
  bool ignores_cracks = false;                      ///< cracks do not part it
  std::vector<ValueFunction> velocity;              ///< initial, m/s, of position, one per dimension or empty
  std::vector<double> spin;                         ///< rad/s: one number in 2D, three in 3D, or empty
  std::vector<double> spin_centre;                  ///< m; default: the body's centre of mass
  InitialStressInput initial_stress;
};

/// The arc of a crack.
struct ArcInput : Located {
  std::vector<double> centre;  ///< m
  double radius = 0;           ///< m
  double from = 0, to = 0;     ///< rad, counter-clockwise positive; to < from runs clockwise
  std::int64_t segments = 0;   ///< 0: segments of at most half a cell
};

/// [[crack]] growth: when it grows, where to and how fast.
struct GrowthInput : Located {
  GrowthCriterionSpec criterion, alternate;
  enum class Ends { both, start, end } ends = Ends::both;
  using Direction = GrowthDirection;
  Direction direction = Direction::criterion;
  std::vector<double> along;                           ///< given
  double increment = 0.5;                              ///< cells
  std::optional<double> largest_speed;                 ///< m/s; none: that of Rayleigh waves
  bool speed_by_drive = false;                         ///< largest_speed (1 - 1/drive)
  std::optional<double> largest_growth;                ///< m
  double start = 0;                                    ///< s
  double release = 2;                                  ///< cells that a tip goes on while the faces behind it come free
  bool bridged = false;                                ///< the crack's traction law acts on what grows
  std::vector<double> r_curve_growth, r_curve_factor;  ///< m, 1
  std::optional<double> rate_speed;                    ///< m/s
  double rate_exponent = 1;
};

/// [[crack]]: a polyline, or an arc divided into segments. 2D.
struct CrackInput : Located {
  std::string name;
  std::vector<std::vector<double>> points;  ///< m; at least two
  std::optional<ArcInput> arc;
  std::optional<double> max_segment;  ///< m; longer segments are divided evenly; default: half a cell
  bool fixed = false;                 ///< fixed in space
  ContactLawSpec contact;             ///< law between its faces (contact/law.hpp)
  TractionLawSpec traction;           ///< between its faces as they open (crack/traction/law.hpp)
  RegionPtr traction_region;          ///< vertices that bear it; none: all
  std::optional<double> thickness;    ///< m; default: that of the bodies
  std::optional<GrowthInput> growth;
};

/// [[nucleation]]: cracks that start where stress passes a strength. 2D.
struct NucleationInput : Located {
  std::string name;                    ///< the cracks are NAME.1, NAME.2, ...
  std::vector<std::string> materials;  ///< in which they start; empty: in all
  double strength = 0;                 ///< Pa
  double radius = 2;                   ///< over which stress is averaged, cells
  double length = 4;                   ///< of a new crack, cells
  std::optional<double> distance;      ///< from its centre to other cracks at least, cells; none: twice the length
  RegionPtr region;                    ///< in which they start, by places in the undeformed bodies; none: everywhere
  std::int64_t most = 1;               ///< how many there may be
  double start = 0;                    ///< s
  ContactLawSpec contact;
  TractionLawSpec traction;
  std::optional<GrowthInput> growth;

  double least_distance() const { return distance.value_or(2 * length); }  ///< cells
};

/// [fracture]: J and stress intensities at the tips of cracks. 2D.
struct FractureInput : Located {
  double inner_radius = 3, outer_radius = 6;  ///< of the domain, cells
  std::optional<double> interval;             ///< between two looks, s; none: the time of a wave over the outer radius
  using Mixity = FractureModel::Mixity;
  Mixity mixity = Mixity::interaction;
  using Form = FractureModel::Form;
  Form form = Form::domain;
};

/// [[boundary]]: nodal velocity prescribed in a region.
struct BoundaryInput : Located {
  std::string name;
  RegionPtr region;                                      ///< nodes in this region; boundaries are included within 1e-9 of a cell
  std::optional<ValueFunction> vx, vy, vz;               ///< m/s; a component left out is free
  double start = 0;                                      ///< s
  double end = std::numeric_limits<double>::infinity();  ///< s
};

/// [[symmetry]]: a plane on a grid line.
struct SymmetryInput : Located {
  std::string name;
  int axis = 0;   ///< 0, 1, 2 from "x", "y", "z": the normal
  double at = 0;  ///< m, on a grid line
  int side = 1;   ///< +1 ("above") when the body lies at larger coordinates, -1 ("below")
  /// Part of the plane: bounds of the other coordinates, m. NaN: unbounded.
  std::vector<double> from, to;  ///< one per dimension; the entry of `axis` is ignored
};

/// [[load]]: forces on particles, or stress on faces.
struct LoadInput : Located {
  std::string name;
  enum class Kind { total_force, force_each, traction, pressure } kind = Kind::total_force;
  std::string body;                  ///< restrict to this body; empty: all
  RegionPtr region;                  ///< particles initially in this region (traction, pressure: their outer faces)
  std::vector<ValueFunction> value;  ///< N, N, Pa (per component); pressure: one, Pa. In t only
  std::optional<std::string> face;   ///< traction, pressure: "x-", "x+", "y-", ...: where the boundary looks; none: all of it
};

/// [[probe]]: history columns at a place.
struct ProbeInput : Located {
  std::string name;
  std::string quantity;       ///< as the particle output's names
  std::vector<double> point;  ///< m: the particle nearest to it at the start
  std::string body;           ///< restrict to this body; empty: all
};

/// [output]
struct OutputInput : Located {
  std::optional<double> every;                ///< s between frames
  std::optional<std::int64_t> every_steps;    ///< steps between frames
  std::vector<double> times;                  ///< s, exact list
  std::optional<double> history_every;        ///< s; default: at most 1000 rows
  std::optional<std::int64_t> history_steps;  ///< steps between history rows
  std::vector<std::string> quantities;        ///< particle quantities; empty: the common ones
  bool full_precision = false;                ///< float64 instead of float32
  bool grid = false;                          ///< also write nodes
};

/// [[expect]]: a number the run must reproduce.
struct ExpectInput : Located {
  std::string name;
  std::optional<std::string> column;    ///< of history.csv, without the unit
  std::optional<std::string> quantity;  ///< of the particles, at `point`, in the last frame (or the one nearest `time`)
  std::vector<double> point;            ///< m
  std::optional<double> time;           ///< s; a history value there (linear between rows)
  std::vector<double> range;            ///< s, two: the statistic over this range
  enum class Statistic { value, minimum, maximum, mean, spread } statistic = Statistic::value;
  double value = 0;                ///< SI
  double tolerance = 0;            ///< absolute, SI; or
  std::optional<double> relative;  ///< relative to |value|
  std::string unit;                ///< for the table that is printed
  std::string source;              ///< where the number comes from
};

/// A whole input file.
struct Problem : Located {
  std::string title;
  std::string description;
  Analysis analysis = Analysis::plane_strain;  ///< dimension 3 when three_dimensional
  GridInput grid;
  TimeInput time;
  MethodInput method;
  ContactInput contact;
  std::vector<MaterialInput> materials;
  std::vector<BodyInput> bodies;
  std::vector<RigidInput> rigids;
  std::vector<WallInput> walls;
  std::vector<ContactPairInput> contact_pairs;
  std::vector<CrackInput> cracks;
  std::optional<FractureInput> fracture;
  std::vector<NucleationInput> nucleations;
  std::vector<BoundaryInput> boundaries;
  std::vector<SymmetryInput> symmetries;
  std::vector<LoadInput> loads;
  std::vector<ProbeInput> probes;
  OutputInput output;
  std::vector<ExpectInput> expects;
  std::string source;                          ///< the input text
  std::map<std::string, std::string> written;  ///< texts of quantities of any dimension, by place ("expect[0].value")
  std::string resolved;                        ///< the same with every default explicit, in SI, as TOML (write_resolved)
  std::string directory;                       ///< files named in the input are relative to it

  int dimension() const { return analysis == Analysis::three_dimensional ? 3 : 2; }
};

/// All keys of an input file: what the parser, the schema and the reference page start from.
const Declaration<Problem>& problem_declaration();

}  // namespace crampon
