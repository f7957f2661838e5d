#include "crampon/step/filled_space.hpp"

#include "crampon/step/point_fields.hpp"

namespace crampon {

namespace {

/// As filled(), of the piece of material or of all others.
double filled_by(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, std::uint32_t material, bool others) {
  const Material<2>& of = model.materials[material];
  const auto& fields = model.contact.fields;
  double mass = 0;
  for (const PointNode<2>& node : PointFields<2>(work, model).nodes(x)) {
    const BlockLayers<2>& layers = work.nodes.layers[node.block];
    for (std::size_t l = 0; l < layers.node.size(); ++l) {
      const MaterialField& field = fields[layers.node[l].field];
      if (field.ignores_cracks || (field.bonded_to != fields[of.field].bonded_to) != others) continue;
      mass += node.S * work.nodes.momentum[layers.slot(l, node.local)][2];
    }
  }
  return mass / (of.law->density() * model.grid.cell[0] * model.grid.cell[1] * of.thickness);
}

}  // namespace

double filled(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, std::uint32_t material) {
  return filled_by(work, model, x, material, false);
}

double extension_beyond(const StepWork<2>& work, const Model<2>& model, const Vec<2>& x, const Vec<2>& e, std::uint32_t material,
                        double reach) {
  const double step = 0.25 * model.grid.largest_cell();
  double length = step;
  while (length + step <= reach && filled_by(work, model, x + e * (length + step), material, true) < 0.05) length += step;
  return length;
}

}  // namespace crampon
