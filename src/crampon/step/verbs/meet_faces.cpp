#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/pair_response.hpp"
#include "crampon/core/parallel.hpp"
#include "crampon/step/contact_booking.hpp"
#include "crampon/step/face_meeting.hpp"
#include "crampon/step/fixed_components.hpp"

namespace crampon {

namespace {

constexpr int most_sweeps = 200;  // as at nodes (contact/node_solve.cpp)

/// f(part, group) for the parts of a column.
template <int Dim, class F>
void for_parts(StepWork<Dim>& work, const ContactColumn<Dim>& column, F f) {
  for (std::uint32_t i = column.first; i < column.end; ++i) {
    const auto& at = work.face_contacts.parts[i];
    FaceNodes<Dim>& nodes = work.scratch[at.block].face_nodes;
    FacePart<Dim>& part = nodes.parts[at.part];
    f(part, nodes.groups[part.group]);
  }
}

/// Velocity of the rigid body against the material at the face, by the nodes' parts of it, m/s. of: FaceGroup::before or ::v.
template <int Dim>
Vec<Dim> relative_velocity(State<Dim>& state, StepWork<Dim>& work, const ContactColumn<Dim>& column, ContactTask task,
                           Vec<Dim> FaceGroup<Dim>::*of) {
  const RigidPose<Dim>& pose = pose_in(state, column.body, task);
  Vec<Dim> w;
  for_parts(work, column, [&](const FacePart<Dim>& part, const FaceGroup<Dim>& group) {
    const Vec<Dim> of_rigid = task == ContactTask::term ? Vec<Dim>{} : pose.velocity_at(group.x);  // terms are changes of velocity
    w += (of_rigid - group.*of) * (part.w / column.w);
  });
  return w;
}

/// A node with pairs of its own, of which some group meets a face.
template <int Dim>
struct PairsAtFace {
  std::uint32_t block = 0;
  const ContactNode<Dim>* node = nullptr;
  std::vector<std::pair<int, FaceGroup<Dim>*>> faces;  ///< group of the node, and the same as the faces know it
  std::vector<Vec<Dim>> p;                             ///< of its groups without contact, kg m/s
  ContactRules rules;
};

/// The columns of one set and the pairs of the nodes in them: each against the others as they are now, until nothing changes.
template <int Dim>
class SetOfColumns {
 public:
  SetOfColumns(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, const ContactRules& rules, std::size_t set)
      : state_(state),
        work_(work),
        model_(model),
        rules_(rules),
        at_faces_(rules),
        faces_(work.face_contacts),
        begin_(faces_.columns.data() + faces_.first_column[set]),
        end_(faces_.columns.data() + faces_.first_column[set + 1]) {
    at_faces_.literal = false;
  }

  /// Returns false when it does not converge.
  bool run() {
    for (ContactColumn<Dim>* c = begin_; c != end_; ++c) start(*c);
    find_pairs();
    const bool solved = sweep();
    for (PairsAtFace<Dim>& at : pairs_) {
      ContactGroup<Dim>* groups = groups_of(at);
      for (std::size_t g = 0; g < at.p.size(); ++g) groups[g].p = at.p[g];
    }
    for (ContactColumn<Dim>* c = begin_; c != end_; ++c) c->w_now = relative_velocity_now(*c);
    return solved;
  }

 private:
  bool sweep() {
    if (end_ - begin_ == 1 && pairs_.empty()) {
      change(*begin_);
      return true;
    }
    double most = 0;
    bool solved = true;
    for (int n = 0; n < most_sweeps; ++n) {
      most = 0;
      solved = true;
      for (PairsAtFace<Dim>& at : pairs_) most = std::fmax(most, change(at, solved));
      for (ContactColumn<Dim>* c = begin_; c != end_; ++c) most = std::fmax(most, change(*c));
      if (most <= 1e-13 * largest_) return solved;
    }
    return solved && most <= 1e-8 * largest_;  // slow, but near enough
  }

  ContactGroup<Dim>* groups_of(const PairsAtFace<Dim>& at) { return work_.scratch[at.block].contact.groups.data() + at.node->first_group; }

