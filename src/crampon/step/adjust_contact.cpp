#include "crampon/step/adjust_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "crampon/step/boundary.hpp"

namespace crampon {

namespace {

/// The only two ways in which contact changes a node (STYLE, invariants): Tasks 2 and 6 change momentum alone ...
template <int Dim>
void add_momentum(Nodes<Dim>& nodes, std::size_t i, const Vec<Dim>& dp) {
  for (int k = 0; k < Dim; ++k) nodes.momentum[i][k] += dp[k];
}

/// ... and Task 4 momentum and force together (N13 sec. 2.5).
template <int Dim>
void add_momentum_and_force(Nodes<Dim>& nodes, std::size_t i, const Vec<Dim>& dp, double dt) {
  add_momentum(nodes, i, dp);
  for (int k = 0; k < Dim; ++k) nodes.force[i][k] += dp[k] / dt;
}

template <int Dim>
Vec<Dim> momentum_of(const Nodes<Dim>& nodes, std::size_t i) {
  Vec<Dim> p;
  for (int k = 0; k < Dim; ++k) p[k] = nodes.momentum[i][k];
  return p;
}

template <int Dim>
std::size_t nodal_index(const State<Dim>& state, std::size_t b, int layer, int node) {
  return (std::size_t{state.nodes.layers[b].node_begin} + layer) * block_nodes<Dim> + node;
}

/// Are fields on both sides of the crack one group? One after another, bonded pairs are pairs like others (N13, CONVENTIONS 14).
template <int Dim>
bool joins(const Model<Dim>& model, CrackId c) {
  return std::holds_alternative<BondedContact>(model.crack_laws[c]) && model.contact.pairs == ContactPairs::joint;
}

/// A signature without the cracks that join: fields that agree in it move as one (CONVENTIONS 13, 14).
template <int Dim>
Signature without_joined(const Signature& s, const Model<Dim>& model) {
  Signature out;
  for (const CrackId c : s) {
    if (!joins(model, c)) out.append(c);
  }
  return out;
}

/// The one crack by which two signatures differ, or -1.
std::int64_t only_difference(const Signature& a, const Signature& b) {
  const Signature& longer = a.size() > b.size() ? a : b;
  const Signature& shorter = a.size() > b.size() ? b : a;
  if (longer.size() != shorter.size() + 1) return -1;
  std::int64_t found = -1;
  for (const CrackId c : longer) {
    if (shorter.contains(c)) continue;
    if (found >= 0) return -1;
    found = c;
  }
  return found;
}

/// What Task 1 left at a node about one crack: unit normals now and at the start, and the side of the particles across.
template <int Dim>
struct CrackAtNode {
  CrackId crack = 0;
  Vec<Dim> n, N;
  double side = 0;
};

template <int Dim>
struct GroupSums {
  Signature signature;
  double volume = 0;
  Vec<Dim> x, X;  ///< sums of m (x - x_i), m (X - x_i)
};

template <int Dim>
Vec<Dim> relative_velocity(const ContactGroup<Dim>* groups, const ContactPair<Dim>& pair) {
  const ContactGroup<Dim>&a = groups[pair.a], &b = groups[pair.b];
  return (b.p + b.dp) * (1 / b.m) - (a.p + a.dp) * (1 / a.m);
}

/// Energy that contact takes from the particles in a step (contact-consistency.md): with w- and w+ the relative velocities before Task 2
/// and before Task 6, and da what the forces of Task 3 add, -1/2 (J4.w- - da.J2) - 1/2 (J4.w+ - da.J6); half in Task 4, half in Task 6.
template <int Dim>
double energy_taken(ContactPair<Dim>& pair, ContactTask task, const Vec<Dim>& before, const Vec<Dim>& after, bool re_extrapolates) {
  switch (task) {
    case ContactTask::two:
      pair.w_start = before;
      pair.w_settled = after;
      pair.J2 = pair.J;
      return 0;
    case ContactTask::four: {
      pair.J4 = pair.J;
      pair.gain = before - pair.w_settled;
      const double first = -0.5 * (dot(pair.J4, pair.w_start) - dot(pair.gain, pair.J2));
      return re_extrapolates ? first : first - 0.5 * dot(pair.J4, after);  // without Task 6 the step ends with Task 4
    }
    case ContactTask::six:
      return -0.5 * (dot(pair.J4, before) - dot(pair.gain, pair.J));
  }
  return 0;
}

template <int Dim>
class NodeFinder {
 public:
  NodeFinder(State<Dim>& state, const Model<Dim>& model, std::size_t b)
      : state_(state), model_(model), b_(b), out_(state.scratch[b].contact) {}

