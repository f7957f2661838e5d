#include "crampon/run/build_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "crampon/run/find_faces.hpp"
#include "crampon/shape/registry.hpp"

namespace crampon {

namespace {

template <int Dim>
class LoadBuilder {
 public:
  LoadBuilder(const Problem& problem, const BuiltBodies<Dim>& bodies, const Cracks<Dim>& cracks, Model<Dim>& model,
              std::vector<Diagnostic>& errors)
      : problem_(problem), bodies_(bodies), cracks_(cracks), model_(model), errors_(errors) {}

  void add(const LoadInput& in) {
    using Kind = typename Load<Dim>::Kind;
    Load<Dim> load;
    load.name = in.name;
    const bool on_face = in.kind == LoadInput::Kind::traction || in.kind == LoadInput::Kind::pressure;
    if (on_face) load.kind = in.kind == LoadInput::Kind::pressure ? Kind::pressure : Kind::traction;
    for (int k = 0; k < Dim; ++k) {
      load.value.push_back(in.value.empty() ? ValueFunction()
                                            : in.value[std::min<std::size_t>(static_cast<std::size_t>(k), in.value.size() - 1)]);
    }
    if (!on_face) add_forces(in, load);
    model_.loads.push_back(std::move(load));
    const std::size_t columns = model_.faces.columns.size();
    if (on_face && !add_faces(in)) return;
    if (model_.loads.back().particles.empty() && model_.faces.columns.size() == columns) {
      errors_.push_back(
          {in.region ? in.at("region") : in.location, fmt::format("no particle carries the load \"{}\"", in.name),
           on_face ? "its face, region and body select none, and faces on symmetry planes bear nothing" : "its region and body select none",
           "enlarge the region or correct the body"});
    }
  }

  /// What refers to particles, once all columns are known.
  void finish() {
    LoadedFaces<Dim>& faces = model_.faces;
    for (const FaceLink& link : faces.links) faces.particles.push_back(link.particle);
    std::sort(faces.particles.begin(), faces.particles.end());
    faces.particles.erase(std::unique(faces.particles.begin(), faces.particles.end()), faces.particles.end());
    const auto number_of = [&](std::uint32_t id) {
      return static_cast<std::uint32_t>(std::lower_bound(faces.particles.begin(), faces.particles.end(), id) - faces.particles.begin());
    };
    faces.first_of.assign(faces.particles.size() + 1, 0);
    for (FaceLink& link : faces.links) {
      link.particle = number_of(link.particle);
      ++faces.first_of[link.particle + 1];
    }
    for (FaceColumn& column : faces.columns) column.surface = number_of(column.surface);
    for (std::size_t p = 0; p < faces.particles.size(); ++p) faces.first_of[p + 1] += faces.first_of[p];
    std::vector<std::uint32_t> next = faces.first_of;
    faces.by_particle.resize(faces.links.size());
    for (std::size_t i = 0; i < faces.links.size(); ++i) faces.by_particle[next[faces.links[i].particle]++] = static_cast<std::uint32_t>(i);
  }

 private:
  bool in_body(const LoadInput& in, std::size_t body) const {
    return body < problem_.bodies.size() && (in.body.empty() || problem_.bodies[body].name == in.body);  // the others are rigid
  }
  bool in_region(const LoadInput& in, const Vec<Dim>& x) const {
    return !in.region || in.region->contains(in_space(x), 1e-9 * model_.grid.smallest_cell());
  }

  void add_forces(const LoadInput& in, Load<Dim>& load) const {
    double volume = 0;
    for (std::size_t i = 0; i < bodies_.particles.size(); ++i) {
      if (!in_body(in, bodies_.particles[i].body) || !in_region(in, bodies_.particles[i].x)) continue;
      load.particles.push_back(static_cast<std::uint32_t>(i));
      volume += bodies_.particles[i].volume;
    }
    for (const std::uint32_t i : load.particles) {
      load.share.push_back(in.kind == LoadInput::Kind::total_force ? bodies_.particles[i].volume / volume : 1.);
    }
  }

  /// False after an error.
  bool add_faces(const LoadInput& in) {
    for (std::size_t b = 0; b < problem_.bodies.size(); ++b) {
      if (!in_body(in, b)) continue;
      if (!bodies_.on_lattice[b]) {
        errors_.push_back({in.face ? in.at("face") : in.location,
                           fmt::format("the body \"{}\" comes from a file and has no faces", problem_.bodies[b].name),
                           "tractions act on the faces of filled shapes", "use force_each on a region instead"});
        return false;
      }
      const auto [lattice, is_new] = lattices_.try_emplace(b, bodies_, model_.grid, b);
      for (const OuterFace<Dim>& face : find_outer_faces(lattice->second, bodies_, *problem_.bodies[b].shape, model_.symmetries)) {
        if (in.face && !looks(face, lattice->second, (*in.face)[0] - 'x', (*in.face)[1] == '+' ? 1 : -1)) continue;
        if (in_region(in, bodies_.particles[face.particle].x) || in_region(in, face.point)) add_column(in, lattice->second, face);
      }
    }
    return true;
  }

  /// Does the boundary look that way, and is nothing of the body in front of it?
  bool looks(const OuterFace<Dim>& face, const BodyLattice<Dim>& lattice, int axis, int direction) const {
    constexpr double upright = 0.01;  // sides that lean by less than half a degree are upright
    if (face.normal[axis] * direction < upright) return false;
    IndexVector<Dim> beside = lattice.index_of(bodies_.particles[face.particle].x);
    beside[face.axis] += face.direction;
    return lattice.is_open(beside, axis, direction);
  }

