#include "crampon/run/rigid_shapes.hpp"

#include <memory>

#include "crampon/geometry/combine.hpp"
#include "crampon/geometry/flats.hpp"
#include "crampon/geometry/round.hpp"
#include "crampon/geometry/solids.hpp"

namespace crampon {
namespace {

Vec<3> vector_of(const std::vector<double>& components) {
  Vec<3> v;
  for (std::size_t k = 0; k < components.size() && k < 3; ++k) v[k] = components[k];
  return v;
}

RigidShape shape_of(const WallInput& wall, int dimension) {
  RigidShape out;
  out.name = wall.name;
  if (wall.kind == WallInput::Kind::half_space) {
    out.shape = std::make_shared<HalfPlane>(vector_of(wall.point), vector_of(wall.normal), dimension);
    return out;
  }
  const Vec<3> centre = vector_of(wall.centre);
  ShapePtr ball = std::make_shared<Sphere>(centre, wall.radius.value_or(0));
  if (dimension == 2) ball = std::make_shared<Disk>(Vec<2>{{centre[0], centre[1]}}, wall.radius.value_or(0));
  out.surface = ball->bounds();
  out.shape = ball;
  if (wall.kind == WallInput::Kind::hollow_ball)
    out.shape = std::make_shared<Difference>(std::make_shared<Everywhere>(), std::vector<ShapePtr>{ball});
  return out;
}

}  // namespace

std::vector<RigidShape> rigid_shapes(const Problem& problem, const PointFrame& frame) {
  std::vector<RigidShape> shapes;
  if (frame.rigid.size() != problem.rigids.size() + problem.walls.size()) return shapes;
  int body = static_cast<int>(problem.bodies.size());
  for (const RigidInput& rigid : problem.rigids) {
    const Bounds3 bounds = rigid.shape->bounds();
    RigidShape& shape = shapes.emplace_back(RigidShape{rigid.name, body++, rigid.shape});
    if (std::isfinite(bounds.low[0] + bounds.high[0] + bounds.low[1] + bounds.high[1])) shape.surface = bounds;
  }
  for (const WallInput& wall : problem.walls) shapes.push_back(shape_of(wall, problem.dimension()));
  for (std::size_t r = 0; r < shapes.size(); ++r) shapes[r].place = frame.rigid[r];
  return shapes;
}

}  // namespace crampon