  void find(int node) {
    const BlockLayers<Dim>& layers = state_.nodes.layers[b_];
    fields_.clear();
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      if (state_.nodes.momentum[nodal_index(state_, b_, static_cast<int>(l), node)][Dim] > 0) fields_.push_back(static_cast<int>(l));
    }
    if (fields_.size() < 2) return;
    ContactNode<Dim> contact;
    contact.node = static_cast<std::uint16_t>(node);
    contact.number = number_of(node);
    collect_cracks(node, contact.number);
    contact.first_field = static_cast<std::uint32_t>(out_.fields.size());
    contact.first_group = static_cast<std::uint32_t>(out_.groups.size());
    contact.first_pair = static_cast<std::uint32_t>(out_.pairs.size());
    collect_groups(node);
    collect_pairs(contact);
    contact.end_field = static_cast<std::uint32_t>(out_.fields.size());
    contact.end_group = static_cast<std::uint32_t>(out_.groups.size());
    contact.end_pair = static_cast<std::uint32_t>(out_.pairs.size());
    out_.nodes.push_back(contact);
  }

 private:
  std::int64_t number_of(int node) const {
    IndexVector<Dim> i = unflatten<Dim>(node, block_side);
    const auto first = state_.blocks.list[b_].first_node();
    for (int k = 0; k < Dim; ++k) i[k] += first[k];
    return model_.grid.node_number(i);
  }

  void collect_cracks(int node, std::int64_t number) {
    cracks_.clear();
    const BlockLayers<Dim>& layers = state_.nodes.layers[b_];
    for (std::size_t c = 0; c < layers.node_cracks.size(); ++c) {
      const CrossingSums& sum = state_.nodes.crossing[(layers.crossing_node_begin + c) * block_nodes<Dim> + node];
      if (sum.r[0][3] == 0) continue;
      CrackAtNode<Dim> crack;
      crack.crack = layers.node_cracks[c];
      Vec<Dim> n, N;
      for (int k = 0; k < 2; ++k) n[k] = sum.r[0][k], N[k] = sum.r[1][k];
      drop_mirrored(number, n);
      drop_mirrored(number, N);
      crack.n = normalized(n);
      crack.N = normalized(N);
      crack.side = sum.r[0][2];
      cracks_.push_back(crack);
      out_.sides.push_back({number, crack.crack, static_cast<std::int8_t>((crack.side > 0 ? 1 : 0) - (crack.side < 0 ? 1 : 0))});
    }
    if (cracks_.size() > 2) ++state_.scratch[b_].ledger.crowded_nodes;
  }

  /// On a symmetry plane the crack and its mirror image meet: their mean normal lies in the plane (contact.md 6).
  void drop_mirrored(std::int64_t number, Vec<Dim>& n) const {
    for (const VelocityCondition<Dim>& c : model_.conditions) {
      if (c.symmetry && std::binary_search(c.nodes.begin(), c.nodes.end(), number)) n[c.components.front().axis] = 0;
    }
  }

  void collect_groups(int node) {
    sums_.clear();
    const BlockLayers<Dim>& layers = state_.nodes.layers[b_];
    for (const int l : fields_) {
      const Signature reduced = without_joined(layers.node[static_cast<std::size_t>(l)].cracks, model_);
      std::size_t g = 0;
      while (g < sums_.size() && sums_[g].signature != reduced) ++g;
      if (g == sums_.size()) {
        sums_.emplace_back().signature = reduced;
        out_.groups.emplace_back();
      }
      const std::size_t i = nodal_index(state_, b_, l, node);
      ContactGroup<Dim>& group = out_.groups[out_.groups.size() - sums_.size() + g];
      group.m += state_.nodes.momentum[i][Dim];
      const ContactSums& s = state_.nodes.contact[i];
      sums_[g].volume += s.r[0][0];
      for (int k = 0; k < Dim; ++k) sums_[g].x[k] += s.r[0][1 + k], sums_[g].X[k] += s.r[1][k];
      out_.fields.push_back({l, static_cast<int>(g)});
    }
  }