  void add_column(const LoadInput& in, const BodyLattice<Dim>& lattice, const OuterFace<Dim>& face) {
    LoadedFaces<Dim>& faces = model_.faces;
    const double size = lattice.size(face.axis), cell = model_.grid.cell[face.axis];
    // Nodes at the face reach particles as deep as twice that, and the ramp behind them takes a cell.
    const double half_size = 0.5 * size / cell;
    const double reach = with_shape(problem_.method.shape_functions,
                                    [half_size]<class Shape>(std::type_identity<Shape>) { return double{Shape::reach(half_size)}; });
    const double flat = (2 * reach + 1) * cell, end = flat + cell;
    FaceColumn column;
    column.load = static_cast<std::uint32_t>(model_.loads.size() - 1);
    column.surface = face.particle;
    column.axis = static_cast<std::uint8_t>(face.axis);
    column.direction = face.direction;
    column.first_link = static_cast<std::uint32_t>(faces.links.size());
    if (in.kind == LoadInput::Kind::traction) column.share = std::fabs(face.normal[face.axis]);
    const bool ends = follow_row(lattice, face, end);
    column.end_link = static_cast<std::uint32_t>(faces.links.size());
    const std::uint32_t count = column.end_link - column.first_link;
    const double length = count * size;
    for (std::uint32_t i = 0; i < count; ++i) {
      FaceLink& link = faces.links[column.first_link + i];
      const double V = bodies_.particles[link.particle].volume;
      link.column = static_cast<std::uint32_t>(faces.columns.size());
      link.depth = (i + 0.5) * size;
      link.ends = ends;
      const double from = ends ? flat : 0., to = ends ? end : length;  // where phi falls
      const bool falls = link.depth > from;
      link.flux = falls ? V * std::max(0., (to - link.depth) / (to - from)) : V;
      link.source = falls && link.depth < to ? V / (to - from) : 0.;
    }
    column.area = middle_of_row(lattice, face) / size;
    faces.columns.push_back(column);
  }

  /// What the middle of a row stands for, m3: particles at its ends may stand for parts of their sub-cells, and for parts of others beside them. Of the
  /// whole row, so that both of its ends have one area, and a pressure all around a body no resultant.
  double middle_of_row(const BodyLattice<Dim>& lattice, const OuterFace<Dim>& face) const {
    std::vector<double> volumes;
    IndexVector<Dim> i = lattice.index_of(bodies_.particles[face.particle].x);
    for (std::uint32_t p = face.particle; p != BodyLattice<Dim>::none; i[face.axis] -= face.direction, p = lattice.at(i))
      volumes.push_back(bodies_.particles[p].volume);
    return 0.5 * (volumes[(volumes.size() - 1) / 2] + volumes[volumes.size() / 2]);
  }

  /// Adds the row of particles behind a face as links, in a mirror if it meets one. Does it go on to this depth?
  bool follow_row(const BodyLattice<Dim>& lattice, const OuterFace<Dim>& face, double depth) {
    const double size = lattice.size(face.axis);
    const auto enough = static_cast<int>(std::ceil(depth / size - 1e-9));
    IndexVector<Dim> i = lattice.index_of(bodies_.particles[face.particle].x);
    int step = -face.direction, count = 0;
    bool mirrored = false;
    for (std::uint32_t p = face.particle; count < enough;) {
      FaceLink link;
      link.particle = p;
      link.mirrored = mirrored;
      model_.faces.links.push_back(link);
      ++count;
      Vec<Dim> middle = lattice.centre(i);
      i[face.axis] += step;
      const std::uint32_t next = lattice.at(i);
      if (next != BodyLattice<Dim>::none) {
        if (is_cut(bodies_.particles[p].x, bodies_.particles[next].x)) break;
        p = next;
        continue;
      }
      middle[face.axis] += 0.5 * step * size;
      if (mirrored || !plane_of_face(model_.symmetries, middle, face.axis, 1e-6 * size)) break;
      mirrored = true;  // the same particle again, as its own image
      i[face.axis] -= step;
      step = -step;
    }
    return count == enough;
  }

  /// Does a crack lie between two particles?
  bool is_cut(const Vec<Dim>& a, const Vec<Dim>& b) const {
    if constexpr (Dim == 2) {
      const auto sign = [](double s) { return (s > 0) - (s < 0); };
      for (const auto& crack : cracks_.list) {
        for (const auto& facet : crack.facets) {
          const Vec<2>&p = crack.plane[facet[0]], &q = crack.plane[facet[1]];
          if (sign(cross(b - a, p - a)) * sign(cross(b - a, q - a)) <= 0 && sign(cross(q - p, a - p)) * sign(cross(q - p, b - p)) < 0)
            return true;
        }
      }
    }
    return false;
  }

  const Problem& problem_;
  const BuiltBodies<Dim>& bodies_;
  const Cracks<Dim>& cracks_;
  Model<Dim>& model_;
  std::vector<Diagnostic>& errors_;
  std::map<std::size_t, BodyLattice<Dim>> lattices_;  ///< per body
};

}  // namespace

template <int Dim>
void build_loads(const Problem& problem, const BuiltBodies<Dim>& bodies, const Cracks<Dim>& cracks, Model<Dim>& model,
                 std::vector<Diagnostic>& errors) {
  LoadBuilder<Dim> builder(problem, bodies, cracks, model, errors);
  for (const LoadInput& in : problem.loads) builder.add(in);
  builder.finish();
}

template void build_loads<2>(const Problem&, const BuiltBodies<2>&, const Cracks<2>&, Model<2>&, std::vector<Diagnostic>&);
template void build_loads<3>(const Problem&, const BuiltBodies<3>&, const Cracks<3>&, Model<3>&, std::vector<Diagnostic>&);

}  // namespace crampon
