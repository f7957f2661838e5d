#pragma once
/// The space that a body takes at the start.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "crampon/input/problem.hpp"
#include "crampon/state/state.hpp"
#include "crampon/step/model.hpp"

namespace crampon {

/// The shape of a body, or for particles from a file the boxes around them.
template <int Dim>
class BodySpace {
 public:
  /// stated, shape: of the input; shape may be null. Particles are added afterwards.
  BodySpace(std::string name, const Located& stated, RegionPtr shape, const Grid<Dim>& grid)
      : name_(std::move(name)), stated_(&stated), shape_(std::move(shape)), grid_(&grid) {}

  /// slot: of the particle; half: half the edges of its box, m; measure: area (m2) or volume (m3).
  void add(std::uint32_t slot, const Vec<Dim>& x, const Vec<Dim>& half, double measure);
  void set_field(std::uint16_t field) { field_ = field; }

  const std::string& name() const { return name_; }
  const Located& stated() const { return *stated_; }
  const RegionPtr& shape() const { return shape_; }
  std::uint16_t field() const { return field_; }  ///< velocity field

  struct Particle {
    std::uint32_t slot = 0;
    Vec<Dim> x;     ///< m
    Vec<Dim> half;  ///< half the edges of its box, m
    double measure = 0;
  };
  const std::vector<Particle>& particles() const { return particles_; }
  double measure() const { return measure_; }  ///< of all particles
  /// Bounds of the boxes of its particles.
  const Vec<Dim>& low() const { return low_; }
  const Vec<Dim>& high() const { return high_; }

  /// Is x in the body, or within slack (m) of it?
  bool contains(const Vec<Dim>& x, double slack) const;
  /// How far x is outside the body, m; not above zero inside. Slow for particles from a file.
  double distance(const Vec<Dim>& x) const;

 private:
  std::int64_t cell_of(const Vec<Dim>& x, const IndexVector<Dim>& shift) const;

  std::string name_;
  const Located* stated_;
  RegionPtr shape_;
  const Grid<Dim>* grid_;
  std::vector<Particle> particles_;
  double measure_ = 0;
  std::uint16_t field_ = 0;
  Vec<Dim> low_, high_;
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> by_cell_;  // without a shape: particles in each cell
};

/// Bodies, then rigid bodies of particles: as Particles::body counts.
template <int Dim>
std::vector<BodySpace<Dim>> find_body_spaces(const Problem& problem, const Model<Dim>& model, const State<Dim>& state);

/// Is a body with this place in the list rigid?
inline bool is_rigid_body(const Problem& problem, std::size_t body) { return body >= problem.bodies.size(); }

}  // namespace crampon
