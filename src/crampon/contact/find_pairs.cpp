#include "crampon/contact/find_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "crampon/contact/cracks_between.hpp"

namespace crampon {

template <int Dim>
CloudsWanted clouds_wanted(const ContactModel<Dim>& contact, const Grid<Dim>& grid) {
  const bool by_regression = contact.normal == ContactNormal::logistic_regression || contact.normal == ContactNormal::linear_regression;
  CloudsWanted wanted;
  wanted.among_materials = contact.several_fields() && (by_regression || outlines_tell(contact.material_detection, grid));
  wanted.across_cracks = outlines_tell(contact.detection, grid) || contact.any_law([](const ContactLaw& law) { return law.has_springs(); });
  return wanted;
}

template <int Dim>
const std::vector<ContactPair<Dim>>& PairFinder<Dim>::find(NodeFacts<Dim>& node) {
  node_ = &node;
  pairs_.clear();
  find_faces(node, contact_, faces_);
  complete_cloud(node);
  place_ = {node.number, 0, node.mirrors, &node.cloud};
  for (const Face<Dim>& face : faces_) place_.volume += face.volume;
  pair_materials();
  pair_sides();
  pair_ignoring_cracks();
  return pairs_;
}

template <int Dim>
void PairFinder<Dim>::complete_cloud(NodeFacts<Dim>& node) const {
  for (CloudPoint<Dim>& point : node.cloud) {
    for (const FieldAtNode<Dim>& field : node.fields) {
      if (field.layer == point.layer) point.group = only(field.group);
    }
  }
  for (int k = 0; k < Dim; ++k) {
    if (node.mirrors.axes >> k & 1u) add_images(node.cloud, k);
  }
}

// Materials inside a crack field (N13 sec. 2.3).
template <int Dim>
void PairFinder<Dim>::pair_materials() {
  for (std::size_t a = 0; a < faces_.size(); ++a) {
    if (faces_[a].ignores_cracks) continue;
    int others = 0;
    for (const Face<Dim>& f : faces_) others += !f.ignores_cracks && f.cracks == faces_[a].cracks;
    if (others > 2 && contact_.several_materials == SeveralMaterials::virtual_material) {
      pair_with_virtual(a);
      continue;
    }
    for (std::size_t b = a + 1; b < faces_.size(); ++b) {
      if (!faces_[b].ignores_cracks && faces_[b].cracks == faces_[a].cracks) pair_faces(faces_[a], faces_[b]);
    }
  }
  // N13's virtual materials first, by crack field; solve_contact relies on it.
  std::stable_sort(pairs_.begin(), pairs_.end(), [](const ContactPair<Dim>& a, const ContactPair<Dim>& b) {
    return std::tuple(!a.is_virtual(), a.name.others) < std::tuple(!b.is_virtual(), b.name.others);
  });
}

/// N13 Eq. 8. The law and the normal are those of the pair with the other material of most volume.
template <int Dim>
void PairFinder<Dim>::pair_with_virtual(std::size_t a) {
  Face<Dim> rest;
  rest.cracks = faces_[a].cracks;
  const Face<Dim>* most = nullptr;
  for (std::size_t b = 0; b < faces_.size(); ++b) {
    if (b == a || faces_[b].ignores_cracks || faces_[b].cracks != rest.cracks) continue;
    rest.add(faces_[b]);
    if (!most || faces_[b].volume > most->volume) most = &faces_[b];
  }
  pair_faces(faces_[a], rest, most);
}

/// Bodies that no crack parts, with all others whatever cracks part those; rigid ones last (conventions 36).
template <int Dim>
void PairFinder<Dim>::pair_ignoring_cracks() {
  for (const bool rigid : {false, true}) {
    for (std::size_t w = 0; w < faces_.size(); ++w) {
      if (!faces_[w].ignores_cracks || faces_[w].rigid != rigid) continue;
      for (std::size_t f = 0; f < faces_.size(); ++f) {
        const bool met_before = faces_[f].ignores_cracks && f >= w;
        if (!faces_[f].rigid && (rigid || !met_before)) pair_faces(faces_[f], faces_[w]);
      }
    }
  }
}

/// a and b as materials; b may be N13's virtual material, of which `facing` is the part that gives law and normal.
template <int Dim>
void PairFinder<Dim>::pair_faces(const Face<Dim>& a, const Face<Dim>& b, const Face<Dim>* facing) {
  const Face<Dim>& other = facing ? *facing : b;
  ContactPair<Dim> pair;
  pair.law = &contact_.law_between(a.field, other.field);
  if (pair.law->ignores()) return;
  const bool bonded = pair.law->bonds();
  if (!bonded && !b.rigid && std::fmin(a.m, b.m) < contact_.mass_screen * (a.m + b.m)) return;  // conventions 37
  pair.a = a.groups;
  pair.b = b.groups;
  pair.name.field_a = a.known_as;
  pair.name.field_b = facing ? ContactName::all_others : b.known_as;
  pair.name.others = a.cracks;
  if (!face_to_face_.see_material(place_, a, b, other, pair)) return;
  const std::size_t first = pairs_.size();
  pairs_.push_back(pair);
  if (!facing) face_to_face_.part_corner(place_, a, b, pairs_);
  for (std::size_t q = first; q < pairs_.size(); ++q) pairs_[q].previous = previous_state(pairs_[q]);
}

/// All materials on either side of a crack (N13 sec. 2.3; conventions 34).
template <int Dim>
void PairFinder<Dim>::pair_sides() {
  if (node_->cracks.empty()) return;
  const std::size_t begin = pairs_.size();
  sides_.clear();
  for (const Face<Dim>& f : faces_) {
    if (f.ignores_cracks) continue;
    auto at = std::find_if(sides_.begin(), sides_.end(), [&](const Face<Dim>& s) { return s.cracks == f.cracks; });
    if (at == sides_.end()) {
      sides_.push_back(f);
    } else {
      at->add(f);
    }
  }
  for (std::size_t g = 0; g < sides_.size(); ++g) {
    for (std::size_t h = g + 1; h < sides_.size(); ++h) {
      if (face_each_other(g, h)) pair_across(sides_[g], sides_[h]);
    }
  }
  // conventions 13: [0][1], [2][3] of the first crack, then [0][2], [1][3] of the second.
  std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(begin), pairs_.end(),
            [](const ContactPair<Dim>& a, const ContactPair<Dim>& b) { return a.name < b.name; });
}

