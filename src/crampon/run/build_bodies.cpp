#include "crampon/run/build_bodies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

#include "crampon/geometry/fill.hpp"
#include "crampon/geometry/particles_csv.hpp"

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
      const auto material = material_of(body, out_.per_cell.back());
      if (body.shape) {
        fill(body, b, material);
      } else {
        read(body, b, material);
      }
      move(body, first);
    }
    return std::move(out_);
  }

 private:
  std::uint32_t material_of(const BodyInput& body, const std::array<int, Dim>& per_cell) {
    const auto key = std::tuple{body.material, body.thickness, per_cell};
    const auto [at, fresh] = known_.try_emplace(key, static_cast<std::uint32_t>(out_.materials.size()));
    if (fresh) {
      Material<Dim> m;
      for (const MaterialInput& in : problem_.materials) {
        if (in.name == body.material) m.law = in.law;
      }
      m.thickness = Dim == 2 ? body.thickness : 1;
      for (int k = 0; k < Dim; ++k) m.half_size[k] = 0.5 / per_cell[k];
      out_.materials.push_back(std::move(m));
    }
    return at->second;
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

  void fill(const BodyInput& body, std::size_t b, std::uint32_t material) {
    FillGrid fill_grid;
    fill_grid.dimension = Dim;
    std::array<int, 3> per_cell{1, 1, 1};
    for (int k = 0; k < Dim; ++k) {
      fill_grid.origin[k] = grid_.origin[k];
      fill_grid.cell[k] = grid_.cell[k];
      fill_grid.cells[k] = grid_.cells[k];
      per_cell[k] = out_.per_cell[b][k];
    }
    const auto particles = fill_shape(*body.shape, fill_grid, per_cell, body.match_mass ? FillMeasure::matched : FillMeasure::lattice);
    if (particles.empty()) {
      errors_.push_back({body.at("shape"), fmt::format("the body \"{}\" is empty", body.name), "no particle's place lies in its shape",
                         "enlarge the shape, use smaller cells or more particles_per_cell"});
      return;
    }
    const double thickness = out_.materials[material].thickness;
    for (const FilledParticle& p : particles) add(b, material, p.position, p.measure * thickness, {});
  }

  void read(const BodyInput& body, std::size_t b, std::uint32_t material) {
    const auto path = std::filesystem::path(problem_.directory) / *body.particles;
    try {
      const ListedParticles listed = read_particles_csv(path.string(), Dim, body.at("particles"));
      for (const ListedParticle& p : listed.particles) {
        add(b, material, p.position, p.volume, p.velocity);
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
  std::map<std::tuple<std::string, double, std::array<int, Dim>>, std::uint32_t> known_;
};

}  // namespace

template <int Dim>
BuiltBodies<Dim> build_bodies(const Problem& problem, const Grid<Dim>& grid, std::vector<Diagnostic>& errors) {
  return BodyBuilder<Dim>(problem, grid, errors).build();
}

template BuiltBodies<2> build_bodies<2>(const Problem&, const Grid<2>&, std::vector<Diagnostic>&);
template BuiltBodies<3> build_bodies<3>(const Problem&, const Grid<3>&, std::vector<Diagnostic>&);

}  // namespace crampon
