#include "crampon/run/sample.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "crampon/core/parallel.hpp"
#include "crampon/run/crack_quantities.hpp"
#include "crampon/run/quantities.hpp"
#include "crampon/step/crack_motion.hpp"

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

/// Those of the names, or the common ones.
std::vector<ParticleQuantity> choose(const std::vector<ParticleQuantity>& all, const std::vector<std::string>& names) {
  std::vector<ParticleQuantity> chosen;
  for (const std::string& name : names) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const ParticleQuantity& q) { return name == q.name; });
    if (at == all.end()) throw std::invalid_argument("there is no particle quantity \"" + name + "\"");
    chosen.push_back(*at);
  }
  if (names.empty()) std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [](const ParticleQuantity& q) { return q.common; });
  return chosen;
}

}  // namespace

template <int Dim>
PointFrame sample_particles(const State<Dim>& state, const Model<Dim>& model, const std::vector<std::string>& names, Precision precision) {
  const std::vector<ParticleQuantity> wanted = choose(quantities_of(model), names);
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
  for (const ParticleQuantity& q : wanted) frame.fields.push_back({q.name, q.unit, q.components, numbers(q.components)});
  parallel_for(state.order.runs.size(), model.threads, [&](std::size_t r) {
    const Run& run = state.order.runs[r];
    const std::vector<double> size = size_of(model.materials[run.material]);
    for (std::size_t k = run.first_pack; k < run.end_pack; ++k) {
      const PackView<Dim> view(state, model, run.material, k);
      const PackReport report = view.report();
      for (std::size_t p = k * lanes; p < (k + 1) * lanes; ++p) {
        if (state.particles.is_padding(p)) continue;
        const ParticleView particle = view.particle(static_cast<int>(p % lanes), report);
        const std::size_t row = rows[particle.id];
        frame.positions.set_row(row, particle.position.c.data());
        if (!one_size) frame.particle_size.set_row(row, size.data());
        frame.fields[0].values.set(row, particle.id);
        frame.fields[1].values.set(row, particle.body);
        for (std::size_t q = 0; q < wanted.size(); ++q) {
          double values[6];
          wanted[q].get(particle, values);
          frame.fields[2 + q].values.set_row(row, values);
        }
      }
    }
  });
  return frame;
}

template <>
CrackFrame sample_cracks<2>(const State<2>& state, const StepWork<2>& work, const Model<2>& model) {
  CrackFrame frame;
  frame.time = state.clock.time;
  frame.step = state.clock.step;
  const bool tractions =
      std::any_of(state.cracks.list.begin(), state.cracks.list.end(), [](const Crack<2>& c) { return !c.traction.history.empty(); });
  std::vector<const CrackQuantity*> wanted;
  for (const CrackQuantity& q : crack_quantities()) {
    if (q.in == CrackFrames::with_tractions && !tractions) continue;
    if (q.in == CrackFrames::with_fracture && !model.fracture.on) continue;
    wanted.push_back(&q);
    frame.fields.push_back({q.name, q.unit, 1, {}});
  }
  for (std::size_t c = 0; c < state.cracks.size(); ++c) {
    if (state.cracks.list[c].plane.empty()) continue;
    const Crack<2> crack = present_crack(state, work, state.cracks.list[c]);
    const std::vector<CrackOpening> openings = openings_of(crack);
    frame.names.push_back(crack.name);
    for (std::size_t v = 0; v < crack.plane.size(); ++v) {
      const auto put = [](std::vector<double>& out, const Vec<2>& x) { out.insert(out.end(), {x[0], x[1], 0.}); };
      put(frame.plane, crack.plane[v]);
      put(frame.upper, crack.upper[v]);
      put(frame.lower, crack.lower[v]);
      put(frame.original, crack.original[v]);
      CrackVertexView view{openings[v]};
      if (!crack.traction.history.empty()) view.traction = crack.traction.history[v];
      for (const CrackTip& tip : state.fracture.tips) {
        if (tip.crack == c && v == (tip.end == 0 ? 0 : crack.plane.size() - 1)) view.tip = &tip;
      }
      for (std::size_t q = 0; q < wanted.size(); ++q) frame.fields[q].values.push_back(wanted[q]->get(view));
    }
    frame.begin.push_back(static_cast<std::int64_t>(frame.plane.size() / 3));
  }
  return frame;
}

template <>
CrackFrame sample_cracks<3>(const State<3>& state, const StepWork<3>&, const Model<3>&) {
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
  DataArray field{"cracks_across", "1", 1, {}}, mass{"mass", "kg", 1, {}}, momentum{"momentum", "kg m/s", 3, {}},
      force{"force", "N", 3, {}};
  for (std::size_t b = 0; b < work.blocks.size() && work.nodes.momentum.nodes.size() > 0; ++b) {
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
