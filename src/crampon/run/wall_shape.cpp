#include "crampon/run/wall_shape.hpp"

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

}  // namespace

RegionPtr wall_shape(const WallInput& wall, int dimension) {
  if (wall.kind == WallInput::Kind::half_space)
    return std::make_shared<HalfPlane>(vector_of(wall.point), vector_of(wall.normal), dimension);
  const Vec<3> centre = vector_of(wall.centre);
  RegionPtr ball = std::make_shared<Sphere>(centre, wall.radius.value_or(0));
  if (dimension == 2) ball = std::make_shared<Disk>(Vec<2>{{centre[0], centre[1]}}, wall.radius.value_or(0));
  if (wall.kind == WallInput::Kind::ball) return ball;
  return std::make_shared<Difference>(std::make_shared<Everywhere>(), std::vector<RegionPtr>{ball});
}

}  // namespace crampon
