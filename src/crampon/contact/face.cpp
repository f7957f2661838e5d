#include "crampon/contact/face.hpp"

#include "crampon/contact/groups.hpp"

namespace crampon {

namespace {

/// Contact remembers a face by the lowest field to which bonded laws join it anywhere. Two groups of a node have the same such field when
/// the fields that join them have no mass at this node. Then each group is remembered by the lowest of its own fields.
template <int Dim>
void tell_apart(std::vector<Face<Dim>>& faces) {
  for (std::size_t g = 1; g < faces.size(); ++g) {
    for (std::size_t h = 0; h < g; ++h) {
      Face<Dim>&a = faces[g], &b = faces[h];
      if (a.known_as == b.known_as && a.cracks == b.cracks) a.known_as = a.lowest_field, b.known_as = b.lowest_field;
    }
  }
}

}  // namespace

template <int Dim>
void find_faces(const NodeFacts<Dim>& node, const ContactModel<Dim>& contact, std::vector<Face<Dim>>& faces) {
  faces.assign(static_cast<std::size_t>(node.groups), {});
  const Mirrors& mirrors = node.mirrors;
  for (const FieldAtNode<Dim>& at : node.fields) {
    const MaterialField& field = contact.fields[at.field];
    Face<Dim> part;
    part.groups = only(at.group);
    part.m = mirrors.images * at.m;
    part.volume = part.field_volume = mirrors.images * at.volume;
    part.x = mirrors.together(at.x);
    part.X = mirrors.together(at.X);
    part.g = mirrors.together(at.g);
    part.history = mirrors.images * at.history;
    part.field = part.lowest_field = at.field;
    part.known_as = field.bonded_to;
    Face<Dim>& face = faces[static_cast<std::size_t>(at.group)];
    face.cracks = without_bonded(at.cracks, contact);
    face.rigid = field.rigid;
    face.ignores_cracks = field.ignores_cracks;
    face.add(part);
  }
  for (Face<Dim>& face : faces) {
    for (const Face<Dim>& other : faces) {
      face.company |= other.groups;
    }
  }
  tell_apart(faces);
}

template void find_faces<2>(const NodeFacts<2>&, const ContactModel<2>&, std::vector<Face<2>>&);
template void find_faces<3>(const NodeFacts<3>&, const ContactModel<3>&, std::vector<Face<3>>&);

}  // namespace crampon
