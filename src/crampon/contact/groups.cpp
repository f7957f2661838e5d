#include "crampon/contact/groups.hpp"

#include <algorithm>

namespace crampon {

template <int Dim>
int find_groups(const std::vector<Layer>& layers, const ContactModel<Dim>& contact, const std::vector<int>& present,
                std::vector<int>& group_of) {
  const auto layer = [&](std::size_t i) -> const Layer& { return layers[static_cast<std::size_t>(present[i])]; };
  group_of.assign(present.size(), -1);
  if (present.size() == 1) {
    group_of[0] = 0;
    return 1;
  }
  std::vector<int> chain(present.size());
  std::vector<Signature> reduced;
  for (std::size_t i = 0; i < present.size(); ++i) {
    chain[i] = static_cast<int>(i);
    reduced.push_back(without_bonded(layer(i).cracks, contact));
    for (std::size_t j = 0; j < i; ++j) {
      const std::uint16_t a = layer(j).field, b = layer(i).field;
      if (reduced[i] != reduced[j] || chain[i] == chain[j]) continue;
      const bool bonded =
          contact.makes_one_group(contact.law_between(a, b)) && !contact.fields[a].ignores_cracks && !contact.fields[b].ignores_cracks;
      if (a != b && !bonded) continue;
      const int low = std::min(chain[i], chain[j]), high = std::max(chain[i], chain[j]);
      for (std::size_t k = 0; k <= i; ++k) {
        if (chain[k] == high) chain[k] = low;
      }
    }
  }
  std::vector<int> number(present.size(), -1);
  int groups = 0;
  for (std::size_t i = 0; i < present.size(); ++i) {
    int& group = number[static_cast<std::size_t>(chain[i])];
    if (group < 0) group = groups++;
    group_of[i] = group;
  }
  return groups;
}

template int find_groups<2>(const std::vector<Layer>&, const ContactModel<2>&, const std::vector<int>&, std::vector<int>&);
template int find_groups<3>(const std::vector<Layer>&, const ContactModel<3>&, const std::vector<int>&, std::vector<int>&);

}  // namespace crampon
