#include "crampon/step/verbs.hpp"

#include "crampon/step/rotation_sums.hpp"

namespace crampon {

template <int Dim>
void sum_couples(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  const Nodes<Dim>& nodes = work.nodes;
  std::vector<RotationCouple>& couples = work.scratch[b].couples;
  couples.clear();
  const auto hand_over = [](RotationCouple& c, const auto& sums) { c.couple += sums[0].total(), c.torque += sums[1].total(); };
  SumsOfPieces<Dim, 2, decltype(hand_over)> sums(couples, hand_over);
  for_turning_nodes(state, work, model, b, centres(work), [&](std::size_t i, NodalVector<Dim> r, std::uint32_t piece) {
    const NodalVector<Dim> a = acceleration(nodes.motion[i]);
    auto& [couple, torque] = sums.of(piece);
    couple.add(nodes.arm[i], a);
    torque.add(splat_as<NodalVector<Dim>>(nodes.momentum[i][Dim]) * r, a);
  });
}

template void sum_couples<2>(State<2>&, StepWork<2>&, const Model<2>&, std::size_t);
template void sum_couples<3>(State<3>&, StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
