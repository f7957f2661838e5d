#include "crampon/run/crack_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crampon/crack/symmetry_fold.hpp"
#include "crampon/step/crack_images.hpp"

namespace crampon {

namespace {

/// Where on [0, 1] something that holds at `a` and not at `b` ceases to hold.
template <class Holds>
double border(double a, double b, Holds holds) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (a + b);
    (holds(middle) ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

Material2D::Material2D(const Problem& problem, const BuiltBodies<2>& bodies, const Grid<2>& grid)
    : cell_(grid.largest_cell()),
      reach_(reach_beyond_edges(with_shape(problem.method.shape_functions, []<class Shape>(std::type_identity<Shape>) {
        return double{Shape::reach(largest_half_extent)};
      }))) {
  std::vector<bool> listed(problem.bodies.size());
  for (std::size_t b = 0; b < problem.bodies.size(); ++b) {
    if (problem.bodies[b].ignores_cracks) continue;
    if (problem.bodies[b].shape) {
      shapes_.push_back(problem.bodies[b].shape);
    } else {
      listed[b] = true;
    }
  }
  for (const NewParticle<2>& p : bodies.particles) {
    if (p.body >= listed.size() || !listed[p.body]) continue;
    const Vec<2> half{{0.5 * grid.cell[0] / bodies.per_cell[p.body][0], 0.5 * grid.cell[1] / bodies.per_cell[p.body][1]}};
    particles_.push_back({p.x - half, p.x + half});
    widest_ = std::fmax(widest_, 2 * half[0]);
  }
  std::sort(particles_.begin(), particles_.end(), [](const Box& a, const Box& b) { return a.low[0] < b.low[0]; });
}

bool Material2D::at(const Vec<2>& x) const {
  const double slack = 1e-9 * cell_;
  for (const RegionPtr& shape : shapes_) {
    if (shape->contains(in_space(x), slack)) return true;
  }
  const auto first = std::lower_bound(particles_.begin(), particles_.end(), x[0] - widest_ - slack,
                                      [](const Box& box, double low) { return box.low[0] < low; });
  for (auto box = first; box != particles_.end() && box->low[0] <= x[0] + slack; ++box) {
    if (box->high[0] >= x[0] - slack && box->low[1] <= x[1] + slack && box->high[1] >= x[1] - slack) return true;
  }
  return false;
}

std::array<double, 2> extensions(const Crack<2>& crack, const Material2D& material) {
  if (crack.closed) return {};
  const auto beyond = [&](const Vec<2>& end, const Vec<2>& before) {
    const Vec<2> out = normalized(end - before);
    const auto free = [&](double distance) { return !material.at(end + out * distance); };
    if (!free(material.hair())) return 0.;
    double length = material.hair();
    for (const double longest = material.reach(), step = 0.05 * material.cell(); length < longest; length += step) {
      if (!free(length + step)) return border(length, length + step, free) - material.hair();
    }
    return length;
  };
  const std::size_t last = crack.plane.size() - 1;
  return {beyond(crack.plane[0], crack.plane[1]), beyond(crack.plane[last], crack.plane[last - 1])};
}

std::array<std::uint8_t, 2> mirrored_ends(const Crack<2>& crack, const Model<2>& model) {
  if (crack.closed) return {};
  const auto axes = [&](const Vec<2>& end) {
    unsigned out = 0;
    for (const SymmetryPlane& mirror : model.symmetries) {
      Vec<2> on = end;
      on[static_cast<std::size_t>(mirror.axis)] = mirror.at;
      if (norm(end - on) < 1e-8 * model.grid.smallest_cell() && on_plane<2>(mirror, on)) out |= 1u << mirror.axis;
    }
    return static_cast<std::uint8_t>(out);
  };
  return {axes(crack.plane.front()), axes(crack.plane.back())};
}

std::vector<bool> between_material(const Crack<2>& crack, const Material2D& material) {
  std::vector<bool> out;
  for (std::size_t v = 0; v < crack.plane.size(); ++v) {
    const std::size_t s = std::min(v, crack.plane.size() - 2);
    const Vec<2> beside = segment_normal(crack.plane[s], crack.plane[s + 1]) * material.hair();
    out.push_back(material.at(crack.plane[v] + beside) && material.at(crack.plane[v] - beside));
  }
  return out;
}

std::vector<double> areas_between(const Crack<2>& crack, const std::vector<bool>& bears, const Material2D& material) {
  std::vector<double> area(crack.plane.size(), 0.);
  for (std::size_t v = 0; v + 1 < crack.plane.size(); ++v) {
    if (!bears[v] || !bears[v + 1]) continue;
    const Vec<2>&a = crack.plane[v], &b = crack.plane[v + 1];
    const Vec<2> beside = segment_normal(a, b) * material.hair();
    const auto between = [&](double s) {
      const Vec<2> x = a + (b - a) * s;
      return material.at(x + beside) && material.at(x - beside);
    };
    const double length = norm(b - a);
    const auto add = [&](double from, double to) {  // int (1 - s) ds and int s ds
      const double to_b = 0.5 * (to * to - from * from);
      area[v] += length * (to - from - to_b);
      area[v + 1] += length * to_b;
    };
    constexpr int parts = 16;
    double from = 0;
    bool was = between(1e-6);  // the very ends may lie on a corner
    for (int i = 1; i <= parts; ++i) {
      const double s = i == parts ? 1 - 1e-6 : static_cast<double>(i) / parts, before = i == 1 ? 1e-6 : static_cast<double>(i - 1) / parts;
      const bool is = between(s);
      if (is != was) {
        const double at = was ? border(before, s, between) : border(s, before, between);
        if (was) add(from, at);
        from = at;
      }
      was = is;
    }
    if (was) add(from, 1);
  }
  return area;
}

}  // namespace crampon
