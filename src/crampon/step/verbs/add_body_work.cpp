#include "crampon/step/verbs.hpp"

#include "crampon/step/body_work.hpp"

namespace crampon {

template <int Dim>
void add_body_work(StepWork<Dim>& work, const Model<Dim>& model, std::size_t b) {
  book_body_work(work, model, b, 0.5 * work.now.dt);
}

template void add_body_work<2>(StepWork<2>&, const Model<2>&, std::size_t);
template void add_body_work<3>(StepWork<3>&, const Model<3>&, std::size_t);

}  // namespace crampon
