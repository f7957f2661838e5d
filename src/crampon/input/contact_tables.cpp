#include "crampon/input/contact_tables.hpp"

#include <fmt/format.h>

#include "crampon/geometry/shapes.hpp"

namespace crampon {

namespace {

constexpr Presence required = Presence::required;
const Length up_to_three = Length::between(1, 3), two_or_three = Length::between(2, 3);

const std::vector<std::pair<std::string, ContactDetection>> detections = {{"position", ContactDetection::position},
                                                                          {"regression", ContactDetection::regression},
                                                                          {"displacement", ContactDetection::displacement},
                                                                          {"volume", ContactDetection::volume}};

/// Motion of a rigid body varies in time alone.
void check_motion(const std::vector<ValueFunction>& values, const char* key, Diagnostics& diagnostics) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k].depends_on_position())
      diagnostics.add(fmt::format("{}[{}]", key, k), "the motion depends on the position", "a rigid body moves as a whole", "use t alone");
  }
}

}  // namespace

const Declaration<ContactInput>& contact_declaration() {
  static const auto d =
      Declaration<ContactInput>(
          "contact", "Which bodies meet as bodies of their own, and how contact between them and across cracks is found and enforced.")
          .choice("fields", &ContactInput::fields,
                  {{"single", FieldsOf::all}, {"materials", FieldsOf::materials}, {"bodies", FieldsOf::bodies}},
                  "velocity fields (N13 sec. 1.2): one for all bodies, which then stick where they meet, one for each material, or one for "
                  "each body; left out where default is given and would hold nowhere: bodies")
          .one_of("default", &ContactInput::between_fields, contact_laws,
                  "law between bodies of different fields, rigid bodies and walls, unless a [[contact_pair]] says otherwise")
          .choice("material_detection", &ContactInput::material_detection, detections,
                  "how the gap between bodies is found: from mean positions about a node, from the edges of particles, from displacements "
                  "since the start (for bodies that start in touch), or by relative volume (N03)")
          .quantity("position_cutoff", &ContactInput::position_cutoff, "1", Bounds::between(0, 2),
                    "faces touch when the mean positions about a node are this many cells apart (0.8: linear, gimp; 0.9: bspline; 1: "
                    "cubic_bspline); left out: "
                    "what the shape functions and the size of particles make of touching faces")
          .choice("normal", &ContactInput::normal,
                  {{"logistic_regression", ContactNormal::logistic_regression},
                   {"linear_regression", ContactNormal::linear_regression},
                   {"largest_gradient", ContactNormal::largest_gradient},
                   {"average_gradient", ContactNormal::average_gradient},
                   {"more_volume", ContactNormal::more_volume}},
                  "normal between bodies: the line that parts their particles best, or a gradient of volume")
          .quantity("rigid_bias", &ContactInput::rigid_bias, "1", Bounds::at_least(1),
                    "a rigid body's gradient of volume gives the normal unless it is this many times smaller than the other's")
          .choice("several_materials", &ContactInput::several_materials,
                  {{"pairwise", SeveralMaterials::pairwise}, {"virtual", SeveralMaterials::virtual_material}},
                  "three and more bodies at a node: all pairs of them together, or each against all others as one (N13)")
          .choice("scheme", &ContactInput::scheme, {{"consistent", ContactScheme::consistent}, {"literal", ContactScheme::literal}},
                  "one state per node and pair carried through a step, or contact found anew each time as the papers write it")
          .choice("detection", &ContactInput::detection, detections,
                  "the same across cracks; displacements serve until faces have slid by about a cell")
          .choice("pairs", &ContactInput::pairs, {{"joint", ContactPairs::joint}, {"sequential", ContactPairs::sequential}},
                  "all pairs of fields at a node together, or one after another (N13)")
          .quantity("volume_separated", &ContactInput::volume_separated, "1", Bounds::positive(),
                    "relative volume below which faces are apart (V_sep of N03)")
          .quantity("volume_contact", &ContactInput::volume_contact, "1", Bounds::positive(),
                    "relative volume above which faces touch (V_contact of N03)")
          .flag("require_approach", &ContactInput::require_approach, "contact needs approaching faces also above volume_contact (N13)")
          .choice("reference_volume", &ContactInput::reference_volume,
                  {{"cell", ReferenceVolume::cell}, {"initial", ReferenceVolume::initial}},
                  "undeformed volume at a node: the cell's, or that of the uncut bodies at the start")
          .quantity("mass_screen", &ContactInput::mass_screen, "1", Bounds::from_below(0, 0.5),
                    "pairs in which one field has less than this fraction of the mass are left alone")
          .check([](const ContactInput& in, Diagnostics& diagnostics) {
            if (in.volume_separated > in.volume_contact)
              diagnostics.add(in.keys.contains("volume_separated") ? "volume_separated" : "volume_contact",
                              "volume_separated is above volume_contact", fmt::format("{} > {}", in.volume_separated, in.volume_contact),
                              "faces that touch must be closer than faces that are apart");
          });
  return d;
}

