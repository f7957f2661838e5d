#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <cmath>

#include "crampon/contact/groups.hpp"
#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/face_samples.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/mirrors_at.hpp"
#include "crampon/step/rigid_faces.hpp"

namespace crampon {

namespace {

template <int Dim, class Shape>
class FaceFinder {
 public:
  FaceFinder(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b)
      : state_(state), work_(work), model_(model), b_(b), layers_(work.nodes.layers[b]), out_(work.scratch[b].face_nodes) {}

  void run() {
    for (int node = 0; node < block_nodes<Dim>; ++node) {
      if (layers_.shared[static_cast<std::size_t>(node)] != 0) find_groups_of(node);
    }
    if (!out_.parts.empty()) sample();
  }

 private:
  Vec<Dim> position_of(int node) const { return model_.grid.node_position(work_.blocks.list[b_].node(node)); }

  void find_groups_of(int node) {
    near_.clear();
    const Vec<Dim> x = position_of(node);
    for (std::size_t r = 0; r < model_.rigid_bodies.size(); ++r) {
      const RigidBody<Dim>& body = model_.rigid_bodies[r];
      if (body.acts == RigidBody<Dim>::Acts::face && distance_from(body, state_.rigid[r].start, x) < longest_reach(model_))
        near_.push_back(r);
    }
    if (near_.empty()) return;
    present_.clear();
    for (std::size_t l = 0; l < layers_.node.size(); ++l) {
      if (work_.nodes.momentum[layers_.slot(l, node)][Dim] > 0 && !model_.is_rigid(layers_.node[l].field))
        present_.push_back(static_cast<int>(l));
    }
    if (present_.empty()) return;
    const int groups = find_groups(layers_.node, model_.contact, present_, group_of_);
    for (int g = 0; g < groups; ++g) meet_faces(node, x, g);
  }

  /// A group of a node against all rigid faces near it.
  void meet_faces(int node, const Vec<Dim>& x, int g) {
    const std::int64_t number = model_.grid.node_number(work_.blocks.list[b_].node(node));
    const Mirrors mirrors = mirrors_at(model_, number);
    FaceGroup<Dim> group;
    group.node = static_cast<std::uint16_t>(node);
    group.x = x;
    group.first_slot = static_cast<std::uint32_t>(out_.slots.size());
    FacePart<Dim> part;
    part.known_as = 0xffff;
    part.mirror_axes = mirrors.axes;
    Vec<Dim> mean;
    double most = -1;
    for (std::size_t i = 0; i < present_.size(); ++i) {
      if (group_of_[i] != g) continue;
      const Layer& layer = layers_.node[static_cast<std::size_t>(present_[i])];
      const std::size_t slot = layers_.slot(present_[i], node);
      const ContactSums<Dim>& sums = work_.nodes.contact[slot];
      out_.slots.push_back(slot);
      group.m += work_.nodes.momentum[slot][Dim];
      mean += sums.present();
      part.gradient += sums.gradient();
      part.history += sums.history();
      part.known_as = std::min(part.known_as, model_.contact.fields[layer.field].bonded_to);
      part.cracks = without_bonded(layer.cracks, model_.contact);
      if (sums.volume() > most) most = sums.volume(), part.field = layer.field;
    }
    group.end_slot = static_cast<std::uint32_t>(out_.slots.size());
    group.contact_group = find_contact_group(node, out_.slots[group.first_slot]);
    mean = mirrors.mean(mean * (1 / group.m));
    part.group = static_cast<std::uint32_t>(out_.groups.size());
    bool any = false;
    for (const std::size_t r : near_) {
      const RigidBody<Dim>& body = model_.rigid_bodies[r];
      if (model_.contact.law_between(part.field, body.field).ignores()) continue;
      const RigidFaceView<Dim> view = see_face(body, state_.rigid[r].start, x + mean);
      const Vec<Dim> n = normalized(mirrors.mean(-view.out));
      if (n == Vec<Dim>{}) continue;
      // Deeper in the material than the reach of its sums, and the face is nothing to the node.
      const double depth = view.distance + dot(mean, n);
      const double reach = boxes_of(model_.shape_functions).reach_of_sums() + model_.contact.fields[part.field].uneven_edge;
      if (depth > reach_across(model_.grid, reach, n) * (1 - 1e-9)) continue;
      part.body = static_cast<std::uint16_t>(r);
      part.axis = 0;
      for (int k = 1; k < Dim; ++k) {
        if (std::fabs(n[k]) > std::fabs(n[part.axis]) * (1 + 1e-9)) part.axis = static_cast<std::uint8_t>(k);
      }
      part.up = n[part.axis] > 0;
      auto at = work_.blocks.list[b_].node(node);
      part.row = at[part.axis];
      at[part.axis] = 0;
      part.column = model_.grid.node_number(at);
      out_.parts.push_back(part);
      any = true;
    }
    if (any) {
      out_.groups.push_back(group);
    } else {
      out_.slots.resize(group.first_slot);
    }
  }

  /// The group among those of a node with several fields.
  int find_contact_group(int node, std::size_t slot) const {
    const ContactNodes<Dim>& contacts = work_.scratch[b_].contact;
    const auto at = std::lower_bound(contacts.nodes.begin(), contacts.nodes.end(), node,
                                     [](const ContactNode<Dim>& c, int n) { return static_cast<int>(c.node) < n; });
    if (at == contacts.nodes.end() || static_cast<int>(at->node) != node) return -1;
    for (std::uint32_t f = at->first_field; f < at->end_field; ++f) {
      if (layers_.slot(contacts.fields[f].layer, node) == slot) return static_cast<int>(at->first_group) + contacts.fields[f].group;
    }
    return -1;
  }

  /// The particles about each part, and how far their body's surface is from the face.
  void sample() {
    static thread_local ContactCloud<Dim> cloud;
    cloud.clear();
    std::vector<bool> wanted(block_nodes<Dim>, false);
    for (const FaceGroup<Dim>& group : out_.groups) wanted[group.node] = true;
    cloud.template collect<Shape>(state_, work_, model_, b_, wanted, ContactCloud<Dim>::Of::surface);
    const FaceSampler<Dim> sampler(state_, work_, model_);
    for (FacePart<Dim>& part : out_.parts) {
      const FaceGroup<Dim>& group = out_.groups[part.group];
      points_.clear();
      for (const CloudPoint<Dim>& point : cloud.at(group.node)) {
        const auto begin = out_.slots.begin() + group.first_slot, end = out_.slots.begin() + group.end_slot;
        if (std::find(begin, end, layers_.slot(point.layer, static_cast<int>(group.node))) != end) points_.push_back(point);
      }
      part.first_sample = static_cast<std::uint32_t>(out_.samples.size());
      sampler.sample(group, out_.slots.data(), part, points_, out_.samples);
      part.end_sample = static_cast<std::uint32_t>(out_.samples.size());
    }
  }

  State<Dim>& state_;
  StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::size_t b_;
  const BlockLayers<Dim>& layers_;
  FaceNodes<Dim>& out_;
  std::vector<std::size_t> near_;
  std::vector<int> present_, group_of_;
  std::vector<CloudPoint<Dim>> points_;  ///< about the part at hand
};

}  // namespace

template <int Dim, class Shape>
void find_face_nodes(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  work.scratch[b].face_nodes.clear();
  if (!work.nodes.layers[b].near_face || work.nodes.layers[b].shared.empty()) return;
  FaceFinder<Dim, Shape>(state, work, model, b).run();
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void find_face_nodes<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
