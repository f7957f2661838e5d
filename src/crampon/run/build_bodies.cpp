#include "crampon/run/build_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

#include "crampon/geometry/fill.hpp"
#include "crampon/geometry/particles_csv.hpp"
#include "crampon/material/rigid.hpp"
#include "crampon/run/wall_shape.hpp"

namespace crampon {

namespace {

template <int Dim>
std::array<int, Dim> per_axis(const std::vector<std::int64_t>& given) {
  std::array<int, Dim> out;
  for (int k = 0; k < Dim; ++k) out[k] = static_cast<int>(given.size() == 1 ? given[0] : given[static_cast<std::size_t>(k)]);
  return out;
}

template <int Dim>
std::string text_of(const Vec<Dim>& x) {
  return Dim == 2 ? fmt::format("({:.6g}, {:.6g}) m", x[0], x[1]) : fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[Dim - 1]);
}

template <int Dim>
class BodyBuilder {
 public:
  BodyBuilder(const Problem& problem, const Grid<Dim>& grid, std::vector<Diagnostic>& errors)
      : problem_(problem), grid_(grid), errors_(errors) {}

  BuiltBodies<Dim> build() {
    for (std::size_t b = 0; b < problem_.bodies.size(); ++b) {
      const BodyInput& body = problem_.bodies[b];
      out_.per_cell.push_back(per_axis<Dim>(body.particles_per_cell));
      out_.on_lattice.push_back(body.shape != nullptr);
      const std::size_t first = out_.particles.size();
      const auto material = material_of(body, out_.per_cell.back(), field_of(body));
      if (body.shape) {
        fill(body, b, material);
      } else {
        read(body, b, material);
      }
      move(body, first);
      out_.names.push_back(body.name);
    }
    for (const RigidInput& in : problem_.rigids) add_rigid(in);
    for (const WallInput& in : problem_.walls) add_wall(in);
    refuse_unequal_bodies_in_a_field();
    return std::move(out_);
  }

 private:
  /// Where a field meets others, the edge of its bodies follows from the size of their particles, and areas from their thickness.
  void refuse_unequal_bodies_in_a_field() {
    const bool sizes_matter = out_.fields.size() > 1 || problem_.contact.detection == ContactDetection::position;
    for (std::size_t b = 0; b < problem_.bodies.size(); ++b) {
      const BodyInput& body = problem_.bodies[b];
      const std::uint16_t field = field_of(body);
      for (std::size_t a = 0; a < b; ++a) {
        const BodyInput& first = problem_.bodies[a];
        if (field_of(first) != field) continue;
        if (first.ignores_cracks != body.ignores_cracks) {
          errors_.push_back(
              {body.location,
               fmt::format("of the bodies \"{}\" and \"{}\" one ignores cracks, but they share a velocity field", first.name, body.name),
               "bodies of one field move as one", "give one a field of its own ([[body]] field, or contact.fields = \"bodies\")"});
        }
        if (!sizes_matter) continue;
        if (out_.per_cell[a] != out_.per_cell[b] || (Dim == 2 && first.thickness != body.thickness)) {
          errors_.push_back(
              {body.location,
               fmt::format("the bodies \"{}\" and \"{}\" share a velocity field but not their particles_per_cell and thickness", first.name,
                           body.name),
               "where they meet others, their edge is found from these",
               "make them equal, or give one a field of its own ([[body]] field, or contact.fields = \"bodies\")"});
        }
        break;
      }
    }
  }

  /// The velocity field of a body: its own word, or what contact.fields says.
  std::uint16_t field_of(const BodyInput& body) {
    std::string name;
    if (problem_.contact.fields == FieldsOf::materials) name = body.material;
    if (problem_.contact.fields == FieldsOf::bodies) name = body.name;
    if (body.field) name = *body.field;
    std::uint16_t field = 0;
    while (field < out_.fields.size() && out_.fields[field].name != name) ++field;
    if (field == out_.fields.size()) {
      add_field(name, Dim == 2 ? body.thickness : 1., out_.per_cell.back());
      out_.fields.back().ignores_cracks = body.ignores_cracks;
    }
    MaterialField& of_body = out_.fields[field];
    of_body.uneven_edge = std::max(of_body.uneven_edge, uneven_edge(body) * of_body.half_size);
    return field;
  }

