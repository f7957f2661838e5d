#include "crampon/step/verbs.hpp"

namespace crampon {

template <int Dim>
void remember_contacts(State<Dim>& state, StepWork<Dim>& work) {
  state.contacts.entries.clear();
  state.contacts.sides.clear();
  for (const auto& scratch : work.scratch) {
    for (const ContactNode<Dim>& node : scratch.contact.nodes) {
      for (std::uint32_t q = node.first_pair; q < node.end_pair; ++q) {
        const ContactPair<Dim>& pair = scratch.contact.pairs[q];
        if (pair.state != ContactState::open) state.contacts.entries.push_back({{node.number, pair.name}, pair.state});
      }
    }
    state.contacts.sides.insert(state.contacts.sides.end(), scratch.contact.sides.begin(), scratch.contact.sides.end());
  }
  for (const ContactColumn<Dim>& column : work.face_contacts.columns) {
    if (column.pair.state != ContactState::open) state.contacts.entries.push_back({{column.name, column.pair.name}, column.pair.state});
  }
  state.contacts.sort();
}

template void remember_contacts<2>(State<2>&, StepWork<2>&);
template void remember_contacts<3>(State<3>&, StepWork<3>&);

}  // namespace crampon
