#include "crampon/step/verbs.hpp"

#include "crampon/step/face_links.hpp"

namespace crampon {

template <int Dim>
void find_face_tractions(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const std::vector<Vec<Dim>>& load_values = work.prescribed.loads;
  FaceStates<Dim>& s = work.faces;
  for (std::size_t c = 0; c < model.faces.columns.size(); ++c) {
    const FaceColumn& column = model.faces.columns[c];
    double sum = 0;
    int links = 0;
    for (std::uint32_t i = column.first_link; i < column.end_link; ++i) {
      if (!s.present[model.faces.links[i].particle]) continue;
      sum += s.sum[i];
      ++links;
    }
    const bool there = s.present[column.surface];  // what has left the grid takes its face along
    s.rest[c] = there ? (column.area - sum) / links : 0.;
    s.traction[c] =
        there ? traction_on(model.loads[column.load], column, state.ledger.face_areas[c], load_values[column.load]) : Vec<Dim>{};
  }
}

template void find_face_tractions<2>(State<2>&, StepWork<2>&, const Model<2>&);
template void find_face_tractions<3>(State<3>&, StepWork<3>&, const Model<3>&);

}  // namespace crampon