const Declaration<ContactPairInput>& contact_pair_declaration() {
  static const auto d =
      Declaration<ContactPairInput>("contact_pair",
                                    "What two bodies do when they meet; of several entries for the same two the last one holds.")
          .text("between", &ContactPairInput::between, "two names: of bodies, rigid bodies, walls, materials or fields", required)
          .one_of("contact", &ContactPairInput::contact, contact_laws, "the contact law", required)
          .quantities("normal", &ContactPairInput::normal, "1", Bounds::any(),
                      "normal from the first to the second, of any length; left out: found by contact.normal", Presence::optional,
                      two_or_three)
          .check([](const ContactPairInput& in, Diagnostics& diagnostics) {
            if (in.between.size() != 2)
              diagnostics.add("between", fmt::format("{} names", in.between.size()), "a pair is of two", "give two names");
            bool zero = !in.normal.empty();
            for (const double n : in.normal) zero = zero && n == 0;
            if (zero) diagnostics.add("normal", "the normal has no length", "it shows no direction", "correct it or leave it out");
          });
  return d;
}

const Declaration<RigidInput>& rigid_declaration() {
  using Role = RigidInput::Role;
  using Faces = RigidInput::Faces;
  static const auto d =
      Declaration<RigidInput>("rigid", "A body of particles that moves as prescribed, whatever it meets.")
          .name("name", &RigidInput::name, "what contact pairs and the reaction columns call it", required)
          .one_of("shape", &RigidInput::shape, shapes, "the space to fill with particles", required)
          .integers("particles_per_cell", &RigidInput::particles_per_cell, Bounds::between(1, 64),
                    "particles per cell in each direction; one for all axes or one per axis", Presence::optional, up_to_three)
          .quantity("thickness", &RigidInput::thickness, "m", Bounds::positive(), "extent out of the plane (2D)")
          .function("velocity", &RigidInput::velocity, "m/s",
                    "velocity of its centre, one per dimension; may vary in time; left out: at rest", Presence::optional, two_or_three)
          .function("spin", &RigidInput::spin, "rad/s", "angular velocity about its centre: one in 2D, three in 3D; may vary in time",
                    Presence::optional, up_to_three)
          .quantities("spin_centre", &RigidInput::spin_centre, "m", Bounds::any(),
                      "its centre at the start; left out: the centre of its volume", Presence::optional, two_or_three)
          .choice("role", &RigidInput::role, {{"contact", Role::contact}, {"boundary", Role::boundary}},
                  "whether it meets bodies by a contact law, or gives its velocity to the nodes in its shape and within half a cell of it")
          .choice(
              "faces", &RigidInput::faces, {{"shape", Faces::shape}, {"particles", Faces::particles}},
              "what bodies meet of it: the faces of its shape, or a field of particles among others (N13); default: shape, but particles "
              "with contact.scheme = \"literal\" and with an interface")
          .text("components", &RigidInput::components,
                "boundary: the components of velocity that it gives, as [\"x\", \"y\"]; left out: all")
          .check([](const RigidInput& in, Diagnostics& diagnostics) {
            check_motion(in.velocity, "velocity", diagnostics);
            check_motion(in.spin, "spin", diagnostics);
            if (!in.components.empty() && in.role == Role::contact)
              diagnostics.add("components", "components are given for a body in contact", "contact acts in all directions",
                              "remove them, or use role = \"boundary\"");
            if (in.faces && in.role == Role::boundary)
              diagnostics.add("faces", "faces are given for a boundary", "it holds nodes, and meets nothing",
                              "remove them, or use role = \"contact\"");
            for (std::size_t k = 0; k < in.components.size(); ++k)
              if (in.components[k] != "x" && in.components[k] != "y" && in.components[k] != "z")
                diagnostics.add(fmt::format("components[{}]", k), fmt::format("\"{}\" is no component", in.components[k]), "",
                                "use \"x\", \"y\" or \"z\"");
          });
  return d;
}

