#include "crampon/contact/cracks_between.hpp"

#include <algorithm>

#include "crampon/contact/strictest.hpp"

namespace crampon {

template <int Dim>
std::optional<CracksBetween<Dim>> cracks_between(const Signature& first, const Signature& second,
                                                 const std::vector<CrackAtNode<Dim>>& cracks, const ContactModel<Dim>& contact) {
  CracksBetween<Dim> out;
  out.name.others = first.without(first.without(second));
  int acting = 0;
  double up = 0;  // +1 where the normal of the first crack that acts points from the first side to the second
  Vec<Dim> n, N;
  for (const CrackAtNode<Dim>& crack : cracks) {
    const bool first_across = first.contains(crack.crack);
    if (first_across == second.contains(crack.crack)) continue;
    if (out.name.crack == ContactName::no_crack) {
      out.name.crack = crack.crack;
    } else {
      out.name.rest.append(crack.crack);
    }
    const ContactLaw& law = contact.law_across(crack.crack);
    if (crack.side == 0 || law.ignores()) continue;
    const double to_second = first_across == (crack.side > 0) ? 1 : -1;
    if (acting++ == 0) up = to_second, out.as_one = crack;
    n += crack.n * (to_second * up);
    N += crack.N * (to_second * up);
    out.law = out.law ? &strictest(*out.law, law) : &law;
  }
  if (acting == 0) return std::nullopt;
  out.first_above = up > 0;
  if (acting > 1) out.as_one.n = normalized(n), out.as_one.N = normalized(N);
  return out;
}

#define CRAMPON_INSTANTIATE(DIM)                                                                                                           \
  template std::optional<CracksBetween<DIM>> cracks_between<DIM>(const Signature&, const Signature&, const std::vector<CrackAtNode<DIM>>&, \
                                                                 const ContactModel<DIM>&);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