/// Sides that differ by one crack do; by several, where no other side of this node lies between them (conventions 50). N13 has pairs of
/// the first kind only.
template <int Dim>
bool PairFinder<Dim>::face_each_other(std::size_t g, std::size_t h) const {
  const int apart = differences(sides_[g].cracks, sides_[h].cracks);
  if (apart == 1) return true;
  return contact_.pairs == ContactPairs::joint && std::none_of(sides_.begin(), sides_.end(), [&](const Face<Dim>& s) {
           return differences(sides_[g].cracks, s.cracks) < apart && differences(s.cracks, sides_[h].cracks) < apart;
         });
}

template <int Dim>
void PairFinder<Dim>::pair_across(const Face<Dim>& g, const Face<Dim>& h) {
  const auto between = cracks_between(g.cracks, h.cracks, node_->cracks, contact_);
  if (!between) return;
  const Face<Dim>&a = between->first_above ? g : h, &b = between->first_above ? h : g;
  ContactPair<Dim> pair;
  pair.law = between->law;
  const double fraction = a.m / (a.m + b.m);
  const bool bonded = pair.law->bonds();
  if (!bonded && std::fmin(fraction, 1 - fraction) < contact_.mass_screen) return;  // conventions 37
  pair.a = a.groups;
  pair.b = b.groups;
  pair.name = between->name;
  if (!face_to_face_.see_across(place_, between->as_one, a, b, pair)) return;
  pair.previous = previous_state(pair);
  pairs_.push_back(pair);
}

/// Where the node has changed sides of another crack, the pair was known under the other label.
template <int Dim>
ContactState PairFinder<Dim>::previous_state(const ContactPair<Dim>& pair) const {
  if (first_step_ && pair.law->adheres() && pair.gap <= 0.1 * grid_.smallest_cell()) return ContactState::stick;  // glued from the start
  ContactKey key{node_->number, pair.name};
  for (const auto& k : node_->cracks) {
    if (k.crack == pair.name.crack || pair.name.rest.contains(k.crack) || contact_.makes_one_group(contact_.law_across(k.crack))) continue;
    const double before = memory_.side(node_->number, k.crack);
    if (before * k.side < 0) key.name.others.toggle(k.crack);
  }
  return memory_.find(key);
}

template CloudsWanted clouds_wanted<2>(const ContactModel<2>&, const Grid<2>&);
template CloudsWanted clouds_wanted<3>(const ContactModel<3>&, const Grid<3>&);
template class PairFinder<2>;
template class PairFinder<3>;

}  // namespace crampon
