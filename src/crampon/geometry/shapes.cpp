#include "crampon/geometry/shapes.hpp"

#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crampon/geometry/boxes.hpp"
#include "crampon/geometry/combine.hpp"
#include "crampon/geometry/flats.hpp"
#include "crampon/geometry/placed.hpp"
#include "crampon/geometry/polygon.hpp"
#include "crampon/geometry/round.hpp"
#include "crampon/geometry/solids.hpp"

namespace crampon {
namespace {

using Numbers = std::vector<double>;
constexpr double pi = std::numbers::pi;

Vec<2> plane_vector(const Numbers& x) { return {{x[0], x[1]}}; }
Vec<3> space_vector(const Numbers& x) { return {{x[0], x[1], x.size() > 2 ? x[2] : 0}}; }
int dimension_of(const Numbers& x) { return static_cast<int>(x.size()); }
bool zero(const Numbers& x) { return norm(space_vector(x)) == 0; }

const Length two = Length::exactly(2), three = Length::exactly(3), two_or_three = Length::between(2, 3);

struct NoInput : Located {};

// Rectangle and box: two corners, or centre and size.
struct CornersInput : Located {
  Numbers low, high, centre, size;
};

void check_corners(const CornersInput& in, Diagnostics& diagnostics) {
  const bool by_corners = !in.low.empty() || !in.high.empty(), by_centre = !in.centre.empty() || !in.size.empty();
  if (by_corners && by_centre) {
    diagnostics.add(in.centre.empty() ? "size" : "centre", "corners and centre with size are both given", "they could disagree",
                    "give low and high, or centre and size");
  } else if (by_corners ? in.low.empty() || in.high.empty() : in.centre.empty() || in.size.empty()) {
    std::string missing = "low and high are";
    if (by_corners) missing = in.low.empty() ? "low is" : "high is";
    if (by_centre) missing = in.centre.empty() ? "centre is" : "size is";
    diagnostics.add("", missing + " missing", "the shape has no extent", "give low and high, or centre and size");
  } else if (by_corners) {
    for (std::size_t k = 0; k < in.low.size(); ++k)
      if (in.low[k] > in.high[k])
        diagnostics.add("high", fmt::format("high is below low along {}", "xyz"[k]), fmt::format("{} < {}", in.high[k], in.low[k]),
                        "exchange the two numbers");
  }
}

template <int Dim>
std::pair<Vec<Dim>, Vec<Dim>> corners_of(const CornersInput& in) {
  Vec<Dim> low, high;
  for (int k = 0; k < Dim; ++k) {
    low[k] = in.low.empty() ? in.centre[k] - in.size[k] / 2 : in.low[k];
    high[k] = in.low.empty() ? in.centre[k] + in.size[k] / 2 : in.high[k];
  }
  return {low, high};
}

Declaration<CornersInput> declare_corners(const char* name, const char* help, Length length) {
  return Declaration<CornersInput>(name, help)
      .quantities("low", &CornersInput::low, "m", Bounds::any(), "Corner with the smallest coordinates.", {}, length)
      .quantities("high", &CornersInput::high, "m", Bounds::any(), "Corner with the largest coordinates.", {}, length)
      .quantities("centre", &CornersInput::centre, "m", Bounds::any(), "Centre, with size instead of corners.", {}, length)
      .quantities("size", &CornersInput::size, "m", Bounds::non_negative(), "Edge lengths.", {}, length)
      .check(check_corners);
}

struct RoundInput : Located {
  Numbers centre;
  double radius = 0;
};
struct EllipseInput : Located {
  Numbers centre, semi_axes;
  double angle = 0;
};
struct RingInput : Located {
  Numbers centre;
  double inner = 0, outer = 0;
};
struct SectorInput : Located {
  Numbers centre;
  double radius = 0, from = 0, to = 0;
};

Declaration<RoundInput> declare_round(const char* name, const char* help, Length length) {
  return Declaration<RoundInput>(name, help)
      .quantities("centre", &RoundInput::centre, "m", Bounds::any(), "Centre.", Presence::required, length)
      .quantity("radius", &RoundInput::radius, "m", Bounds::positive(), "Radius.", Presence::required);
}

struct HoleInput : Located {
  std::vector<Numbers> corners;
};
struct PolygonInput : Located {
  std::vector<Numbers> corners;
  std::vector<HoleInput> holes;
};

Corners corners_from(const std::vector<Numbers>& points) {
  Corners corners;
  for (const Numbers& x : points) corners.push_back(plane_vector(x));
  return corners;
}
std::vector<Corners> holes_of(const PolygonInput& in) {
  std::vector<Corners> holes;
  for (const HoleInput& hole : in.holes) holes.push_back(corners_from(hole.corners));
  return holes;
}

const Declaration<HoleInput>& hole_declaration() {
  static const auto d = Declaration<HoleInput>("hole", "A hole of a polygon.")
                            .points("corners", &HoleInput::corners, "m", "Corners of the hole in order, in either sense of rotation.",
                                    Presence::required, two);
  return d;
}

void check_polygon(const PolygonInput& in, Diagnostics& diagnostics) {
  for (const PolygonFault& fault : find_polygon_faults(corners_from(in.corners), holes_of(in))) {
    const char* why = "such loops do not bound an area";
    if (fault.loop < 0)
      diagnostics.add("corners", "the polygon " + fault.what, why, "list each corner once, in order along the boundary");
    else
      diagnostics.add(in.holes[fault.loop].at("corners"), fmt::format("hole {} {}", fault.loop + 1, fault.what), why,
                      "keep holes apart and strictly inside the polygon; cut notches with kind = \"difference\"");
  }
}

struct HalfPlaneInput : Located {
  Numbers point, normal;
};
struct PointInput : Located {
  Numbers at;
};
struct SpanInput : Located {  // line, cylinder
  Numbers from, to;
  double radius = 0;
};

void check_equal_length(const char* key, const Numbers& a, const Numbers& b, Diagnostics& diagnostics) {
  if (a.size() != b.size())
    diagnostics.add(key, fmt::format("{} has {} numbers and its partner {}", key, b.size(), a.size()), "both belong to one space",
                    "give two numbers each in 2D, three in 3D");
}

struct PartsInput : Located {
  std::vector<RegionPtr> of;
};
struct DifferenceInput : Located {
  RegionPtr of;
  std::vector<RegionPtr> without;
};
struct RotatedInput : Located {
  RegionPtr of;
  double angle = 0;
  Numbers about, axis;
};
struct TranslatedInput : Located {
  RegionPtr of;
  Numbers by;
};

Declaration<PartsInput> declare_parts(const char* name, const char* help, const char* part_help) {
  return Declaration<PartsInput>(name, help).one_of_list("of", &PartsInput::of, shapes, part_help, Presence::required, Length::at_least(1));
}

void add_plane_shapes(Family<RegionPtr>& family) {
  static const auto rectangle = declare_corners(
      "rectangle", "Rectangle with edges along the axes, boundary included; as a region also an edge (low and high equal on an axis).",
      two);
  family.add(rectangle, [](const CornersInput& in) -> RegionPtr {
    const auto [low, high] = corners_of<2>(in);
    return std::make_shared<Rectangle>(low, high);
  });

  static const auto disk = declare_round("disk", "Disk.", two);
  family.add(disk, [](const RoundInput& in) -> RegionPtr { return std::make_shared<Disk>(plane_vector(in.centre), in.radius); });

  static const auto ellipse =
      Declaration<EllipseInput>("ellipse", "Ellipse.")
          .quantities("centre", &EllipseInput::centre, "m", Bounds::any(), "Centre.", Presence::required, two)
          .quantities("semi_axes", &EllipseInput::semi_axes, "m", Bounds::positive(), "Half of each diameter.", Presence::required, two)
          .quantity("angle", &EllipseInput::angle, "rad", Bounds::any(), "From the x axis to the first semi-axis, counter-clockwise.");
  family.add(ellipse, [](const EllipseInput& in) -> RegionPtr {
    return std::make_shared<Ellipse>(plane_vector(in.centre), plane_vector(in.semi_axes), in.angle);
  });

  static const auto ring =
      Declaration<RingInput>("ring", "Area between two concentric circles.")
          .quantities("centre", &RingInput::centre, "m", Bounds::any(), "Centre.", Presence::required, two)
          .quantity("inner", &RingInput::inner, "m", Bounds::positive(), "Inner radius.", Presence::required)
          .quantity("outer", &RingInput::outer, "m", Bounds::positive(), "Outer radius.", Presence::required)
          .check([](const RingInput& in, Diagnostics& diagnostics) {
            if (in.inner >= in.outer)
              diagnostics.add("inner", "the inner radius is not below the outer one",
                              fmt::format("{} m >= {} m leaves no area", in.inner, in.outer), "make inner smaller than outer");
          });
  family.add(ring, [](const RingInput& in) -> RegionPtr { return std::make_shared<Ring>(plane_vector(in.centre), in.inner, in.outer); });

  static const auto sector =
      Declaration<SectorInput>("sector", "Slice of a disk, counter-clockwise from one angle to another.")
          .quantities("centre", &SectorInput::centre, "m", Bounds::any(), "Centre of the disk.", Presence::required, two)
          .quantity("radius", &SectorInput::radius, "m", Bounds::positive(), "Radius.", Presence::required)
          .quantity("from", &SectorInput::from, "rad", Bounds::any(), "Start, from the x axis, counter-clockwise.", Presence::required)
          .quantity("to", &SectorInput::to, "rad", Bounds::any(), "End, above `from` by at most a full turn.", Presence::required)
          .check([](const SectorInput& in, Diagnostics& diagnostics) {
            // A full turn given in degrees may exceed 2 pi by round-off.
            if (!(in.to > in.from) || in.to - in.from > 2 * pi * (1 + 1e-12))
              diagnostics.add("to", "`to` is not above `from` by at most a full turn", fmt::format("from {} to {} rad", in.from, in.to),
                              "add or subtract full turns (360 deg) until it is");
          });
  family.add(sector, [](const SectorInput& in) -> RegionPtr {
    return std::make_shared<Sector>(plane_vector(in.centre), in.radius, in.from, in.to);
  });

  static const auto polygon =
      Declaration<PolygonInput>("polygon", "Polygon, with holes if wanted; boundaries included.")
          .points("corners", &PolygonInput::corners, "m", "Corners in order, in either sense of rotation.", Presence::required, two)
          .records("holes", &PolygonInput::holes, hole_declaration, "Holes.")
          .check(check_polygon);
  family.add(polygon,
             [](const PolygonInput& in) -> RegionPtr { return std::make_shared<Polygon>(corners_from(in.corners), holes_of(in)); });
}

void add_solids(Family<RegionPtr>& family) {
  static const auto box = declare_corners(
      "box", "Box with edges along the axes, boundary included; as a region also a face or an edge (low and high equal on an axis).",
      three);
  family.add(box, [](const CornersInput& in) -> RegionPtr {
    const auto [low, high] = corners_of<3>(in);
    return std::make_shared<Box>(low, high);
  });

  static const auto sphere = declare_round("sphere", "Sphere.", three);
  family.add(sphere, [](const RoundInput& in) -> RegionPtr { return std::make_shared<Sphere>(space_vector(in.centre), in.radius); });

  static const auto cylinder =
      Declaration<SpanInput>("cylinder", "Right circular cylinder with flat ends.")
          .quantities("from", &SpanInput::from, "m", Bounds::any(), "Centre of one end.", Presence::required, three)
          .quantities("to", &SpanInput::to, "m", Bounds::any(), "Centre of the other end.", Presence::required, three)
          .quantity("radius", &SpanInput::radius, "m", Bounds::positive(), "Radius.", Presence::required)
          .check([](const SpanInput& in, Diagnostics& diagnostics) {
            if (in.from == in.to) diagnostics.add("to", "both ends are the same point", "the cylinder has no length", "move one end");
          });
  family.add(cylinder, [](const SpanInput& in) -> RegionPtr {
    return std::make_shared<Cylinder>(space_vector(in.from), space_vector(in.to), in.radius);
  });
}

void add_regions(Family<RegionPtr>& family) {
  static const auto everywhere = Declaration<NoInput>("everywhere", "All of the plane or of space.");
  family.add(everywhere, [](const NoInput&) -> RegionPtr { return std::make_shared<Everywhere>(); });

  static const auto half_plane =
      Declaration<HalfPlaneInput>("half_plane", "Everything on one side of a straight line (3D: of a plane), the line included.")
          .quantities("point", &HalfPlaneInput::point, "m", Bounds::any(), "A point on the line.", Presence::required, two_or_three)
          .quantities("normal", &HalfPlaneInput::normal, "1", Bounds::any(), "Direction out of the half-plane, of any length.",
                      Presence::required, two_or_three)
          .check([](const HalfPlaneInput& in, Diagnostics& diagnostics) {
            check_equal_length("normal", in.point, in.normal, diagnostics);
            if (zero(in.normal))
              diagnostics.add("normal", "the normal is zero", "it gives no direction", "give a direction such as [1, 0]");
          });
  family.add(half_plane, [](const HalfPlaneInput& in) -> RegionPtr {
    return std::make_shared<HalfPlane>(space_vector(in.point), space_vector(in.normal), dimension_of(in.point));
  });

  static const auto point = Declaration<PointInput>("point", "One point; as a region, the node or particle there.")
                                .quantities("at", &PointInput::at, "m", Bounds::any(), "The point.", Presence::required, two_or_three);
  family.add(point, [](const PointInput& in) -> RegionPtr { return std::make_shared<Point>(space_vector(in.at), dimension_of(in.at)); });

  static const auto line =
      Declaration<SpanInput>("line", "Straight segment between two points, both included; as a region, the nodes on it.")
          .quantities("from", &SpanInput::from, "m", Bounds::any(), "One end.", Presence::required, two_or_three)
          .quantities("to", &SpanInput::to, "m", Bounds::any(), "The other end.", Presence::required, two_or_three)
          .check([](const SpanInput& in, Diagnostics& diagnostics) { check_equal_length("to", in.from, in.to, diagnostics); });
  family.add(line, [](const SpanInput& in) -> RegionPtr {
    return std::make_shared<Line>(space_vector(in.from), space_vector(in.to), dimension_of(in.from));
  });
}

void add_combinations(Family<RegionPtr>& family) {
  static const auto joined = declare_parts("union", "Everything in at least one of several shapes.", "The shapes.");
  family.add(joined, [](const PartsInput& in) -> RegionPtr { return std::make_shared<Union>(std::move(in.of)); });

  static const auto common = declare_parts("intersection", "What several shapes have in common.", "The shapes.");
  family.add(common, [](const PartsInput& in) -> RegionPtr { return std::make_shared<Intersection>(std::move(in.of)); });

  static const auto difference =
      Declaration<DifferenceInput>("difference", "A shape without others; the new boundaries stay part of it.")
          .one_of("of", &DifferenceInput::of, shapes, "The shape to take away from.", Presence::required)
          .one_of_list("without", &DifferenceInput::without, shapes, "The shapes to take away.", Presence::required, Length::at_least(1));
  family.add(difference,
             [](const DifferenceInput& in) -> RegionPtr { return std::make_shared<Difference>(std::move(in.of), std::move(in.without)); });

  static const auto rotated =
      Declaration<RotatedInput>("rotated", "A shape turned about a point (3D: about an axis through it).")
          .one_of("of", &RotatedInput::of, shapes, "The shape to turn.", Presence::required)
          .quantity("angle", &RotatedInput::angle, "rad", Bounds::any(), "Counter-clockwise (3D: right-handed about the axis).",
                    Presence::required)
          .quantities("about", &RotatedInput::about, "m", Bounds::any(), "The point that stays.", Presence::required, two_or_three)
          .quantities("axis", &RotatedInput::axis, "1", Bounds::any(), "Direction of the axis in 3D, of any length; left out: z.", {},
                      three)
          .check([](const RotatedInput& in, Diagnostics& diagnostics) {
            if (!in.axis.empty() && zero(in.axis))
              diagnostics.add("axis", "the axis is zero", "it gives no direction", "give a direction such as [0, 0, 1]");
          });
  family.add(rotated, [](const RotatedInput& in) -> RegionPtr {
    return std::make_shared<Rotated>(std::move(in.of), in.angle, space_vector(in.about),
                                     in.axis.empty() ? Vec<3>{{0, 0, 1}} : space_vector(in.axis));
  });

  static const auto translated =
      Declaration<TranslatedInput>("translated", "A shape shifted.")
          .one_of("of", &TranslatedInput::of, shapes, "The shape to shift.", Presence::required)
          .quantities("by", &TranslatedInput::by, "m", Bounds::any(), "The shift.", Presence::required, two_or_three);
  family.add(translated,
             [](const TranslatedInput& in) -> RegionPtr { return std::make_shared<Translated>(std::move(in.of), space_vector(in.by)); });
}

Family<RegionPtr> make_family() {
  Family<RegionPtr> family("shape", "kind", "Shape of a body or region. Boundaries belong to shapes.");
  add_plane_shapes(family);
  add_solids(family);
  add_regions(family);
  add_combinations(family);
  return family;
}
}  // namespace

const Family<RegionPtr>& shapes() {
  static const Family<RegionPtr> family = make_family();
  return family;
}

}  // namespace crampon