  /// The nodes of the set that have pairs.
  void find_pairs() {
    std::vector<std::pair<std::uint32_t, std::uint16_t>> nodes;
    for (ContactColumn<Dim>* c = begin_; c != end_; ++c) {
      for (std::uint32_t i = c->first; i < c->end; ++i) {
        FaceNodes<Dim>& faces = work_.scratch[faces_.parts[i].block].face_nodes;
        const FaceGroup<Dim>& group = faces.groups[faces.parts[faces_.parts[i].part].group];
        if (group.contact_group >= 0) nodes.emplace_back(faces_.parts[i].block, group.node);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const auto& [block, number] : nodes) {
      const ContactNodes<Dim>& contacts = work_.scratch[block].contact;
      PairsAtFace<Dim> at;
      at.block = block;
      at.node = &*std::lower_bound(contacts.nodes.begin(), contacts.nodes.end(), number,
                                   [](const ContactNode<Dim>& c, std::uint16_t n) { return c.node < n; });
      if (at.node->first_pair == at.node->end_pair) continue;
      at.rules = rules_;
      at.rules.fixed_axes = fixes_before_contact(model_, rules_.task) ? fixed_axes(work_, block, number) : 0u;
      at.p.resize(at.node->end_group - at.node->first_group);
      for (std::uint32_t f = at.node->first_field; f < at.node->end_field; ++f) {
        const Pack& p = work_.nodes.momentum[work_.nodes.layers[block].slot(contacts.fields[f].layer, number)];
        for (int k = 0; k < Dim; ++k) at.p[static_cast<std::size_t>(contacts.fields[f].group)][k] += p[k];
      }
      for (FaceGroup<Dim>& group : work_.scratch[block].face_nodes.groups) {
        if (group.node == number && group.contact_group >= 0)
          at.faces.emplace_back(group.contact_group - static_cast<int>(at.node->first_group), &group);
      }
      pairs_.push_back(std::move(at));
    }
  }

  /// Pairs of a node against what the faces give. Returns by how much momenta change, kg m/s.
  double change(PairsAtFace<Dim>& at, bool& solved) {
    ContactNodes<Dim>& contacts = work_.scratch[at.block].contact;
    ContactGroup<Dim>* groups = groups_of(at);
    for (std::size_t g = 0; g < at.p.size(); ++g) groups[g].p = at.p[g];
    for (const auto& [g, face] : at.faces) groups[g].p += face->dp;
    solved = solve_contact<Dim>(at.rules, groups, static_cast<int>(at.p.size()), contacts.pairs.data() + at.node->first_pair,
                                static_cast<int>(at.node->end_pair - at.node->first_pair)) &&
             solved;
    double most = 0;
    for (const auto& [g, face] : at.faces) {
      const Vec<Dim> v = groups[g].velocity();
      most = std::fmax(most, norm(v - face->v) * face->m);
      largest_ = std::fmax(largest_, norm(v) * face->m);
      face->v = v;
    }
    return most;
  }

  Vec<Dim> relative_velocity_now(const ContactColumn<Dim>& column) const {
    return relative_velocity(state_, work_, column, rules_.task, &FaceGroup<Dim>::v);
  }

  /// The mass that an impulse at the face moves, kg; none where nothing can move.
  double mass_before(const ContactColumn<Dim>& column) const {
    double inverse = 0;
    for_parts(work_, column, [&](const FacePart<Dim>& part, const FaceGroup<Dim>& group) {
      const double share = part.w / column.w;
      inverse += share * share * dot(column.pair.n, without_axes(column.pair.n, group.fixed_axes)) / group.m;
    });
    return inverse > 0 ? 1 / inverse : 0.;
  }

  void add(ContactColumn<Dim>& column, const Vec<Dim>& J) {
    for_parts(work_, column, [&](FacePart<Dim>& part, FaceGroup<Dim>& group) {
      const Vec<Dim> dp = without_axes(J * (-part.w / column.w), group.fixed_axes);
      part.dp += dp;
      group.dp += dp;
      group.v += dp * (1 / group.m);
    });
  }

  void start(ContactColumn<Dim>& column) {
    column.pair.J = {};
    const double m = mass_before(column);
    for_parts(work_, column, [&](FacePart<Dim>& part, const FaceGroup<Dim>& group) {
      part.dp = {};
      largest_ = std::fmax(largest_, m * norm(group.v));
    });
    largest_ = std::fmax(largest_, m * norm(relative_velocity_now(column)));
  }

  /// Returns by how much the impulse changes, kg m/s.
  double change(ContactColumn<Dim>& column) {
    ContactPair<Dim>& pair = column.pair;
    const double m = mass_before(column);
    if (m == 0) return 0;
    const Vec<Dim> before = pair.J;
    if (before != Vec<Dim>{}) add(column, -before);
    pair.J = respond(at_faces_, pair, m, relative_velocity_now(column)).J;
    add(column, pair.J);
    if (rules_.task == ContactTask::four) pair.w_end = dot(relative_velocity_now(column), pair.n);
    largest_ = std::fmax(largest_, norm(pair.J));
    return norm(pair.J - before);
  }

  State<Dim>& state_;
  StepWork<Dim>& work_;
  const Model<Dim>& model_;
  const ContactRules& rules_;
  ContactRules at_faces_;  ///< the papers know no such faces, and the rule of each task for itself makes energy
  std::vector<PairsAtFace<Dim>> pairs_;
  FaceContacts<Dim>& faces_;
  ContactColumn<Dim>*begin_, *end_;
  double largest_ = 0;
};

/// After the columns of a set are solved: what their pairs keep, and the work of friction, J.
template <int Dim>
double close_pair(State<Dim>& state, StepWork<Dim>& work, ContactColumn<Dim>& column, ContactTask task, double dt, bool re_extrapolates) {
  ContactPair<Dim>& pair = column.pair;
  switch (task) {
    case ContactTask::two:
      pair.w_start = relative_velocity(state, work, column, task, &FaceGroup<Dim>::before);
      pair.w_settled = column.w_now;
      return 0;
    case ContactTask::four:
      pair.rubbing = rubbing(pair);
      note_slip(pair, column.w_now, dt);
      // Without Task 6 the velocity of the particles at the end is not known: that at the start stands for both.
      return re_extrapolates ? 0. : friction_work(pair, pair.w_start);
    case ContactTask::six:
      return friction_work(pair, relative_velocity(state, work, column, task, &FaceGroup<Dim>::before));
    case ContactTask::term:
      break;
  }
  return 0;
}

/// What particles are to add to their memory of contact waits on the nodes until they move (step/move_pass.cpp).
template <int Dim>
void put_gain(StepWork<Dim>& work, const ContactColumn<Dim>& column) {
  if (!column.pair.law->needs_history() || column.pair.state == ContactState::open) return;
  for (std::uint32_t i = column.first; i < column.end; ++i) {
    const auto& at = work.face_contacts.parts[i];
    const FaceNodes<Dim>& nodes = work.scratch[at.block].face_nodes;
    const FaceGroup<Dim>& group = nodes.groups[nodes.parts[at.part].group];
    for (std::uint32_t k = group.first_slot; k < group.end_slot; ++k)
      work.nodes.contact_gain[nodes.slots[k]] = Pack{column.pair.history_gain, 1., 0., 0.};
  }
}

}  // namespace

template <int Dim>
void meet_faces(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, ContactTask task) {
  const double dt = work.now.dt;
  FaceContacts<Dim>& contacts = work.face_contacts;
  const ContactRules rules = contact_rules(model, task, dt);
  parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) {
    FaceNodes<Dim>& faces = work.scratch[b].face_nodes;
    for (FaceGroup<Dim>& group : faces.groups) {
      group.v = velocity_of(work.nodes, faces, group);
      group.dp = {};
    }
  });
  if (contacts.columns.empty()) return;
  std::vector<std::uint8_t> unsolved(contacts.first_column.size() - 1, 0);
  parallel_for(unsolved.size(), model.threads, [&](std::size_t set) {
    SetOfColumns<Dim> columns(state, work, model, rules, set);
    unsolved[set] = columns.run() ? 0 : 1;
  });
  const bool re_extrapolates = model.transfer_in(state.clock.step).re_extrapolates;
  const bool remembers = task == ContactTask::four && state.particles.contact.size() > 0;
  for (std::size_t set = 0; set < unsolved.size(); ++set) {
    for (std::uint32_t c = contacts.first_column[set]; c < contacts.first_column[set + 1]; ++c) {
      ContactColumn<Dim>& column = contacts.columns[c];
      BlockLedger<Dim>& ledger = work.scratch[contacts.parts[column.first].block].ledger;
      if (c == contacts.first_column[set]) ledger.unsolved_nodes += unsolved[set];
      const double rubbed = close_pair(state, work, column, task, dt, re_extrapolates);
      ledger.friction_loss += rubbed;
      ledger.contact_loss -= rubbed;
      if (remembers) put_gain(work, column);
    }
  }
}

template void meet_faces<2>(State<2>&, StepWork<2>&, const Model<2>&, ContactTask);
template void meet_faces<3>(State<3>&, StepWork<3>&, const Model<3>&, ContactTask);

}  // namespace crampon
