#include <fmt/format.h>

#include "crampon/run/notes/notes.hpp"

namespace crampon {

template <int Dim>
Notes find_notes(Start<Dim> start) {
  start.bodies = find_body_spaces(start.problem, start.model, start.state);
  Notes notes;
  for (const auto note : {
           note_contact_without_fields<Dim>,
           note_overlapping_bodies<Dim>,
           note_particles_in_walls<Dim>,
           note_large_particles<Dim>,
           note_stairs_of_particles<Dim>,
           note_thin_rigid_bodies<Dim>,
           note_idle_cracks<Dim>,
           note_idle_growth<Dim>,
           note_tangled_cracks<Dim>,
           note_idle_conditions<Dim>,
           note_far_probes<Dim>,
           note_unstable_method<Dim>,
           note_braked_rotation<Dim>,
           note_late_output<Dim>,
       })
    note(start, notes);
  return notes;
}

template <int Dim>
std::string place_text(const Vec<Dim>& x) {
  std::string out = "(";
  for (int k = 0; k < Dim; ++k) out += fmt::format("{}{:.6g}", k ? ", " : "", x[k]);
  return out + ") m";
}

template <int Dim>
std::string measure_text(double measure) {
  return fmt::format("{:.3g} {}", measure, Dim == 2 ? "m2" : "m3");
}

#define CRAMPON_INSTANTIATE(DIM)                    \
  template Notes find_notes<DIM>(Start<DIM>);       \
  template std::string place_text(const Vec<DIM>&); \
  template std::string measure_text<DIM>(double);
CRAMPON_INSTANTIATE(2)
CRAMPON_INSTANTIATE(3)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
