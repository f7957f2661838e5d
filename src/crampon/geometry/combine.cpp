#include "crampon/geometry/combine.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace crampon {
namespace {
int dimension_of(const std::vector<RegionPtr>& parts) {
  int dimension = 0;
  for (const RegionPtr& part : parts) dimension = std::max(dimension, part->dimension());
  return dimension;
}

// The part whose distance comes before those of all others; of equals the first.
template <class Before>
const Region& foremost(const std::vector<RegionPtr>& parts, const Vec<3>& x, Before before) {
  const Region* found = parts.front().get();
  double distance = found->distance(x);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const double other = parts[k]->distance(x);
    if (!before(other, distance)) continue;
    found = parts[k].get();
    distance = other;
  }
  return *found;
}
}  // namespace

Union::Union(std::vector<RegionPtr> parts) : parts_(std::move(parts)) {}

double Union::distance(const Vec<3>& x) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const RegionPtr& part : parts_) nearest = std::min(nearest, part->distance(x));
  return nearest;
}

Vec<3> Union::outward(const Vec<3>& x) const { return foremost(parts_, x, std::less<>()).outward(x); }

bool Union::contains(const Vec<3>& x, double slack) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const RegionPtr& part) { return part->contains(x, slack); });
}

Bounds3 Union::bounds() const {
  Bounds3 box = parts_.front()->bounds();
  for (const RegionPtr& part : parts_) {
    const Bounds3 other = part->bounds();
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], other.low[k]);
      box.high[k] = std::max(box.high[k], other.high[k]);
    }
  }
  return box;
}

std::optional<double> Union::measure() const { return parts_.size() == 1 ? parts_.front()->measure() : std::nullopt; }
int Union::dimension() const { return dimension_of(parts_); }

Intersection::Intersection(std::vector<RegionPtr> parts) : parts_(std::move(parts)) {}

double Intersection::distance(const Vec<3>& x) const {
  double furthest = -std::numeric_limits<double>::infinity();
  for (const RegionPtr& part : parts_) furthest = std::max(furthest, part->distance(x));
  return furthest;
}

Vec<3> Intersection::outward(const Vec<3>& x) const { return foremost(parts_, x, std::greater<>()).outward(x); }

bool Intersection::contains(const Vec<3>& x, double slack) const {
  return std::all_of(parts_.begin(), parts_.end(), [&](const RegionPtr& part) { return part->contains(x, slack); });
}

Bounds3 Intersection::bounds() const {
  Bounds3 box = parts_.front()->bounds();
  for (const RegionPtr& part : parts_) {
    const Bounds3 other = part->bounds();
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::max(box.low[k], other.low[k]);
      box.high[k] = std::min(box.high[k], other.high[k]);
    }
  }
  return box;
}

std::optional<double> Intersection::measure() const { return parts_.size() == 1 ? parts_.front()->measure() : std::nullopt; }
int Intersection::dimension() const { return dimension_of(parts_); }

Difference::Difference(RegionPtr whole, std::vector<RegionPtr> taken_away) : whole_(std::move(whole)), taken_away_(std::move(taken_away)) {}

double Difference::distance(const Vec<3>& x) const {
  double furthest = whole_->distance(x);
  for (const RegionPtr& part : taken_away_) furthest = std::max(furthest, -part->distance(x));
  return furthest;
}

Vec<3> Difference::outward(const Vec<3>& x) const {
  const Region& part = foremost(taken_away_, x, std::less<>());
  return whole_->distance(x) >= -part.distance(x) ? whole_->outward(x) : -part.outward(x);
}

int Difference::dimension() const { return std::max(whole_->dimension(), dimension_of(taken_away_)); }

}  // namespace crampon
