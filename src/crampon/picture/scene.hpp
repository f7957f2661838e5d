#pragma once
/// What a picture of a snapshot shows, apart from its size. For the drawing files of this room only.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "crampon/picture/draw.hpp"
#include "crampon/picture/particle_shapes.hpp"

namespace crampon {

struct Scene {
  std::vector<ParticleShape> shapes;  ///< in the order to paint them; not of bodies that are drawn by their own shape
  std::vector<double> values;         ///< per point of the frame
  std::vector<double> height;         ///< per point of the frame: z, m; empty in the plane
  std::vector<int> body;              ///< per point of the frame; empty where the frame does not tell
  std::vector<bool> rigid_body;       ///< per body: it is drawn as a rigid one
  struct Surfaces {
    std::vector<std::array<double, 2>> upper, lower;
    std::size_t first_at_start = 0, last_at_start = 0;  ///< vertices between which the crack was there at the start
    bool has_grown() const { return first_at_start > 0 || last_at_start + 1 < upper.size(); }
  };
  std::vector<Surfaces> cracks;
  struct Tip {
    std::array<double, 2> at{}, ahead{};  ///< m; the way in which the crack goes on, of any length
    std::string name;
  };
  std::vector<Tip> tips;  ///< those that lie in a body
  struct Rigid {
    const RigidShape* shape = nullptr;
    RigidView view;
  };
  std::vector<Rigid> rigid;
  double time = 0;

  bool is_rigid(std::size_t point) const {
    return !body.empty() && body[point] >= 0 && static_cast<std::size_t>(body[point]) < rigid_body.size() &&
           rigid_body[static_cast<std::size_t>(body[point])];
  }
};

/// The snapshot must outlive the scene. quantity: what `values` are, without its values. Throws std::invalid_argument (see draw_frame).
Scene make_scene(const Snapshot& snapshot, const DrawOptions& options, PointValues& quantity);
PictureExtent extent_of(const Scene& scene);

/// The categories that a quantity's numbers stand for.
class Categories {
 public:
  /// Those of the quantity in all snapshots; none when it is no category.
  Categories(const std::vector<Snapshot>& snapshots, const std::vector<Scene>& scenes, const DrawOptions& options);
  bool empty() const { return entries_.empty(); }
  struct Entry {
    std::string name;
    Colour colour;
    bool rigid = false;  ///< hatched
  };
  const std::vector<Entry>& entries() const { return entries_; }
  /// Of a number of the quantity; NaN is magenta.
  Colour colour(double value) const;
  /// Of a rigid body or wall: its own where bodies are told apart.
  Colour of_rigid(const RigidShape& rigid) const;

 private:
  std::size_t add(const std::string& name, bool rigid);

  bool bodies_ = false;  // are what is told apart
  std::size_t coloured_ = 0;
  std::vector<Entry> entries_;
  std::map<double, std::size_t> entry_of_;
};

}  // namespace crampon
