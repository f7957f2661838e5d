#pragma once
/// All pairs of a node at once, for given states of contact.

#include <vector>

#include "crampon/contact/node_solve.hpp"
#include "crampon/contact/response.hpp"

namespace crampon {

/// Impulses on b, kg m/s, one per pair, under which every pair meets the conditions of its response: which pairs push, which stick and
/// which way the others rub stays as it is. One linear system in the groups' velocities and the impulses, so that light fields between
/// heavy ones do no harm; of redundant conditions (a ring of sticking pairs) any solution. The caller judges by a sweep whether the
/// responses agree with what comes out. given: impulses that the groups have received besides, kg m/s.
template <int Dim>
void solve_together(unsigned fixed_axes, const ContactGroup<Dim>* groups, int group_count, const ContactPair<Dim>* pairs,
                    const std::vector<Response<Dim>>& responses, const std::vector<Vec<Dim>>& given, std::vector<Vec<Dim>>& impulses);

}  // namespace crampon