  void collect_pairs(const ContactNode<Dim>& contact) {
    double volume = 0;
    for (const auto& s : sums_) volume += s.volume;
    double reference = 1;
    for (int k = 0; k < Dim; ++k) reference *= model_.grid.cell[k];
    if (model_.contact.reference_volume == ReferenceVolume::initial && !state_.initial_volume.empty()) {
      const double initial = state_.initial_volume[static_cast<std::size_t>(contact.number)];
      if (initial > 0) reference = initial;
    }
    for (std::size_t g = 0; g < sums_.size(); ++g) {
      for (std::size_t h = g + 1; h < sums_.size(); ++h) {
        const std::int64_t c = only_difference(sums_[g].signature, sums_[h].signature);
        if (c < 0 || std::holds_alternative<NoContact>(model_.crack_laws[static_cast<std::size_t>(c)])) continue;
        const CrackAtNode<Dim>* crack = nullptr;
        for (const auto& k : cracks_) {
          if (k.crack == c) crack = &k;
        }
        if (!crack || crack->side == 0 || crack->n == Vec<Dim>{}) continue;  // no side or no direction: nothing to hold against
        const bool g_across = sums_[g].signature.contains(static_cast<CrackId>(c));
        const bool g_above = g_across == (crack->side > 0);
        ContactPair<Dim> pair;
        pair.a = static_cast<int>(g_above ? g : h);
        pair.b = static_cast<int>(g_above ? h : g);
        const ContactGroup<Dim>&a = out_.groups[contact.first_group + pair.a], &b = out_.groups[contact.first_group + pair.b];
        const double fraction = a.m / (a.m + b.m);
        const bool bonded = std::holds_alternative<BondedContact>(model_.crack_laws[static_cast<std::size_t>(c)]);
        if (!bonded && std::fmin(fraction, 1 - fraction) < model_.contact.mass_screen) continue;  // CONVENTIONS 37
        pair.crack = static_cast<CrackId>(c);
        pair.others = g_across ? sums_[h].signature : sums_[g].signature;
        pair.n = crack->n;
        // contact.md 2.2: zero for a closed, undeformed crack at any place and turn.
        pair.gap = dot(sums_[pair.b].x * (1 / b.m) - sums_[pair.a].x * (1 / a.m), crack->n) -
                   dot(sums_[pair.b].X * (1 / b.m) - sums_[pair.a].X * (1 / a.m), crack->N);
        pair.volume_ratio = volume / reference;
        if (model_.contact.detection == ContactDetection::volume && model_.contact.scheme == ContactScheme::consistent) {
          // The lagged scheme asks for a gap: by volume there is one, of unknown size, below V_sep, and none above.
          pair.gap = pair.volume_ratio < model_.contact.volume_separated ? std::numeric_limits<double>::max() : 0.;
        }
        pair.previous = previous_state(contact.number, pair);
        out_.pairs.push_back(pair);
      }
    }
    // CONVENTIONS 13: [0][1], [2][3] of the first crack, then [0][2], [1][3] of the second.
    std::sort(out_.pairs.begin() + contact.first_pair, out_.pairs.end(), [](const ContactPair<Dim>& a, const ContactPair<Dim>& b) {
      return std::tie(a.crack, a.others) < std::tie(b.crack, b.others);
    });
  }

  /// Where the node has changed sides of another crack, the pair was known under the other label.
  ContactState previous_state(std::int64_t number, const ContactPair<Dim>& pair) const {
    ContactKey key{number, pair.crack, pair.others};
    for (const auto& k : cracks_) {
      if (k.crack == pair.crack || joins(model_, k.crack)) continue;
      const double before = state_.memory.side(number, k.crack);
      if (before * k.side < 0) key.others.toggle(k.crack);
    }
    return state_.memory.find(key);
  }

  State<Dim>& state_;
  const Model<Dim>& model_;
  std::size_t b_;
  ContactNodes<Dim>& out_;
  std::vector<int> fields_;
  std::vector<CrackAtNode<Dim>> cracks_;
  std::vector<GroupSums<Dim>> sums_;
};

}  // namespace

template <int Dim>
void find_contacts(State<Dim>& state, const Model<Dim>& model, std::size_t b) {
  state.scratch[b].contact.clear();
  if (state.nodes.layers[b].node.size() < 2) return;
  NodeFinder<Dim> finder(state, model, b);
  for (int node = 0; node < block_nodes<Dim>; ++node) finder.find(node);
}

