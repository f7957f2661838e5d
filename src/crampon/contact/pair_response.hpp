#pragma once
/// What a pair does in each task of a step (docs/theory/contact.md, when it acts).

#include "crampon/contact/node_solve.hpp"
#include "crampon/contact/response.hpp"

namespace crampon {

/// The impulse of a pair when all others are held. m: the mass that the pair moves, kg; w: velocity of b against a without the pair's own
/// impulse, m/s. Keeps the state of the pair for the tasks that follow.
template <int Dim>
Response<Dim> respond(const ContactRules& rules, ContactPair<Dim>& pair, double m, const Vec<Dim>& w);

}  // namespace crampon
