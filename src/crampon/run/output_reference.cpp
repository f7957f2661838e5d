#include "crampon/run/output_reference.hpp"

#include <fmt/format.h>

#include "crampon/material/material.hpp"
#include "crampon/output/stress_measures.hpp"
#include "crampon/run/crack_quantities.hpp"
#include "crampon/run/observers/registry.hpp"
#include "crampon/run/quantities.hpp"

namespace crampon {

const std::vector<ColumnDescription>& describe_history_columns() {
  static const std::vector<ColumnDescription> all = describe_observers();
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

std::vector<const MaterialLaw*> pointers_to(const std::vector<MaterialSpec>& specs) {
  std::vector<const MaterialLaw*> laws;
  for (const MaterialSpec& law : specs) laws.push_back(law.get());
  return laws;
}

/// Of each variable that laws declare, with the laws that do.
std::string law_variables_table() {
  const std::vector<MaterialSpec> examples = material_examples();
  const std::vector<const MaterialLaw*> laws = pointers_to(examples);
  std::string out = "| quantity | unit | components | by default | laws | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const ParticleQuantity& q : quantities_of_laws(laws)) {
    std::string of;
    for (const MaterialLaw* law : laws) {
      if (law->find_variable(2, q.name)) of += (of.empty() ? "" : ", ") + code(law->name());
    }
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(q.name), q.unit, components_text(q.components), q.common ? "yes" : "", of,
                       q.help);
  }
  return out;
}

std::string crack_quantities_table() {
  const auto where = [](CrackFrames in) {
    switch (in) {
      case CrackFrames::with_tractions:
        return "in runs with a traction law";
      case CrackFrames::with_fracture:
        return "at tips, in runs with `[fracture]`";
      case CrackFrames::all:
        break;
    }
    return "";
  };
  std::string out = "| quantity | unit | where | meaning | formula |\n| --- | --- | --- | --- | --- |\n";
  for (const CrackQuantity& q : crack_quantities())
    out += fmt::format("| {} | {} | {} | {} | {} |\n", code(q.name), q.unit, where(q.in), q.meaning, code(q.formula));
  return out;
}

}  // namespace

KnownWords output_words() {
  KnownWords words;
  std::vector<std::string>& quantities = words["particle quantities"];
  for (const ParticleQuantity& q : general_quantities()) quantities.push_back(q.name);
  const std::vector<MaterialSpec> examples = material_examples();
  for (const ParticleQuantity& q : quantities_of_laws(pointers_to(examples))) quantities.push_back(q.name);
  std::vector<std::string>& columns = words["history columns"];
  for (const ColumnDescription& column : describe_history_columns()) {
    const std::string& pattern = column.pattern;
    if (pattern.find("NAME") != std::string::npos || pattern.find("PROBE") != std::string::npos) continue;
    const std::size_t axis = pattern.find("AXIS");
    for (const char* each : {"x", "y", "z"}) {
      columns.push_back(axis == std::string::npos ? pattern : std::string(pattern).replace(axis, 4, each));
      if (axis == std::string::npos) break;
    }
  }
  return words;
}

const ColumnDescription* find_description(const std::string& column) {
  const ColumnDescription* of_probes = nullptr;
  for (const ColumnDescription& each : describe_history_columns()) {
    if (each.pattern == "PROBE.QUANTITY")
      of_probes = &each;
    else if (follows(column, each.pattern))
      return &each;
  }
  return column.find('.') != std::string::npos ? of_probes : nullptr;
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
  for (const ParticleQuantity& q : general_quantities())
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(q.name), q.unit, components_text(q.components), q.common ? "yes" : "",
                       q.help, code(q.formula));
  out += "\nLaws measure strain in different ways:\n\n| law | strain |\n| --- | --- |\n";
  for (const MaterialSpec& law : material_examples()) out += fmt::format("| {} | {} |\n", code(law->name()), code(law->strain_measure()));
  out += "\nVariables of material laws are quantities too where a body is made of such a law. Particles of other laws hold nan.\n\n" +
         law_variables_table();
  out +=
      "\nPictures, probes and `[[expect]]` take a component as `stress_xy` or `velocity_x`; a vector's name alone is its magnitude. "
      "What "
      "can be found from `stress` is found when it was not written:\n\n| name | meaning | formula |\n| --- | --- | --- |\n";
  for (const StressMeasure& m : stress_measures()) out += fmt::format("| `{}` | {} | `{}` |\n", m.name, m.help, m.formula);
  out +=
      "\n"
      "## Columns of history.csv\n\n"
      "The header holds names with units, as `kinetic_energy[J]`. `AXIS` is x, y or z; `NAME` is what the input calls the thing.\n\n"
      "| column | unit | meaning | formula |\n| --- | --- | --- | --- |\n";
  for (const ColumnDescription& c : describe_history_columns())
    out += fmt::format("| {} | {} | {} | {} |\n", code(c.pattern), c.unit.empty() ? "its own" : c.unit, c.meaning, code(c.formula));
  out +=
      "\n## Cracks\n\n"
      "`cracks.pvd` holds each crack three times: its plane, its upper and its lower surface (`surface` 0, 1, 2). Vertices carry the "
      "quantities of this table. What tips have is as it was last found, and nan at all other vertices; `crampon info` lists it for the "
      "last frame.\n\n" +
      crack_quantities_table() +
      "\n`events.csv` has a row for what happened to cracks, by the number in `event`. 0: a traction law failed at a vertex; `G_I` and "
      "`G_II` (J/m2) are the energies that it took there. 1: a tip grew; 2: it grew into another crack; 3: it grew out of the body; 4: it "
      "grew as far as it may. Of a tip `crack` is the number of the crack from 0, `end` is 0 at the start of its path and 1 at its end, "
      "the place is where it is now, `angle` (rad) is its turn to the left, and `J`, `K_I` and `K_II` are what it had before. 5: a crack "
      "started (`[[nucleation]]`); the place is that of the highest mean stress, `angle` is that from the x axis to the path of the crack. "
      "Cracks are numbered in the order of the input, those that may start after all `[[crack]]`. `cracks.pvd` leaves them out until they "
      "start; before, their columns of `history.csv` hold nan, and `crack_length` 0.\n\n"
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
      "`time \u2212 1.2 s (\u00b5s)`.\n\n"
      "Cracks are drawn by their two surfaces; what has grown since the first frame is red. With `[fracture]` a ring marks each tip that "
      "lies in a body, and `--tip-names` writes its name beside it where there is room. A line under the picture says what the colours "
      "and the ring mean.\n\n"
      "`--history` plots columns of history.csv. A name without its dots stands for all columns that begin with it: `--history J "
      "crack_length` plots J of every tip and the length of every crack. `--against crack_length` puts the length of its own crack under "
      "each of these, `--against grown.NAME.END` how far a tip has grown. Formulas take the whole name: "
      "`\"G [J/m2] = J.notch.end/2\"`. Where a column holds nan the curve has a gap.\n";
  return out;
}

}  // namespace crampon
