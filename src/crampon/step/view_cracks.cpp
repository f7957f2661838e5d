#include "crampon/step/view_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace crampon {

namespace {

std::vector<Vec<2>> segment_normals(const std::vector<Vec<2>>& vertices) {
  std::vector<Vec<2>> normals;
  for (std::size_t s = 0; s + 1 < vertices.size(); ++s) normals.push_back(segment_normal(vertices[s], vertices[s + 1]));
  return normals;
}

/// The vertices with what lies beyond them at ends that are no tips, straight on.
std::vector<Vec<2>> extended(const std::vector<Vec<2>>& vertices, const std::array<double, 2>& extension) {
  std::vector<Vec<2>> out;
  const std::size_t last = vertices.size() - 1;
  const auto beyond = [](const Vec<2>& end, const Vec<2>& before, double length) { return end + normalized(end - before) * length; };
  if (extension[0] > 0) out.push_back(beyond(vertices[0], vertices[1], extension[0]));
  out.insert(out.end(), vertices.begin(), vertices.end());
  if (extension[1] > 0) out.push_back(beyond(vertices[last], vertices[last - 1], extension[1]));
  return out;
}

SeenCrack with_extensions(const Crack<2>& crack) {
  std::vector<Vec<2>> plane = extended(crack.plane, crack.extension);
  std::vector<Vec<2>> normals = segment_normals(plane);
  return {std::move(plane), std::move(normals), segment_normals(extended(crack.original, crack.extension)), crack.closed};
}

/// A plane with what counts as lying on it.
struct Mirror {
  const SymmetryPlane& plane;
  double touching;  ///< m

  double height(const Vec<2>& x) const { return plane.side * (x[static_cast<std::size_t>(plane.axis)] - plane.at); }
  bool inside(const Vec<2>& x) const { return height(x) > touching; }
  Vec<2> image(Vec<2> x) const {
    auto& across = x[static_cast<std::size_t>(plane.axis)];
    across = 2 * plane.at - across;
    return x;
  }
  Vec<2> turned(Vec<2> n) const {
    n[static_cast<std::size_t>(plane.axis)] *= -1;
    return n;
  }
  /// Where the line from a point inside to one that is not meets the plane; none beside the plane's part.
  std::optional<Vec<2>> meeting(const Vec<2>& inner, const Vec<2>& outer) const {
    const double above = height(inner), below = std::fmax(-height(outer), 0.);
    Vec<2> x = std::fabs(height(outer)) <= touching ? outer : outer + (inner - outer) * (below / (above + below));
    x[static_cast<std::size_t>(plane.axis)] = plane.at;
    if (!on_plane<2>(plane, x)) return std::nullopt;
    return x;
  }
};

/// Walked the other way, above stays above its image.
SeenCrack image_of(const SeenCrack& crack, const Mirror& mirror) {
  SeenCrack out;
  out.closed = crack.closed;
  for (auto x = crack.vertices.rbegin(); x != crack.vertices.rend(); ++x) out.vertices.push_back(mirror.image(*x));
  for (auto n = crack.normals.rbegin(); n != crack.normals.rend(); ++n) out.normals.push_back(mirror.turned(*n));
  for (auto n = crack.original_normals.rbegin(); n != crack.original_normals.rend(); ++n) out.original_normals.push_back(mirror.turned(*n));
  return out;
}

void append(SeenCrack& crack, const SeenCrack& more) {
  crack.vertices.insert(crack.vertices.end(), more.vertices.begin() + 1, more.vertices.end());
  crack.normals.insert(crack.normals.end(), more.normals.begin(), more.normals.end());
  crack.original_normals.insert(crack.original_normals.end(), more.original_normals.begin(), more.original_normals.end());
}

/// Cuts off what lies beyond the mirror at the end of the path; false when nothing does, or the path ends elsewhere than on the mirror.
bool ends_on(SeenCrack& crack, const Mirror& mirror) {
  std::size_t last = crack.vertices.size() - 1;
  while (last > 0 && !mirror.inside(crack.vertices[last])) --last;
  if (last + 1 == crack.vertices.size() || !mirror.inside(crack.vertices[last])) return false;
  const auto end = mirror.meeting(crack.vertices[last], crack.vertices[last + 1]);
  if (!end) return false;
  crack.vertices.resize(last + 2);
  crack.vertices.back() = *end;
  crack.normals.resize(last + 1);
  crack.original_normals.resize(last + 1);
  return true;
}

void reverse(SeenCrack& crack) {
  std::reverse(crack.vertices.begin(), crack.vertices.end());
  std::reverse(crack.normals.begin(), crack.normals.end());
  std::reverse(crack.original_normals.begin(), crack.original_normals.end());
}

bool starts_on(SeenCrack& crack, const Mirror& mirror) {
  reverse(crack);
  const bool found = ends_on(crack, mirror);
  reverse(crack);
  return found;
}

/// A crack that ends on a mirror goes on as its image behind it: the two are one crack of the whole body. Does this one?
bool join_image(SeenCrack& crack, const Mirror& mirror) {
  if (crack.closed) return false;
  const bool at_end = ends_on(crack, mirror), at_start = starts_on(crack, mirror);
  if (!at_end && !at_start) return false;
  const SeenCrack image = image_of(crack, mirror);
  if (at_end) {
    append(crack, image);
    crack.closed = at_start;  // an arch and its image close
  } else {
    SeenCrack whole = image;
    append(whole, crack);
    crack = std::move(whole);
  }
  return true;
}

bool comes_near(const SeenCrack& crack, const Mirror& mirror, double reach) {
  const double low = -mirror.touching;
  bool near = false;
  for (const Vec<2>& x : crack.vertices) {
    if (mirror.height(x) < low) return false;  // partly behind the mirror, where there is no body: not a crack that has an image
    near = near || mirror.height(x) < reach;
  }
  return near;
}

}  // namespace

void view_cracks(State<2>& state, StepWork<2>& work, const Model<2>& model, int reach) {
  CrackView& view = work.crack_view;
  const std::size_t count = state.cracks.size();
  view.cracks = count;
  view.seen.assign(count * (1 + model.symmetries.size()), {});
  for (std::size_t c = 0; c < count; ++c) view.seen[c] = with_extensions(state.cracks.list[c]);
  for (std::size_t plane = 0; plane < model.symmetries.size(); ++plane) {
    const double cell = model.grid.cell[static_cast<std::size_t>(model.symmetries[plane].axis)];
    const Mirror mirror{model.symmetries[plane], 1e-8 * cell};
    for (std::size_t c = 0; c < count; ++c) {
      if (join_image(view.seen[c], mirror) || reach == 0 || !comes_near(view.seen[c], mirror, 2 * cell)) continue;
      view.seen[count * (1 + plane) + c] = image_of(view.seen[c], mirror);
    }
  }
  view.paths.clear();
  for (const SeenCrack& crack : view.seen) view.paths.push_back({crack.vertices, crack.normals, crack.closed, crack.original_normals});
  view.bins.build({model.grid.origin, model.grid.cell, model.grid.cells, reach, reach}, view.paths);
}

CrackId seen_in_mirror(const CrackView& view, CrackId crack, std::size_t plane) {
  const auto image_of_first = static_cast<CrackId>(view.cracks * (1 + plane));
  if (crack >= image_of_first && crack < image_of_first + view.cracks) return crack - image_of_first;
  if (crack >= view.cracks || view.seen[image_of_first + crack].vertices.empty()) return crack;
  return crack + image_of_first;
}

}  // namespace crampon
