#include "crampon/input/crack_tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crampon/geometry/shapes.hpp"

namespace crampon {

namespace {

constexpr Presence required = Presence::required;

const Declaration<ArcInput>& arc_declaration() {
  static const auto d =
      Declaration<ArcInput>("arc", "Part of a circle.")
          .quantities("centre", &ArcInput::centre, "m", Bounds::any(), "centre of the circle", required, Length::exactly(2))
          .quantity("radius", &ArcInput::radius, "m", Bounds::positive(), "radius of the circle", required)
          .quantity("from", &ArcInput::from, "rad", Bounds::any(), "angle of the first point, counter-clockwise from the x axis", required)
          .quantity("to", &ArcInput::to, "rad", Bounds::any(), "angle of the last point; below from: the arc runs clockwise", required)
          .integer("segments", &ArcInput::segments, Bounds::between(0, 1000000),
                   "number of straight segments; 0: as many as max_segment asks for")
          .check([](const ArcInput& in, Diagnostics& diagnostics) {
            constexpr double full_turn = 6.283185307179586;
            if (in.from == in.to) diagnostics.add("to", "from and to are the same angle", "the arc has no length", "change one of them");
            if (std::abs(in.to - in.from) > full_turn * (1 + 1e-12))  // round-off of 360 deg
              diagnostics.add("to", "the arc is longer than a full turn", "it would cross itself", "reduce the angle between from and to");
          });
  return d;
}

const Declaration<GrowthInput>& growth_declaration() {
  static const auto d =
      Declaration<GrowthInput>("growth", "When the tips of a crack grow, where to and how fast. It needs [fracture].")
          .one_of("criterion", &GrowthInput::criterion, growth_criteria, "when a tip grows, and where to", required)
          .one_of("alternate", &GrowthInput::alternate, growth_criteria,
                  "a second criterion, which holds as well until the first has let a tip grow")
          .choice("ends", &GrowthInput::ends,
                  {{"both", GrowthInput::Ends::both}, {"start", GrowthInput::Ends::start}, {"end", GrowthInput::Ends::end}},
                  "which ends of the path grow, where they are tips")
          .choice("direction", &GrowthInput::direction,
                  {{"criterion", GrowthDirection::criterion},
                   {"straight", GrowthDirection::straight},
                   {"across_opening", GrowthDirection::across_opening},
                   {"hoop_of_opening", GrowthDirection::hoop_of_opening},
                   {"initial", GrowthDirection::initial},
                   {"given", GrowthDirection::given}},
                  "where a tip grows to: as its criterion says; straight on; across the opening two cells behind it; to the largest hoop "
                  "stress of "
                  "opening and sliding there; as the crack ran at the start; along a vector")
          .quantities("along", &GrowthInput::along, "1", Bounds::any(), "the vector, with direction = \"given\"", Presence::optional,
                      Length::exactly(2))
          .quantity("increment", &GrowthInput::increment, "1", Bounds::from_above(0, 5), "cells by which a tip grows at a time")
          .quantity("largest_speed", &GrowthInput::largest_speed, "m/s", Bounds::positive(),
                    "of a tip; left out: the speed of Rayleigh waves in the material")
          .flag("speed_by_drive", &GrowthInput::speed_by_drive,
                "the speed is largest_speed times 1 - 1/r, with r the energy that drives the tip over what growth takes")
          .quantity("largest_growth", &GrowthInput::largest_growth, "m", Bounds::positive(),
                    "a tip stops for good when it has grown so far")
          .quantity("start", &GrowthInput::start, "s", Bounds::non_negative(), "no tip grows before")
          .quantity("release", &GrowthInput::release, "1", Bounds::non_negative(),
                    "cells that a tip goes on while what held the faces behind it together fades; 0: they come free at once")
          .flag("bridged", &GrowthInput::bridged, "the traction law of the crack acts on what grows as well")
          .quantities("r_curve_growth", &GrowthInput::r_curve_growth, "m", Bounds::non_negative(),
                      "growth at which r_curve_factor holds, from 0; straight between", Presence::optional, Length::at_least(2))
          .quantities("r_curve_factor", &GrowthInput::r_curve_factor, "1", Bounds::positive(),
                      "energy that growth takes over that at the start (R-curve)", Presence::optional, Length::at_least(2))
          .quantity("rate_speed", &GrowthInput::rate_speed, "m/s", Bounds::positive(),
                    "growth takes 1 + (v/rate_speed)^rate_exponent of the energy at the speed v; left out: the speed does not matter")
          .quantity("rate_exponent", &GrowthInput::rate_exponent, "1", Bounds::positive(), "exponent of the speed")
          .check([](const GrowthInput& in, Diagnostics& diagnostics) {
            const bool given = in.direction == GrowthDirection::given;
            if (given != !in.along.empty())
              diagnostics.add("along", given ? "there is no vector" : "a vector is given, but not used", "",
                              given ? "add along" : "say direction = \"given\" or remove it");
            if (!in.along.empty() && in.along[0] == 0 && in.along[1] == 0)
              diagnostics.add("along", "the vector has no direction", "", "correct it");
            if (in.r_curve_growth.size() != in.r_curve_factor.size())
              diagnostics.add("r_curve_factor",
                              fmt::format("{} numbers for {} of growth", in.r_curve_factor.size(), in.r_curve_growth.size()), "",
                              "give one for each");
            for (std::size_t k = 1; k < in.r_curve_growth.size(); ++k)
              if (!(in.r_curve_growth[k] > in.r_curve_growth[k - 1]))
                diagnostics.add(fmt::format("r_curve_growth[{}]", k), "growth does not increase", "", "sort the numbers");
          });
  return d;
}

}  // namespace

const Declaration<CrackInput>& crack_declaration() {
  static const auto d =
      Declaration<CrackInput>("crack", "A polyline, or an arc divided into segments (2D). Above is to the left of its direction.")
          .name("name", &CrackInput::name, "what output calls it")
          .points("points", &CrackInput::points, "m", "vertices in order, at least two; either points or arc", Presence::optional,
                  Length::exactly(2))
          .record("arc", &CrackInput::arc, arc_declaration, "an arc instead of points")
          .excludes({"points"})
          .quantity("max_segment", &CrackInput::max_segment, "m", Bounds::positive(),
                    "longer segments are divided evenly; left out: half a cell")
          .flag("fixed", &CrackInput::fixed, "the crack stays where it is while the body moves")
          .one_of("contact", &CrackInput::contact, contact_laws, "what its faces do when they meet")
          .one_of("traction", &CrackInput::traction, traction_laws,
                  "tractions between its faces as they open: cohesion, bridging, pressure")
          .one_of("traction_region", &CrackInput::traction_region, shapes,
                  "only the part of the crack that starts in this region bears the traction")
          .quantity("thickness", &CrackInput::thickness, "m", Bounds::positive(),
                    "extent out of the plane on which the traction acts; left out: that of the bodies")
          .record("growth", &CrackInput::growth, growth_declaration, "when its tips grow, where to and how fast; left out: they stay")
          .check([](const CrackInput& in, Diagnostics& diagnostics) {
            if (in.points.empty() && !in.arc)
              diagnostics.add("", "neither points nor arc is given", "the crack has no place", "add points or arc");
            if (in.points.size() == 1) diagnostics.add("points", "the crack has one point", "a crack needs at least two", "add a point");
            for (std::size_t k = 1; k < in.points.size(); ++k)
              if (in.points[k] == in.points[k - 1])
                diagnostics.add(fmt::format("points[{}]", k), "the point is the same as the one before", "the segment has no length",
                                "remove it");
          });
  return d;
}

const Declaration<FractureInput>& fracture_declaration() {
  static const auto d =
      Declaration<FractureInput>(
          "fracture",
          "Fracture parameters at the tips of cracks that lie in bodies (2D): J, and the stress intensities K_I and K_II. "
          "They are integrals over a disk about the tip, which shrinks where edges, other tips or other cracks are near.")
          .quantity("inner_radius", &FractureInput::inner_radius, "1", Bounds::non_negative(),
                    "cells from the tip: the part of the disk inside counts fully; fields closer than two cells to a tip are coarse")
          .quantity("outer_radius", &FractureInput::outer_radius, "1", Bounds::at_least(3), "cells from the tip: where the disk ends")
          .quantity("interval", &FractureInput::interval, "s", Bounds::positive(),
                    "time between two looks, besides those for the history; left out: the time of a wave over the outer radius")
          .choice("mixity", &FractureInput::mixity,
                  {{"interaction", FractureInput::Mixity::interaction}, {"opening", FractureInput::Mixity::opening}},
                  "how K_I and K_II are told apart: by the interaction integral, or by opening and sliding two cells behind the tip")
          .choice("form", &FractureInput::form, {{"domain", FractureInput::Form::domain}, {"contour", FractureInput::Form::contour}},
                  "how J is found: over the disk, or along a circle in the middle of the ring where it ends, for comparison")
          .check([](const FractureInput& in, Diagnostics& diagnostics) {
            if (in.inner_radius > 0.8 * in.outer_radius)
              diagnostics.add("inner_radius",
                              fmt::format("the disk begins to end at {:g} cells and ends at {:g}", in.inner_radius, in.outer_radius),
                              "sums over particles need some rows of them between", "let it be at most 0.8 of outer_radius");
          });
  return d;
}

const Declaration<NucleationInput>& nucleation_declaration() {
  static const auto d =
      Declaration<NucleationInput>(
          "nucleation",
          "Cracks that start as straight lines where the largest principal stress passes a strength (2D), across that stress. "
          "They are called NAME.1, NAME.2 and so on. It needs [fracture].")
          .name("name", &NucleationInput::name, "what output calls the cracks, with a dot and a number")
          .quantity("strength", &NucleationInput::strength, "Pa", Bounds::positive(),
                    "a crack starts where the largest principal stress in the plane, of the mean over the radius, is as large", required)
          .text("materials", &NucleationInput::materials, "names of the materials in which cracks start; left out: all")
          .quantity("radius", &NucleationInput::radius, "1", Bounds::from_above(0, 5),
                    "cells about a particle over which stress is averaged, with a weight that falls smoothly to the rim: over particles of "
                    "these materials that belong to one piece with it")
          .quantity("length", &NucleationInput::length, "1", Bounds::between(1, 100),
                    "of a new crack, cells; about a tip 3 cells must be free, or it has no J")
          .quantity("distance", &NucleationInput::distance, "1", Bounds::positive(),
                    "cells from the centre of a new crack to other cracks and to symmetry planes, at least; left out: twice the length")
          .one_of("region", &NucleationInput::region, shapes,
                  "cracks start only at particles that were in this region at the start of the run; left out: everywhere")
          .integer("most", &NucleationInput::most, Bounds::between(0, 1000), "how many cracks may start")
          .quantity("start", &NucleationInput::start, "s", Bounds::non_negative(), "no crack starts before")
          .one_of("contact", &NucleationInput::contact, contact_laws, "what the faces of the cracks do when they meet")
          .one_of("traction", &NucleationInput::traction, traction_laws,
                  "tractions between the faces as they open: cohesion, bridging, pressure")
          .record("growth", &NucleationInput::growth, growth_declaration,
                  "when the tips of the cracks grow, where to and how fast; left out: they stay")
          .check([](const NucleationInput& in, Diagnostics& diagnostics) {
            const double least = std::max(in.length + 1, in.radius);
            if (in.least_distance() < least)
              diagnostics.add(
                  "distance", fmt::format("new cracks may start {:g} cells from another crack", in.least_distance()),
                  fmt::format("they are {:g} cells long and could cross it, and stress is averaged over {:g} cells", in.length, in.radius),
                  fmt::format("make it at least {:g}", least));
          });
  return d;
}

}  // namespace crampon
