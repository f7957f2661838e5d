#include "crampon/run/sample.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "crampon/core/parallel.hpp"
#include "crampon/step/move_cracks.hpp"

namespace crampon {

namespace {

/// Past the largest id.
template <int Dim>
std::size_t id_end(const State<Dim>& state) {
  return state.order.particle_count + static_cast<std::size_t>(state.ledger.removed);
}

/// Rows of a frame, which stand in the order of ids.
struct Rows {
  std::size_t count;
  std::vector<std::uint32_t> of_id;  ///< empty where no particle was removed: row and id are one

  std::size_t operator[](std::uint32_t id) const { return of_id.empty() ? id : of_id[id]; }
};

template <int Dim>
Rows find_rows(const State<Dim>& state) {
  if (state.ledger.removed == 0) return {state.order.particle_count, {}};
  std::vector<std::uint32_t> of_id(id_end(state), 0);
  for (const std::uint32_t id : state.particles.id) {
    if (id != padding_id) of_id[id] = 1;
  }
  std::uint32_t count = 0;
  for (std::uint32_t& row : of_id) count += std::exchange(row, count);
  return {count, std::move(of_id)};
}

/// All that a quantity may be made from, for one particle.
struct Sample {
  Vec<3> x, X, v;
  double stress[6];  ///< Cauchy, xx, yy, zz, xy, yz, xz
  double strain[6];
  double energy, volume, mass, volume_ratio;
  int body, material;
  std::uint32_t id;
};

struct Quantity {
  QuantityDescription is;
  std::function<void(const Sample&, double*)> get;
};

double mean_stress(const Sample& s) { return (s.stress[0] + s.stress[1] + s.stress[2]) / 3; }

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> list = {
      {{"velocity", "m/s", 3, true, "velocity", "v"}, [](const Sample& s, double* o) { std::copy_n(s.v.c.data(), 3, o); }},
      {{"displacement", "m", 3, true, "way from where the particle began", "u = x - X"},
       [](const Sample& s, double* o) {
         for (std::size_t k = 0; k < 3; ++k) o[k] = s.x[k] - s.X[k];
       }},
      {{"stress", "Pa", 6, true, "Cauchy stress, tension positive", "sigma = tau / J, tau by the law of the material"},
       [](const Sample& s, double* o) { std::copy_n(s.stress, 6, o); }},
      {{"strain", "1", 6, false, "strain as the law of the material measures it; tensor components, not engineering shear",
        "small strain: sum of (grad v + grad v^T) dt / 2; large rotation: U - I; neo-Hookean: (F F^T - I) / 2"},
       [](const Sample& s, double* o) { std::copy_n(s.strain, 6, o); }},
      {{"pressure", "Pa", 1, false, "mean pressure, compression positive", "p = -(sigma_xx + sigma_yy + sigma_zz) / 3"},
       [](const Sample& s, double* o) { *o = -mean_stress(s); }},
      {{"von_mises", "Pa", 1, false, "equivalent stress", "sqrt(3/2 s:s), s = sigma + p I"},
       [](const Sample& s, double* o) {
         const double m = mean_stress(s);
         double square = 0;
         for (int k = 0; k < 3; ++k) square += (s.stress[k] - m) * (s.stress[k] - m) + 2 * s.stress[3 + k] * s.stress[3 + k];
         *o = std::sqrt(1.5 * square);
       }},
      {{"energy_density", "J/m3", 1, false, "strain energy per initial volume", "W by the law of the material"},
       [](const Sample& s, double* o) { *o = s.energy; }},
      {{"volume", "m3", 1, false, "present volume, in 2D with the thickness of the body", "J V_0"},
       [](const Sample& s, double* o) { *o = s.volume * s.volume_ratio; }},
      {{"mass", "kg", 1, false, "mass, which stays the same", "m"}, [](const Sample& s, double* o) { *o = s.mass; }},
      {{"density", "kg/m3", 1, false, "present density", "m / (J V_0)"},
       [](const Sample& s, double* o) { *o = s.mass / (s.volume * s.volume_ratio); }},
      {{"material", "1", 1, false,
        "number of the material, from 0 in the order of bodies; it counts again where bodies of it differ in thickness, particle size or "
        "field",
        ""},
       [](const Sample& s, double* o) { *o = s.material; }},
  };
  return list;
}

/// Position and velocity at the present time; of rigid bodies as prescribed.
template <int Dim>
std::pair<Vec<Dim>, Vec<Dim>> present_motion(const State<Dim>& state, const Model<Dim>& model, std::size_t p, std::uint32_t material) {
  const Particles<Dim>& particles = state.particles;
  const MaterialField& field = model.fields[model.materials[material].field];
  if (!field.rigid || particles.lead == 0) return {particles.present_position(p), particles.velocity(p)};
  const RigidMotion<Dim>& motion = state.rigid[static_cast<std::size_t>(field.body)];
  const Vec<Dim> x = motion.present.place(particles.original[p] - model.rigid_bodies[static_cast<std::size_t>(field.body)].centre);
  return {x, motion.start.velocity_at(x)};
}

template <int Dim>
void fill_sample(const State<Dim>& state, const Model<Dim>& model, std::size_t p, const PackReport& report, std::uint32_t material,
                 Sample& s) {
  const Particles<Dim>& particles = state.particles;
  const auto l = p % lanes;
  const auto [x, v] = present_motion(state, model, p, material);
  s.x = s.X = s.v = {};
  for (std::size_t k = 0; k < Dim; ++k) s.x[k] = x[k], s.v[k] = v[k], s.X[k] = particles.original[p][k];
  const Pack* stress = &particles.stress[p / lanes * stress_size<Dim>];
  static constexpr int from_2d[6] = {0, 1, 3, 2, -1, -1};
  for (int c = 0; c < 6; ++c) {
    const int at = Dim == 2 ? from_2d[c] : c;
    s.stress[c] = at < 0 ? 0. : stress[at][l] * report.to_cauchy[l];
    s.strain[c] = report.strain[c][l];
  }
  s.energy = report.energy[l];
  s.volume = particles.volume(p);
  s.mass = particles.mass(p);
  s.volume_ratio = report.volume_ratio[l];
  s.id = particles.id[p];
  s.body = particles.body[p];
  s.material = static_cast<int>(material);
}

template <int Dim>
RigidPlace rigid_place(const RigidBody<Dim>& body, const RigidPose<Dim>& pose) {
  RigidPlace place;
  for (std::size_t k = 0; k < Dim; ++k) {
    place.start[k] = body.centre[k];
    place.centre[k] = pose.centre[k];
    for (std::size_t l = 0; l < Dim; ++l) place.turn[3 * k + l] = pose.turn[k][l];
  }
  return place;
}

}  // namespace

