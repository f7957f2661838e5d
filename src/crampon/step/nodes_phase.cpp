#include "crampon/step/nodes_phase.hpp"

#include "crampon/step/adjust_contact.hpp"
#include "crampon/step/assemble.hpp"
#include "crampon/step/boundary.hpp"
#include "crampon/step/crack_tractions.hpp"
#include "crampon/step/find_contacts.hpp"
#include "crampon/step/find_face_nodes.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/meet_faces.hpp"
#include "crampon/step/rigid_faces.hpp"
#include "crampon/step/rotation.hpp"

namespace crampon {

template <int Dim, class Shape>
void assemble_momentum(State<Dim>& state, std::size_t b) {
  const BlockLayers<Dim>& layers = state.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(state, b, layers.node[l], state.nodes.tile_momentum, &state.nodes.momentum[layers.slot(l, 0)]);
  }
}

namespace {

template <int Dim, class Shape>
void assemble_contact_sums(State<Dim>& state, std::size_t b) {
  const BlockLayers<Dim>& layers = state.nodes.layers[b];
  if (layers.shared.empty()) return;
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(state, b, layers.node[l], state.nodes.tile_contact, &state.nodes.contact[layers.slot(l, 0)], true);
  }
  // Normals belong to cracks, not to layers, and are kept for the whole tile.
  for (std::size_t c = 0; c < layers.node_cracks.size(); ++c) {
    CrossingSums* out = &state.nodes.crossing[(layers.crossing_node_begin + c) * block_nodes<Dim>];
    std::fill_n(out, block_nodes<Dim>, CrossingSums{});
    for (int o = 0; o < neighbour_count<Dim>; ++o) {
      const std::uint32_t there = state.blocks.list[b].neighbours[o];
      if (there == no_block) continue;
      const BlockLayers<Dim>& tile = state.nodes.layers[there];
      const auto at = std::lower_bound(tile.tile_cracks.begin(), tile.tile_cracks.end(), layers.node_cracks[c]);
      if (at == tile.tile_cracks.end() || *at != layers.node_cracks[c]) continue;
      const CrossingSums* sums =
          &state.nodes.tile_crossing[(tile.crossing_tile_begin + static_cast<std::size_t>(at - tile.tile_cracks.begin())) *
                                     Tile<Dim, Shape>::nodes];
      Overlap<Dim, Shape>(neighbour_step<Dim>(o), whole_tile<Dim, Shape>()).rows([&](int local, int t, int count) {
        for (int i = 0; i < count; ++i) add_record(out[local + i], sums[t + i]);
      });
    }
  }
}

/// v = p/m, zero where there is no mass.
template <int Dim>
void find_velocities(State<Dim>& state, std::size_t b) {
  const std::size_t first = state.nodes.layers[b].slot(0, 0), end = state.nodes.layers[b].slot(state.nodes.layers[b].node.size(), 0);
  for (std::size_t i = first; i < end; ++i) {
    const Pack p = state.nodes.momentum[i];
    state.nodes.velocity[i] = leading<Dim>(p * splat(p[Dim] > 0 ? 1 / p[Dim] : 0.));
  }
}

/// Particles are to move with the nodal velocities at hand, and as far as springs between them give way.
template <int Dim>
void move_with_velocities(State<Dim>& state, std::size_t b) {
  const std::size_t first = state.nodes.layers[b].slot(0, 0), end = state.nodes.layers[b].slot(state.nodes.layers[b].node.size(), 0);
  for (std::size_t i = first; i < end; ++i) {
    const NodalVector<Dim> v = state.nodes.velocity[i];
    Pack& moving = state.nodes.motion[i].r[0];
    if constexpr (Dim == 2) {
      moving = Pack{v[0], v[1], moving[2], moving[3]};
    } else {
      moving = v;
    }
  }
  for (const ContactDrift<Dim>& drift : state.scratch[b].contact.drifts) {
    for (int k = 0; k < Dim; ++k) state.nodes.motion[drift.slot].r[0][k] += drift.dv[k];
  }
}