template <int Dim>
void adjust_contact(State<Dim>& state, const Model<Dim>& model, std::size_t b, ContactTask task, double dt) {
  ContactNodes<Dim>& contacts = state.scratch[b].contact;
  Nodes<Dim>& nodes = state.nodes;
  ContactRules rules;
  rules.task = task;
  rules.dt = dt;
  rules.literal = model.contact.scheme == ContactScheme::literal;
  rules.by_volume = model.contact.detection == ContactDetection::volume;
  rules.volume_separated = model.contact.volume_separated;
  rules.volume_contact = model.contact.volume_contact;
  rules.require_approach = model.contact.require_approach;
  rules.sequential = model.contact.pairs == ContactPairs::sequential;
  const bool re_extrapolates = model.stress_update == StressUpdate::musl || model.stress_update == StressUpdate::usavg;
  for (ContactNode<Dim>& node : contacts.nodes) {
    ContactGroup<Dim>* groups = contacts.groups.data() + node.first_group;
    ContactPair<Dim>* pairs = contacts.pairs.data() + node.first_pair;
    const int group_count = static_cast<int>(node.end_group - node.first_group);
    const int pair_count = static_cast<int>(node.end_pair - node.first_pair);
    for (int g = 0; g < group_count; ++g) groups[g].p = groups[g].dp = {};
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      groups[contacts.fields[f].group].p += momentum_of(nodes, nodal_index(state, b, contacts.fields[f].layer, node.node));
    }
    // Prescribed components stay in Task 4 (N13 sec. 2.5), and in the other tasks where nothing imposes them again after contact.
    const bool imposed_before = task == ContactTask::four || model.boundary_order == BoundaryOrder::boundary_first;
    rules.fixed_axes = imposed_before ? fixed_axes(state, b, node.node) : 0u;
    if (pair_count > 0) {
      std::vector<Vec<Dim>> before;
      for (int q = 0; q < pair_count; ++q) before.push_back(relative_velocity(groups, pairs[q]));
      if (!solve_contact<Dim>(rules, model.crack_laws, groups, group_count, pairs, pair_count)) ++state.scratch[b].ledger.unsolved_nodes;
      for (int q = 0; q < pair_count; ++q) {
        state.scratch[b].ledger.contact_loss +=
            energy_taken(pairs[q], task, before[static_cast<std::size_t>(q)], relative_velocity(groups, pairs[q]), re_extrapolates);
      }
    }
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      // Every field of a group takes the group's velocity (bonded: N13's stick) and its share, by mass, of the group's impulse.
      const std::size_t i = nodal_index(state, b, contacts.fields[f].layer, node.node);
      const ContactGroup<Dim>& group = groups[contacts.fields[f].group];
      const double fraction = nodes.momentum[i][Dim] / group.m;
      Vec<Dim> dp = group.dp * fraction;
      if (fraction < 1) dp += group.p * fraction - momentum_of(nodes, i);
      for (int k = 0; k < Dim; ++k) {
        if (rules.fixed_axes >> k & 1u) dp[k] = 0;
      }
      if (task == ContactTask::four) {
        add_momentum_and_force(nodes, i, dp, dt);
      } else {
        add_momentum(nodes, i, dp);
      }
    }
  }
}

template <int Dim>
void remember_contacts(State<Dim>& state) {
  state.memory.entries.clear();
  state.memory.sides.clear();
  for (const auto& scratch : state.scratch) {
    for (const ContactNode<Dim>& node : scratch.contact.nodes) {
      for (std::uint32_t q = node.first_pair; q < node.end_pair; ++q) {
        const ContactPair<Dim>& pair = scratch.contact.pairs[q];
        if (pair.state != ContactState::open) state.memory.entries.push_back({{node.number, pair.crack, pair.others}, pair.state});
      }
    }
    state.memory.sides.insert(state.memory.sides.end(), scratch.contact.sides.begin(), scratch.contact.sides.end());
  }
  state.memory.sort();
}

#define CRAMPON_INSTANTIATE(DIM)                                                                       \
  template void find_contacts<DIM>(State<DIM>&, const Model<DIM>&, std::size_t);                       \
  template void adjust_contact<DIM>(State<DIM>&, const Model<DIM>&, std::size_t, ContactTask, double); \
  template void remember_contacts<DIM>(State<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
