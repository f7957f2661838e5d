#include "crampon/run/output_reference.hpp"

#include <fmt/format.h>

#include "crampon/run/sample.hpp"

namespace crampon {

const std::vector<ColumnDescription>& describe_history_columns() {
  static const std::vector<ColumnDescription> all = {
      {"time", "s", "time of the row", "t"},
      {"kinetic_energy", "J", "of all particles that are not rigid", "sum of m v.v / 2"},
      {"strain_energy", "J", "in the material", "sum of V_0 W"},
      {"total_energy", "J", "kinetic and strain energy", "kinetic_energy + strain_energy"},
      {"load_work", "J", "work of loads since the start, and of pressure in cracks", "sum over steps of f.dx"},
      {"body_force_work", "J", "work of the body force since the start", "sum over steps of m b.dx"},
      {"boundary_work", "J", "work of boundaries, rigid bodies and walls on the material since the start",
       "sum over steps of reaction times way"},
      {"damping_loss", "J", "taken by damping since the start", ""},
      {"transfer_loss", "J", "taken by what particles take over from nodes (method.transfer) since the start", ""},
      {"contact_loss", "J", "lost as contact begins, and what the tasks of a step do not agree on, since the start", ""},
      {"friction_loss", "J", "lost to friction since the start", "sum over steps of tangential impulse times mean slip speed"},
      {"interface_energy", "J", "in the springs of interfaces now", ""},
      {"cohesive_energy", "J", "that traction laws of cracks would give back now", ""},
      {"cohesive_loss_I", "J", "spent by traction laws in opening since the start", ""},
      {"cohesive_loss_II", "J", "spent by traction laws in sliding since the start", ""},
      {"energy_closure", "J", "what the balance leaves open: an error of the computation",
       "total + interface + cohesive energy + all losses - all work - total energy at the start"},
      {"momentum_AXIS", "kg m/s", "of all particles that are not rigid", "sum of m v"},
      {"angular_momentum_z", "kg m2/s", "about the origin of coordinates", "sum of m (x v_y - y v_x)"},
      {"left_mass", "kg", "that has left the grid (method.leaving_particle = \"remove\")", ""},
      {"left_energy", "J", "kinetic and strain energy that left with it", ""},
      {"left_momentum_AXIS", "kg m/s", "momentum that left with it", ""},
      {"left_angular_momentum_z", "kg m2/s", "angular momentum that left with it", ""},
      {"load_AXIS.NAME", "N", "resultant of a load at the time of the row", ""},
      {"reaction_AXIS.NAME", "N", "force of a boundary, symmetry plane, rigid body or wall on the material, in the last step", ""},
      {"torque_AXIS.NAME", "N m", "moment of a rigid body or wall on the material about its centre, in the last step", ""},
      {"opening_min.NAME", "m", "smallest opening of a crack, between its tips", "(x_upper - x_lower) along the normal of the crack"},
      {"opening_max.NAME", "m", "largest opening of a crack, between its tips", "(x_upper - x_lower) along the normal of the crack"},
      {"sliding_max.NAME", "m", "largest sliding of a crack in either sense, between its tips",
       "size of (x_upper - x_lower) along the crack"},
      {"PROBE.QUANTITY", "", "a quantity of the particle that a [[probe]] watches; nan once it has left the grid",
       "components as PROBE.velocity_x, PROBE.stress_xy"},
  };
  return all;
}

namespace {

/// Does the name follow the pattern, AXIS standing for x, y or z and NAME for the rest?
bool follows(const std::string& name, const std::string& pattern) {
  const std::size_t axis = pattern.find("AXIS");
  if (axis != std::string::npos) {
    for (const char* each : {"x", "y", "z"}) {
      std::string one = pattern;
      if (follows(name, one.replace(axis, 4, each))) return true;
    }
    return false;
  }
  const std::size_t rest = pattern.find("NAME");
  return rest == std::string::npos ? name == pattern : name.size() > rest && name.starts_with(pattern.substr(0, rest));
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string components_text(int components) { return components == 3 ? "x, y, z" : components == 6 ? "xx, yy, zz, xy, yz, xz" : ""; }

}  // namespace

const ColumnDescription* find_description(const std::string& column) {
  for (const ColumnDescription& each : describe_history_columns()) {
    if (each.pattern != "PROBE.QUANTITY" && follows(column, each.pattern)) return &each;
  }
  return column.find('.') != std::string::npos ? &describe_history_columns().back() : nullptr;
}

std::string output_reference_page() {
  std::string out =
      "# What a run writes\n\n"
      "Generated from the source; `crampon quantities` prints it. All numbers are in SI.\n\n"
      "## Particle quantities\n\n"
      "`[output] quantities` chooses those that are written; the marked ones are when it is left out. Particles also carry `id` (from 0, "
      "in the "
      "order of bodies) and `body` (from 0, bodies before rigid bodies; their names are `body_names` in the field data of the file). "
      "Rigid bodies, then walls, have a row each in `rigid_start`, `rigid_centre` (m) and `rigid_turn` (3 x 3, by rows) there: what began "
      "at X "
      "is at `rigid_centre + rigid_turn (X - rigid_start)`.\n\n"
      "| quantity | unit | components | by default | meaning | formula |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const QuantityDescription& q : describe_particle_quantities())
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(q.name), q.unit, components_text(q.components), q.common ? "yes" : "",
                       q.meaning, code(q.formula));
  out +=
      "\nPictures, probes and `[[expect]]` take a component as `stress_xy` or `velocity_x`; a vector's name alone is its magnitude. "
      "`pressure`, `von_mises` and `fringes` (photoelastic, N03 Eq. 23: `cos(k_f sqrt((sigma_xx - sigma_yy)^2 + 4 sigma_xy^2))`) are found "
      "from `stress` when they were not written.\n\n"
      "## Columns of history.csv\n\n"
      "The header holds names with units, as `kinetic_energy[J]`. `AXIS` is x, y or z; `NAME` is what the input calls the thing.\n\n"
      "| column | unit | meaning | formula |\n| --- | --- | --- | --- |\n";
  for (const ColumnDescription& c : describe_history_columns())
    out += fmt::format("| {} | {} | {} | {} |\n", code(c.pattern), c.unit.empty() ? "its own" : c.unit, c.meaning, code(c.formula));
  out +=
      "\n## Cracks\n\n"
      "`cracks.pvd` holds each crack three times: its plane, its upper and its lower surface (`surface` 0, 1, 2). Vertices carry `opening` "
      "and "
      "`sliding` (m), and with a traction law `traction_normal`, `traction_shear` (Pa) and `damage` (0 whole, 1 failed). `events.csv` has "
      "a "
      "row for each vertex whose traction law failed: time, crack, place, and the energies `G_I` and `G_II` (J/m2) that it took.\n\n"
      "## Nodes\n\n"
      "With `[output] grid = true`, `grid.pvd` holds each node once for every velocity field with mass there: `cracks_across` (how many "
      "cracks lie between its particles and the node), `mass` (kg), `momentum` (kg m/s) and `force` (N) of the last step.\n\n"
      "## Pictures\n\n"
      "`crampon draw` colours particles by a quantity. Values of both signs, and every diverging palette, are coloured about zero, which "
      "is "
      "pale. "
      "`body` and `material` have a legend with names instead of a range, and no place on the axis of a `--profile`. Each body has an "
      "outline, also where it touches another. Rigid bodies and walls are drawn hatched, by their shapes at the time of the frame; they "
      "take "
      "no part in the colour range, nor in a `--profile`. In space pictures look along z; walls are shown by their section half way up the "
      "particles. Several pictures of one call (`--all`, `--frame`, `--time`) share one window and one range. Where numbers along an axis "
      "would differ in their last digits only, they show the difference from a round one that the axis names, as in "
      "`time \u2212 1.2 s (\u00b5s)`.\n";
  return out;
}

}  // namespace crampon
