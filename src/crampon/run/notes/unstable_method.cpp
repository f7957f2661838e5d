#include "crampon/run/notes/notes.hpp"

namespace crampon {

template <int Dim>
void note_unstable_method(const Start<Dim>& start, Notes& notes) {
  const MethodInput& method = start.problem.method;
  if (method.stress_update == StressUpdate::usl && method.shape_functions == kind_of<LinearShape>) {
    notes.push_back(
        {method.at("stress_update"), "usl with linear shape functions",
         "strain follows from velocities that were divided by the small masses of nodes at edges; errors grow until the run stops",
         "use usavg or musl, or gimp or bspline shape functions"});
  }
}

template void note_unstable_method(const Start<2>&, Notes&);
template void note_unstable_method(const Start<3>&, Notes&);

}  // namespace crampon