  /// In half sizes of particles: the middle of one that follows the boundary lies up to 1.2 of them behind it (what it takes over of sub-cells without
  /// a particle is less than a fifth of one: geometry/fill.cpp), and domains do not change with what their particles stand for. A uniform stress
  /// rests between faces anywhere with these (UniformStress.RestsBetweenRigidFaces).
  double uneven_edge(const BodyInput& body) const {
    if (!body.match_mass.value_or(false)) return 1;
    return with_shape(problem_.method.shape_functions, []<class Shape>(std::type_identity<Shape>) { return double{Shape::uneven_edge}; });
  }

  std::uint16_t add_field(const std::string& name, double thickness, const std::array<int, Dim>& per_cell) {
    MaterialField field;
    field.name = name;
    field.thickness = thickness;
    std::array<double, Dim> half_size;
    for (int k = 0; k < Dim; ++k) half_size[k] = 0.5 / per_cell[k];
    field.half_size = *std::max_element(half_size.begin(), half_size.end());
    field.edge = EdgeMap(boxes_of(problem_.method.shape_functions), half_size);
    out_.fields.push_back(std::move(field));
    return static_cast<std::uint16_t>(out_.fields.size() - 1);
  }

  /// Centre, velocity and spin of a rigid body or wall; its field is made for it alone.
  RigidBody<Dim>& add_rigid_body(const std::string& name, const std::vector<ValueFunction>& velocity,
                                 const std::vector<ValueFunction>& spin, double thickness, const std::array<int, Dim>& per_cell) {
    RigidBody<Dim> body;
    body.name = name;
    body.velocity = velocity;
    body.spin = spin;
    body.field = add_field(name, thickness, per_cell);
    out_.fields.back().rigid = out_.fields.back().ignores_cracks = true;
    out_.fields.back().body = static_cast<int>(out_.rigid_bodies.size());
    out_.rigid_bodies.push_back(std::move(body));
    return out_.rigid_bodies.back();
  }

  void add_rigid(const RigidInput& in) {
    BodyInput as_body;
    static_cast<Located&>(as_body) = in;
    as_body.name = in.name;
    as_body.shape = in.shape;
    as_body.thickness = in.thickness;
    as_body.particles_per_cell = in.particles_per_cell;
    out_.per_cell.push_back(per_axis<Dim>(in.particles_per_cell));
    out_.on_lattice.push_back(true);
    RigidBody<Dim>& body = add_rigid_body(in.name, in.velocity, in.spin, Dim == 2 ? in.thickness : 1., out_.per_cell.back());
    using Acts = typename RigidBody<Dim>::Acts;
    using Faces = RigidInput::Faces;
    const bool literal = problem_.contact.scheme == ContactScheme::literal;
    const bool as_particles = in.faces.value_or(literal ? Faces::particles : Faces::shape) == Faces::particles;
    body.acts = in.role == RigidInput::Role::boundary ? Acts::nodes : as_particles ? Acts::particles : Acts::face;
    body.shape = in.shape;
    const std::size_t first = out_.particles.size();
    const auto material = add_material(std::make_shared<RigidMaterial>(), as_body, out_.per_cell.back(), body.field);
    fill(as_body, out_.names.size(), material, body.acts == Acts::face && may_be_empty(*in.shape));
    out_.names.push_back(in.name);
    body.is_empty = first == out_.particles.size();
    double volume = 0;
    for (std::size_t i = first; i < out_.particles.size(); ++i) {
      body.centre += out_.particles[i].x * out_.particles[i].volume;
      volume += out_.particles[i].volume;
    }
    if (!body.is_empty) {
      body.centre *= 1 / volume;
    } else {
      const Bounds3 bounds = in.shape->bounds();
      for (std::size_t k = 0; k < Dim; ++k) body.centre[k] = 0.5 * (bounds.low[k] + bounds.high[k]);
    }
    for (std::size_t k = 0; k < in.spin_centre.size(); ++k) body.centre[k] = in.spin_centre[k];
  }

