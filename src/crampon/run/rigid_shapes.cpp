#include "crampon/run/rigid_shapes.hpp"

#include <cmath>

#include "crampon/run/wall_shape.hpp"

namespace crampon {
namespace {

RigidShape shape_of(const WallInput& wall, int dimension) {
  RigidShape out;
  out.name = wall.name;
  out.shape = wall_shape(wall, dimension);
  if (wall.kind == WallInput::Kind::half_space) return out;
  WallInput ball = wall;
  ball.kind = WallInput::Kind::ball;
  out.surface = wall_shape(ball, dimension)->bounds();
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