const Declaration<WallInput>& wall_declaration() {
  using Kind = WallInput::Kind;
  static const auto d =
      Declaration<WallInput>("wall", "A rigid wall without particles; bodies meet it by a contact law.")
          .name("name", &WallInput::name, "what contact pairs and the reaction columns call it", required)
          .choice("kind", &WallInput::kind, {{"half_space", Kind::half_space}, {"ball", Kind::ball}, {"hollow_ball", Kind::hollow_ball}},
                  "all on one side of a line (3D: a plane), a disk (a ball), or all around a disk (a ball)")
          .quantities("point", &WallInput::point, "m", Bounds::any(), "half_space: a point of its surface at the start", Presence::optional,
                      two_or_three)
          .quantities("normal", &WallInput::normal, "1", Bounds::any(), "half_space: out of the wall, of any length", Presence::optional,
                      two_or_three)
          .quantities("centre", &WallInput::centre, "m", Bounds::any(), "ball, hollow_ball: centre at the start", Presence::optional,
                      two_or_three)
          .quantity("radius", &WallInput::radius, "m", Bounds::positive(), "ball, hollow_ball: radius")
          .function("velocity", &WallInput::velocity, "m/s", "velocity, one per dimension; may vary in time; left out: at rest",
                    Presence::optional, two_or_three)
          .function("spin", &WallInput::spin, "rad/s", "ball, hollow_ball: angular velocity about the centre: one in 2D, three in 3D",
                    Presence::optional, up_to_three)
          .check([](const WallInput& in, Diagnostics& diagnostics) {
            check_motion(in.velocity, "velocity", diagnostics);
            check_motion(in.spin, "spin", diagnostics);
            const bool flat = in.kind == Kind::half_space;
            const auto demand = [&](bool wanted, bool given, const char* key) {
              if (wanted && !given)
                diagnostics.add("", fmt::format("the key \"{}\" is missing", key), "the wall has no place without it",
                                fmt::format("add {}", key));
              if (!wanted && given)
                diagnostics.add(key, fmt::format("{} is given for another kind of wall", key), "", "remove it or correct kind");
            };
            demand(flat, !in.point.empty(), "point");
            demand(flat, !in.normal.empty(), "normal");
            demand(!flat, !in.centre.empty(), "centre");
            demand(!flat, in.radius.has_value(), "radius");
            if (flat && !in.spin.empty())
              diagnostics.add("spin", "a half-space that spins", "it would sweep all space", "use a [[rigid]] body");
            bool zero = !in.normal.empty();
            for (const double n : in.normal) zero = zero && n == 0;
            if (zero) diagnostics.add("normal", "the normal has no length", "it shows no direction", "correct it");
          });
  return d;
}

}  // namespace crampon