  /// A rigid body so thin that no particle's place lies in it has a surface all the same. An intersection of shapes that do not meet has none:
  /// not one of many points of its box is in it.
  static bool may_be_empty(const Region& shape) {
    constexpr int side = 33;
    const Bounds3 box = shape.bounds();
    for (std::size_t k = 0; k < Dim; ++k) {
      if (!std::isfinite(box.low[k] + box.high[k])) return false;
    }
    for (int n = 0; n < power(side, Dim); ++n) {
      const IndexVector<Dim> at = unflatten<Dim>(n, side);
      Vec<3> x;
      for (std::size_t k = 0; k < Dim; ++k) x[k] = box.low[k] + (box.high[k] - box.low[k]) * at[static_cast<int>(k)] / (side - 1.);
      if (shape.contains(x)) return true;
    }
    return false;
  }

  void add_wall(const WallInput& in) {
    std::array<int, Dim> per_cell;
    per_cell.fill(2);
    RigidBody<Dim>& body = add_rigid_body(in.name, in.velocity, in.spin, HUGE_VAL, per_cell);
    const bool flat = in.kind == WallInput::Kind::half_space;
    const std::vector<double>& centre = flat ? in.point : in.centre;
    for (int k = 0; k < Dim; ++k) body.centre[k] = centre[static_cast<std::size_t>(k)];
    body.shape = wall_shape(in, Dim);
  }

  std::uint32_t material_of(const BodyInput& body, const std::array<int, Dim>& per_cell, std::uint16_t field) {
    const auto key = std::tuple{body.material, body.thickness, per_cell, field};
    const auto [at, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(out_.materials.size()));
    if (is_new) {
      for (const MaterialInput& in : problem_.materials) {
        if (in.name == body.material) add_material(in.law, body, per_cell, field);
      }
    }
    return at->second;
  }

  std::uint32_t add_material(const std::shared_ptr<const MaterialLaw>& law, const BodyInput& body, const std::array<int, Dim>& per_cell,
                             std::uint16_t field) {
    Material<Dim> m;
    m.law = law;
    m.thickness = Dim == 2 ? body.thickness : 1;
    for (int k = 0; k < Dim; ++k) m.half_size[k] = 0.5 / per_cell[k];
    m.field = field;
    out_.materials.push_back(std::move(m));
    return static_cast<std::uint32_t>(out_.materials.size() - 1);
  }

  void add(std::size_t b, std::uint32_t material, const Vec<3>& x, double volume, const Vec<3>& v) {
    NewParticle<Dim> p;
    for (int k = 0; k < Dim; ++k) p.x[k] = x[k], p.v[k] = v[k];
    p.volume = volume;
    p.mass = volume * out_.materials[material].law->density();
    p.material = material;
    p.body = static_cast<std::uint16_t>(b);
    out_.particles.push_back(p);
  }

  void fill(const BodyInput& body, std::size_t b, std::uint32_t material, bool may_be_empty = false) {
    FillGrid fill_grid;
    fill_grid.dimension = Dim;
    std::array<int, 3> per_cell{1, 1, 1};
    for (int k = 0; k < Dim; ++k) {
      fill_grid.origin[k] = grid_.origin[k];
      fill_grid.cell[k] = grid_.cell[k];
      fill_grid.cells[k] = grid_.cells[k];
      per_cell[k] = out_.per_cell[b][k];
    }
    const auto particles =
        fill_shape(*body.shape, fill_grid, per_cell, body.match_mass.value_or(false) ? FillMeasure::matched : FillMeasure::lattice);
    if (particles.empty() && !may_be_empty) {
      errors_.push_back({body.at("shape"), fmt::format("the body \"{}\" is empty", body.name), "no particle's place lies in its shape",
                         "enlarge the shape, use smaller cells or more particles_per_cell"});
      return;
    }
    const double thickness = out_.materials[material].thickness;
    for (const FilledParticle& p : particles) {
      add(b, material, p.position, p.measure * thickness, {});
      out_.particles.back().surface = surface_from(*body.shape, p.position, out_.per_cell[b]);
    }
  }