/// f(slot of a node) for the own nodes of a block in all fields but those of rigid bodies.
template <int Dim, class F>
void for_deformable(const State<Dim>& state, const Model<Dim>& model, std::size_t b, F f) {
  const BlockLayers<Dim>& layers = state.nodes.layers[b];
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    if (model.is_rigid(layers.node[l].field)) continue;
    const std::size_t first = layers.slot(l, 0);
    for (std::size_t i = first; i < first + block_nodes<Dim>; ++i) f(i);
  }
}

}  // namespace

template <int Dim, class Shape>
void find_shared_nodes(State<Dim>& state, const Model<Dim>& model, std::size_t b) {
  BlockLayers<Dim>& layers = state.nodes.layers[b];
  layers.shared.clear();
  if (layers.node.size() < 2 && !layers.near_face) return;
  assemble_momentum<Dim, Shape>(state, b);
  layers.shared.assign(block_nodes<Dim>, 0);
  for (int n = 0; n < block_nodes<Dim>; ++n) {
    int fields = 0;
    for (std::size_t l = 0; l < layers.node.size(); ++l) fields += state.nodes.momentum[layers.slot(l, n)][Dim] > 0;
    const bool at_wall = fields == 1 && layers.near_face &&
                         is_near_rigid_face(state, model, model.grid.node_position(state.blocks.list[b].node(n)), longest_reach(model));
    layers.shared[static_cast<std::size_t>(n)] = fields > 1 || at_wall;
  }
}

template <int Dim, class Shape>
void gather_start_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b) {
  if (state.nodes.layers[b].shared.empty()) assemble_momentum<Dim, Shape>(state, b);
  assemble_arms<Dim, Shape>(state, model, b);
  carry_rotation(state, b, &PieceRotation<Dim>::spin, -state.particles.lead);
  if (model.any_contact()) {
    assemble_contact_sums<Dim, Shape>(state, b);
    find_contacts<Dim, Shape>(state, model, b);
    find_face_nodes<Dim, Shape>(state, model, b);
  }
  impose_symmetry(state, model, b);
  if (model.boundary_order == BoundaryOrder::boundary_first) impose_start_momenta(state, model, b);  // N03 Task 2
  start_meeting_faces(state, model, b, ContactTask::two);
}

template <int Dim>
void settle_start_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt) {
  adjust_contact(state, model, b, ContactTask::two, dt);
  take_face_impulses(state, model, b, ContactTask::two, dt);
  if (model.boundary_order == BoundaryOrder::contact_first) impose_start_momenta(state, model, b);  // N13 sec. 2.3
  find_velocities(state, b);
}

template <int Dim, class Shape>
void update_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt, const Vec<Dim>& body_force, double damping) {
  Nodes<Dim>& nodes = state.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  NodalVector<Dim> gravity = splat_as<NodalVector<Dim>>(0.);
  for (int k = 0; k < Dim; ++k) gravity[k] = body_force[k];
  const std::size_t first = layers.slot(0, 0), end = layers.slot(layers.node.size(), 0);
  for (std::size_t l = 0; l < layers.node.size(); ++l) {
    assemble_layer<Dim, Shape>(state, b, layers.node[l], nodes.tile_force, &nodes.force[layers.slot(l, 0)]);
  }
  add_tractions(state, b);
  if (damping != 0 || model.any_body_force()) {
    for_deformable(state, model, b, [&](std::size_t i) {
      const Pack p = nodes.momentum[i];
      nodes.force[i] += splat_as<NodalVector<Dim>>(p[Dim]) * gravity - splat_as<NodalVector<Dim>>(damping) * leading<Dim>(p);
    });
  }
  impose_forces(state, model, b, dt);
  for (std::size_t i = first; i < end; ++i) nodes.momentum[i] += as_record<Dim>(splat_as<NodalVector<Dim>>(dt) * nodes.force[i]);
  start_meeting_faces(state, model, b, ContactTask::four);
}

