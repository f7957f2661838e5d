#include "crampon/step/verbs.hpp"

#include "crampon/contact/find_pairs.hpp"
#include "crampon/contact/groups.hpp"
#include "crampon/step/contact_cloud.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/mirrors_at.hpp"

namespace crampon {

namespace {

/// Gathers the facts of one node after another, and hands them to contact/find_pairs.hpp.
template <int Dim, class Shape>
class NodeGatherer {
 public:
  NodeGatherer(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b)
      : state_(state),
        work_(work),
        model_(model),
        b_(b),
        layers_(work.nodes.layers[b]),
        out_(work.scratch[b].contact),
        cloud_(empty_cloud()) {}

  void run() {
    for (int node = 0; node < block_nodes<Dim>; ++node) collect_fields(node);
    const CloudsWanted wanted = clouds_wanted(model_.contact, model_.grid);
    if (wanted.among_materials || wanted.across_cracks) collect_cloud(wanted.across_cracks);
    PairFinder<Dim> finder(model_.contact, model_.grid, state_.contacts, state_.clock.step == 0);
    for (ContactNode<Dim>& node : out_.nodes) {
      gather_fields(node);
      gather_cracks(node);
      facts_.cloud.swap(cloud_.at(node.node));
      const std::vector<ContactPair<Dim>>& pairs = finder.find(facts_);
      facts_.cloud.swap(cloud_.at(node.node));  // its memory goes back to the thread
      node.first_pair = static_cast<std::uint32_t>(out_.pairs.size());
      out_.pairs.insert(out_.pairs.end(), pairs.begin(), pairs.end());
      node.end_pair = static_cast<std::uint32_t>(out_.pairs.size());
    }
  }

 private:
  /// A thread's own, which keeps its memory from block to block.
  static ContactCloud<Dim>& empty_cloud() {
    static thread_local ContactCloud<Dim> cloud;
    cloud.clear();
    return cloud;
  }
  const Layer& layer(int l) const { return layers_.node[static_cast<std::size_t>(l)]; }

  /// Which fields have mass at the node, and the groups that they form.
  void collect_fields(int node) {
    if (layers_.shared[static_cast<std::size_t>(node)] == 0) return;
    std::vector<int>& present = present_;
    present.clear();
    for (std::size_t l = 0; l < layers_.node.size(); ++l) {
      if (work_.nodes.momentum[layers_.slot(l, node)][Dim] > 0 && model_.contact.fields[layers_.node[l].field].meets_at_nodes)
        present.push_back(static_cast<int>(l));
    }
    if (present.size() < 2) return;
    ContactNode<Dim> contact;
    contact.node = static_cast<std::uint16_t>(node);
    contact.number = model_.grid.node_number(work_.blocks.list[b_].node(node));
    contact.first_field = static_cast<std::uint32_t>(out_.fields.size());
    contact.first_group = static_cast<std::uint32_t>(out_.groups.size());
    const int groups = find_groups(layers_.node, model_.contact, present, group_of_);
    for (std::size_t i = 0; i < present.size(); ++i) out_.fields.push_back({present[i], group_of_[i]});
    out_.groups.resize(out_.groups.size() + static_cast<std::size_t>(groups));
    contact.end_field = static_cast<std::uint32_t>(out_.fields.size());
    contact.end_group = static_cast<std::uint32_t>(out_.groups.size());
    if (contact.end_group - contact.first_group > most_groups) {  // more than any node can make sense of: left alone
      out_.fields.resize(contact.first_field);
      out_.groups.resize(contact.first_group);
      ++work_.scratch[b_].ledger.unsolved_nodes;
      return;
    }
    out_.nodes.push_back(contact);
  }

  void collect_cloud(bool everywhere) {
    std::vector<bool> wanted(block_nodes<Dim>, false);
    bool any = false;
    for (const ContactNode<Dim>& node : out_.nodes) {
      for (std::uint32_t f = node.first_field + 1; f < node.end_field; ++f) {
        if (!everywhere && layer(out_.fields[f].layer).field == layer(out_.fields[node.first_field].layer).field) continue;
        wanted[node.node] = any = true;
        break;
      }
    }
    if (any) cloud_.template collect<Shape>(state_, work_, model_, b_, wanted);
  }

  void gather_fields(const ContactNode<Dim>& node) {
    facts_.number = node.number;
    facts_.mirrors = mirrors_at(model_, node.number);
    facts_.groups = static_cast<int>(node.end_group - node.first_group);
    facts_.fields.clear();
    for (std::uint32_t f = node.first_field; f < node.end_field; ++f) {
      const ContactField& field = out_.fields[f];
      const std::size_t i = layers_.slot(field.layer, node.node);
      const ContactSums<Dim>& sums = work_.nodes.contact[i];
      FieldAtNode<Dim> at;
      at.layer = field.layer;
      at.field = layer(field.layer).field;
      at.cracks = layer(field.layer).cracks;
      at.group = field.group;
      at.m = work_.nodes.momentum[i][Dim];
      at.volume = sums.volume();
      at.x = sums.present();
      at.X = sums.original();
      at.g = sums.gradient();
      at.history = sums.history();
      facts_.fields.push_back(at);
      ContactGroup<Dim>& group = out_.groups[node.first_group + static_cast<std::uint32_t>(field.group)];
      group.m += at.m;
      group.rigid = model_.is_rigid(at.field);
      group.body = model_.contact.fields[at.field].body;
    }
  }

  void gather_cracks(const ContactNode<Dim>& node) {
    facts_.cracks.clear();
    for (std::size_t c = 0; c < layers_.node_cracks.size(); ++c) {
      const CrossingSums& sum = work_.nodes.crossing[(layers_.crossing_node_begin + c) * block_nodes<Dim> + node.node];
      if (sum.count<Dim>() == 0) continue;
      CrackAtNode<Dim> crack;
      crack.crack = layers_.node_cracks[c];
      crack.n = normalized(facts_.mirrors.mean(sum.normals<Dim>()));
      crack.N = normalized(facts_.mirrors.mean(sum.original_normals<Dim>()));
      crack.side = sum.side<Dim>();
      facts_.cracks.push_back(crack);
      out_.sides.push_back({node.number, crack.crack, static_cast<std::int8_t>((crack.side > 0 ? 1 : 0) - (crack.side < 0 ? 1 : 0))});
    }
    if (facts_.cracks.size() > 2) ++work_.scratch[b_].ledger.crowded_nodes;
  }

  State<Dim>& state_;
  StepWork<Dim>& work_;
  const Model<Dim>& model_;
  std::size_t b_;
  const BlockLayers<Dim>& layers_;
  ContactNodes<Dim>& out_;
  std::vector<int> present_, group_of_;
  ContactCloud<Dim>& cloud_;
  NodeFacts<Dim> facts_;  ///< of the node at hand
};

}  // namespace

template <int Dim, class Shape>
void find_contacts(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  work.scratch[b].contact.clear();
  if (work.nodes.layers[b].shared.empty()) return;
  NodeGatherer<Dim, Shape>(state, work, model, b).run();
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) \
  template void find_contacts<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&, std::size_t);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
