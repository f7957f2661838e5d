#include "crampon/step/crack_images.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

// A path that meets a mirror is cut there and goes on as its image. Paths are ordered, so that these work on vertices alone and number the
// facets anew.

void append(SeenCrack<2>& crack, const SeenCrack<2>& more) {
  crack.vertices.insert(crack.vertices.end(), more.vertices.begin() + 1, more.vertices.end());
  crack.normals.insert(crack.normals.end(), more.normals.begin(), more.normals.end());
  crack.original_normals.insert(crack.original_normals.end(), more.original_normals.begin(), more.original_normals.end());
}

/// Cuts off what lies beyond the mirror at the end of the path; false when nothing does, or the path ends elsewhere than on the mirror.
bool ends_on(SeenCrack<2>& crack, const Mirror<2>& mirror) {
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

void reverse(SeenCrack<2>& crack) {
  std::reverse(crack.vertices.begin(), crack.vertices.end());
  std::reverse(crack.normals.begin(), crack.normals.end());
  std::reverse(crack.original_normals.begin(), crack.original_normals.end());
}

bool starts_on(SeenCrack<2>& crack, const Mirror<2>& mirror) {
  reverse(crack);
  const bool found = ends_on(crack, mirror);
  reverse(crack);
  return found;
}

bool join_image_of_path(SeenCrack<2>& crack, const Mirror<2>& mirror) {
  if (crack.closed) return false;
  const bool at_end = ends_on(crack, mirror), at_start = starts_on(crack, mirror);
  if (!at_end && !at_start) return false;
  crack.facets = path_facets(crack.vertices.size());
  const SeenCrack<2> image = image_of(crack, mirror);
  if (at_end) {
    append(crack, image);
    crack.closed = at_start;  // an arch and its image close
  } else {
    SeenCrack<2> whole = image;
    append(whole, crack);
    crack = std::move(whole);
  }
  crack.facets = path_facets(crack.vertices.size());
  return true;
}

}  // namespace

template <int Dim>
std::optional<Vec<Dim>> Mirror<Dim>::meeting(const Vec<Dim>& inner, const Vec<Dim>& outer) const {
  const double above = height(inner), below = std::fmax(-height(outer), 0.);
  Vec<Dim> x = std::fabs(height(outer)) <= touching ? outer : outer + (inner - outer) * (below / (above + below));
  x[static_cast<std::size_t>(plane.axis)] = plane.at;
  if (!on_plane<Dim>(plane, x)) return std::nullopt;
  return x;
}

template <int Dim>
SeenCrack<Dim> image_of(const SeenCrack<Dim>& crack, const Mirror<Dim>& mirror) {
  SeenCrack<Dim> out;
  out.closed = crack.closed;
  const auto last = static_cast<VertexId>(crack.vertices.size()) - 1;
  for (auto x = crack.vertices.rbegin(); x != crack.vertices.rend(); ++x) out.vertices.push_back(mirror.image(*x));
  for (auto f = crack.facets.rbegin(); f != crack.facets.rend(); ++f) {
    Facet<Dim> facet;
    for (std::size_t v = 0; v < Dim; ++v) facet[v] = last - (*f)[Dim - 1 - v];
    out.facets.push_back(facet);
  }
  for (auto n = crack.normals.rbegin(); n != crack.normals.rend(); ++n) out.normals.push_back(mirror.turned(*n));
  for (auto n = crack.original_normals.rbegin(); n != crack.original_normals.rend(); ++n) out.original_normals.push_back(mirror.turned(*n));
  return out;
}

template <int Dim>
bool comes_near(const SeenCrack<Dim>& crack, const Mirror<Dim>& mirror, double reach) {
  const double low = -mirror.touching;
  bool near = false;
  for (const Vec<Dim>& x : crack.vertices) {
    if (mirror.height(x) < low) return false;
    near = near || mirror.height(x) < reach;
  }
  return near;
}

template <int Dim>
bool join_image(SeenCrack<Dim>& crack, const Mirror<Dim>& mirror) {
  if constexpr (Dim == 2) return join_image_of_path(crack, mirror);
  return false;
}

std::vector<Vec<2>> extended(const std::vector<Vec<2>>& vertices, const std::array<double, 2>& extension) {
  std::vector<Vec<2>> out;
  const std::size_t last = vertices.size() - 1;
  const auto beyond = [](const Vec<2>& end, const Vec<2>& before, double length) { return end + normalized(end - before) * length; };
  if (extension[0] > 0) out.push_back(beyond(vertices[0], vertices[1], extension[0]));
  out.insert(out.end(), vertices.begin(), vertices.end());
  if (extension[1] > 0) out.push_back(beyond(vertices[last], vertices[last - 1], extension[1]));
  return out;
}

#define CRAMPON_INSTANTIATE(DIM)                                                    \
  template struct Mirror<DIM>;                                                      \
  template SeenCrack<DIM> image_of<DIM>(const SeenCrack<DIM>&, const Mirror<DIM>&); \
  template bool comes_near<DIM>(const SeenCrack<DIM>&, const Mirror<DIM>&, double); \
  template bool join_image<DIM>(SeenCrack<DIM>&, const Mirror<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