std::vector<QuantityDescription> describe_particle_quantities() {
  std::vector<QuantityDescription> all;
  for (const Quantity& q : quantities()) all.push_back(q.is);
  return all;
}

std::vector<std::string> particle_quantity_names() {
  std::vector<std::string> names;
  for (const Quantity& q : quantities()) names.push_back(q.is.name);
  return names;
}

std::vector<std::string> common_quantity_names() {
  std::vector<std::string> names;
  for (const Quantity& q : quantities()) {
    if (q.is.common) names.push_back(q.is.name);
  }
  return names;
}

template <int Dim>
PointFrame sample_particles(const State<Dim>& state, const Model<Dim>& model, const std::vector<std::string>& names, Precision precision) {
  std::vector<const Quantity*> wanted;
  for (const std::string& name : names.empty() ? common_quantity_names() : names) {
    const auto at = std::find_if(quantities().begin(), quantities().end(), [&](const Quantity& q) { return name == q.is.name; });
    if (at == quantities().end()) throw std::invalid_argument("there is no particle quantity \"" + name + "\"");
    wanted.push_back(&*at);
  }
  const Rows rows = find_rows(state);
  const auto numbers = [&](int components) {
    const int in_plane = components == 3 ? 2 : components == 6 ? 4 : components;  // the others are zeros
    return Numbers(real_type(precision), rows.count, components, Dim == 2 ? in_plane : components);
  };
  PointFrame frame;
  frame.time = state.clock.time;
  frame.step = state.clock.step;
  frame.dimension = Dim;
  frame.body_names = model.bodies;
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b)
    frame.rigid.push_back(rigid_place(model.rigid_bodies[b], state.rigid[b].present));
  for (int k = 0; k < Dim; ++k) frame.cell = std::fmax(frame.cell, model.grid.cell[k]);
  frame.positions = numbers(3);
  const auto size_of = [&](const Material<Dim>& m) {
    std::vector<double> size(3);
    for (int k = 0; k < Dim; ++k) size[static_cast<std::size_t>(k)] = 2 * m.half_size[k] * model.grid.cell[k];
    return size;
  };
  const bool one_size =
      std::all_of(model.materials.begin(), model.materials.end(), [&](const auto& m) { return size_of(m) == size_of(model.materials[0]); });
  frame.particle_size = one_size ? Numbers::repeated(real_type(precision), rows.count, size_of(model.materials[0])) : numbers(3);
  frame.fields.push_back({"id", "1", 1, Numbers::labels<std::uint32_t>(rows.count)});
  frame.fields.push_back({"body", "1", 1, Numbers::labels<std::uint16_t>(rows.count)});
  for (const Quantity* q : wanted) frame.fields.push_back({q->is.name, q->is.unit, q->is.components, numbers(q->is.components)});
  parallel_for(state.order.runs.size(), model.threads, [&](std::size_t r) {
    const Run& run = state.order.runs[r];
    const Material<Dim>& material = model.materials[run.material];
    const std::vector<double> size = size_of(material);
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      const PackReport report = material.law->report(model.stress_state, Dim, &state.particles.stress[k * stress_size<Dim>],
                                                     state.particles.history.data() + k * state.particles.history_size);
      for (std::size_t p = k * lanes; p < (k + 1) * lanes; ++p) {
        if (state.particles.is_padding(p)) continue;
        Sample sample;
        fill_sample(state, model, p, report, run.material, sample);
        const std::size_t row = rows[state.particles.id[p]];
        frame.positions.set_row(row, sample.x.c.data());
        if (!one_size) frame.particle_size.set_row(row, size.data());
        frame.fields[0].values.set(row, sample.id);
        frame.fields[1].values.set(row, sample.body);
        for (std::size_t q = 0; q < wanted.size(); ++q) {
          double values[6];
          wanted[q]->get(sample, values);
          frame.fields[2 + q].values.set_row(row, values);
        }
      }
    }
  });
  return frame;
}