  /// From a particle's middle to the nearest point of its body's surface, m; zero where that is not its own.
  Vec<Dim> surface_from(const Region& shape, const Vec<3>& x, const std::array<int, Dim>& per_cell) const {
    Vec<Dim> to_surface;
    const double distance = shape.distance(x);
    if (distance < -depth_of_surface<Dim>(grid_, per_cell)) return to_surface;
    const Vec<3> out = shape.outward(x);
    const double depth = std::fmax(-distance, 1e-9 * grid_.smallest_cell());  // nothing is for those that lie deep
    for (int k = 0; k < Dim; ++k) to_surface[k] = depth * out[k];
    return to_surface;
  }

  void read(const BodyInput& body, std::size_t b, std::uint32_t material) {
    const auto path = std::filesystem::path(problem_.directory) / *body.particles;
    try {
      const ListedParticles listed = read_particles_csv(path.string(), Dim, body.at("particles"));
      for (const ListedParticle& p : listed.particles) {
        add(b, material, p.position, p.volume, p.velocity);
        for (int k = 0; k < Dim; ++k) out_.particles.back().surface[k] = std::numeric_limits<double>::quiet_NaN();
        if (grid_.contains(out_.particles.back().x)) continue;
        errors_.push_back({{path.string(), p.line, 1, body.location.where},
                           fmt::format("the particle at {} lies outside the grid", text_of(out_.particles.back().x)),
                           "",
                           "enlarge the grid or correct the file"});
        return;  // one such particle tells enough
      }
    } catch (const InputError& e) {
      errors_.insert(errors_.end(), e.diagnostics().begin(), e.diagnostics().end());
    }
  }

  /// Initial velocity and spin.
  void move(const BodyInput& body, std::size_t first) {
    Vec<Dim> centre;
    double mass = 0;
    for (std::size_t i = first; i < out_.particles.size(); ++i) {
      centre += out_.particles[i].x * out_.particles[i].mass;
      mass += out_.particles[i].mass;
    }
    if (mass > 0) centre *= 1 / mass;
    for (std::size_t k = 0; k < body.spin_centre.size(); ++k) centre[k] = body.spin_centre[k];
    for (std::size_t i = first; i < out_.particles.size(); ++i) {
      NewParticle<Dim>& p = out_.particles[i];
      for (std::size_t k = 0; k < body.velocity.size(); ++k) p.v[k] += body.velocity[k](0, in_space(p.x));
      const Vec<Dim> r = p.x - centre;
      if (Dim == 2 && body.spin.size() == 1) {
        p.v[0] -= body.spin[0] * r[1];
        p.v[1] += body.spin[0] * r[0];
      } else if (Dim == 3 && body.spin.size() == 3) {
        for (int k = 0; k < 3; ++k) {
          const int i1 = (k + 1) % 3, i2 = (k + 2) % 3;
          p.v[k % Dim] += body.spin[static_cast<std::size_t>(i1)] * r[i2 % Dim] - body.spin[static_cast<std::size_t>(i2)] * r[i1 % Dim];
        }
      }
    }
  }

  const Problem& problem_;
  const Grid<Dim>& grid_;
  std::vector<Diagnostic>& errors_;
  BuiltBodies<Dim> out_;
  std::map<std::tuple<std::string, double, std::array<int, Dim>, std::uint16_t>, std::uint32_t> known_;
};

}  // namespace

template <int Dim>
BuiltBodies<Dim> build_bodies(const Problem& problem, const Grid<Dim>& grid, std::vector<Diagnostic>& errors) {
  return BodyBuilder<Dim>(problem, grid, errors).build();
}

template BuiltBodies<2> build_bodies<2>(const Problem&, const Grid<2>&, std::vector<Diagnostic>&);
template BuiltBodies<3> build_bodies<3>(const Problem&, const Grid<3>&, std::vector<Diagnostic>&);

}  // namespace crampon