template <int Dim>
void settle_updated_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt, const Vec<Dim>& body_force,
                            double damping) {
  adjust_contact(state, model, b, ContactTask::four, dt);
  take_face_impulses(state, model, b, ContactTask::four, dt);
  Nodes<Dim>& nodes = state.nodes;
  const BlockLayers<Dim>& layers = nodes.layers[b];
  const bool accounts = damping != 0 || model.any_body_force();
  if (accounts) {
    BlockLedger<Dim>& ledger = state.scratch[b].ledger;
    for_deformable(state, model, b, [&](std::size_t i) {
      const Pack p = nodes.momentum[i];
      const double m = p[Dim];
      const NodalVector<Dim> v_start = nodes.velocity[i];
      const NodalVector<Dim> v = 0.5 * (v_start + leading<Dim>(p * splat(m > 0 ? 1 / m : 0.)));
      for (int k = 0; k < Dim; ++k) {
        ledger.body_work += dt * m * body_force[k] * v[k];
        ledger.damping += dt * damping * m * v_start[k] * v[k];
      }
    });
  }
  const bool strains_follow = model.stress_update == StressUpdate::usl;  // the others find velocities anew before they are read again
  const std::size_t first = layers.slot(0, 0), end = layers.slot(layers.node.size(), 0);
  for (std::size_t i = first; i < end; ++i) {
    const Pack p = nodes.momentum[i];
    const double inverse = p[Dim] > 0 ? 1 / p[Dim] : 0.;
    const NodalVector<Dim> v = leading<Dim>(p * splat(inverse)), a = nodes.force[i] * splat_as<NodalVector<Dim>>(inverse);
    if (strains_follow || accounts) nodes.velocity[i] = v;
    if constexpr (Dim == 2) {
      nodes.motion[i].r[0] = Pack{v[0], v[1], a[0], a[1]};
    } else {
      nodes.motion[i].r[0] = v;
      nodes.motion[i].r[1] = a;
    }
  }
}

template <int Dim>
void account_body_force(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt, const Vec<Dim>& body_force) {
  const Nodes<Dim>& nodes = state.nodes;
  double power = 0;
  for_deformable(state, model, b, [&](std::size_t i) {
    for (int k = 0; k < Dim; ++k) power += nodes.momentum[i][Dim] * body_force[k] * nodes.velocity[i][k];
  });
  state.scratch[b].ledger.body_work += power * dt;
}

template <int Dim, class Shape>
void gather_end_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt) {
  assemble_momentum<Dim, Shape>(state, b);
  carry_rotation(state, b, &PieceRotation<Dim>::spin_end, dt - state.particles.lead);
  impose_symmetry(state, model, b);
  if (model.boundary_order == BoundaryOrder::boundary_first) impose_end_momenta(state, model, b);
  start_meeting_faces(state, model, b, ContactTask::six);
}

template <int Dim>
void settle_end_momenta(State<Dim>& state, const Model<Dim>& model, std::size_t b, double dt) {
  adjust_contact(state, model, b, ContactTask::six, dt);
  take_face_impulses(state, model, b, ContactTask::six, dt);
  if (model.boundary_order == BoundaryOrder::contact_first) impose_end_momenta(state, model, b);  // conventions 28
  find_velocities(state, b);
  if (model.positions == PositionUpdate::strain) move_with_velocities(state, b);
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                           \
  template void account_body_force<DIM>(State<DIM>&, const Model<DIM>&, std::size_t, double, const Vec<DIM>&);             \
  template void settle_start_momenta<DIM>(State<DIM>&, const Model<DIM>&, std::size_t, double);                            \
  template void settle_updated_momenta<DIM>(State<DIM>&, const Model<DIM>&, std::size_t, double, const Vec<DIM>&, double); \
  template void settle_end_momenta<DIM>(State<DIM>&, const Model<DIM>&, std::size_t, double);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE
#define CRAMPON_INSTANTIATE(DIM, SHAPE)                                                                                   \
  template void assemble_momentum<DIM, SHAPE>(State<DIM>&, std::size_t);                                                  \
  template void find_shared_nodes<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t);                               \
  template void gather_start_momenta<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t);                            \
  template void update_momenta<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t, double, const Vec<DIM>&, double); \
  template void gather_end_momenta<DIM, SHAPE>(State<DIM>&, const Model<DIM>&, std::size_t, double);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