template <>
CrackFrame sample_cracks<2>(const State<2>& state, const StepWork<2>& work) {
  CrackFrame frame;
  frame.time = state.clock.time;
  frame.step = state.clock.step;
  Field opening{"opening", "m", 1, {}}, sliding{"sliding", "m", 1, {}};
  for (const Crack<2>& leading : state.cracks.list) {
    const Crack<2> crack = present_crack(state, work, leading);
    frame.names.push_back(crack.name);
    for (std::size_t v = 0; v < crack.plane.size(); ++v) {
      const auto put = [](std::vector<double>& out, const Vec<2>& x) { out.insert(out.end(), {x[0], x[1], 0.}); };
      put(frame.plane, crack.plane[v]);
      put(frame.upper, crack.upper[v]);
      put(frame.lower, crack.lower[v]);
      put(frame.original, crack.original[v]);
      const CrackOpening o = opening_at(crack, v);
      opening.values.push_back(o.opening);
      sliding.values.push_back(o.sliding);
    }
    frame.begin.push_back(static_cast<std::int64_t>(frame.plane.size() / 3));
  }
  frame.fields = {opening, sliding};
  if (std::any_of(state.cracks.list.begin(), state.cracks.list.end(), [](const Crack<2>& c) { return !c.traction.history.empty(); })) {
    Field normal{"traction_normal", "Pa", 1, {}}, shear{"traction_shear", "Pa", 1, {}}, damage{"damage", "1", 1, {}};
    for (std::size_t c = 0; c < state.cracks.size(); ++c) {
      for (std::size_t v = 0; v < state.cracks.list[c].plane.size(); ++v) {
        const TractionHistory h =
            state.cracks.list[c].traction.history.empty() ? TractionHistory{} : state.cracks.list[c].traction.history[v];
        normal.values.push_back(h.normal_traction);
        shear.values.push_back(h.shear_traction);
        damage.values.push_back(h.damage);
      }
    }
    frame.fields.insert(frame.fields.end(), {normal, shear, damage});
  }
  return frame;
}

template <>
CrackFrame sample_cracks<3>(const State<3>& state, const StepWork<3>&) {
  CrackFrame frame;
  frame.time = state.clock.time;
  frame.step = state.clock.step;
  return frame;
}

template <int Dim>
PointFrame sample_nodes(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model) {
  PointFrame frame;
  frame.time = state.clock.time;
  frame.step = state.clock.step;
  frame.dimension = Dim;
  for (int k = 0; k < Dim; ++k) frame.cell = std::fmax(frame.cell, model.grid.cell[k]);
  Field field{"cracks_across", "1", 1, {}}, mass{"mass", "kg", 1, {}}, momentum{"momentum", "kg m/s", 3, {}}, force{"force", "N", 3, {}};
  for (std::size_t b = 0; b < work.blocks.size() && work.nodes.momentum.size() > 0; ++b) {
    const BlockLayers<Dim>& layers = work.nodes.layers[b];
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (model.is_rigid(layers.node[l].field)) continue;
      for (int n = 0; n < block_nodes<Dim>; ++n) {
        const std::size_t i = layers.slot(l, n);
        const Pack p = work.nodes.momentum[i];
        if (!(p[Dim] > 0)) continue;
        const Vec<Dim> x = model.grid.node_position(work.blocks.list[b].node(n));
        field.values.push_back(layers.node[l].cracks.size());
        mass.values.push_back(p[Dim]);
        for (int k = 0; k < 3; ++k) {
          frame.positions.push_back(k < Dim ? x[k % Dim] : 0.);
          momentum.values.push_back(k < Dim ? p[k] : 0.);
          force.values.push_back(k < Dim ? work.nodes.force[i][k % Dim] : 0.);
        }
      }
    }
  }
  frame.fields = {field, mass, momentum, force};
  return frame;
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                               \
  template PointFrame sample_particles<DIM>(const State<DIM>&, const Model<DIM>&, const std::vector<std::string>&, Precision); \
  template PointFrame sample_nodes<DIM>(const State<DIM>&, const StepWork<DIM>&, const Model<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
