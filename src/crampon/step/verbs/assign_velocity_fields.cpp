#include "crampon/step/verbs.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "crampon/core/error.hpp"
#include "crampon/core/parallel.hpp"
#include "crampon/crack/crossing.hpp"
#include "crampon/step/assemble.hpp"
#include "crampon/step/folded_pairs.hpp"
#include "crampon/step/instantiate.hpp"
#include "crampon/step/lay_out_nodes.hpp"
#include "crampon/step/packs.hpp"
#include "crampon/step/view_cracks.hpp"

namespace crampon {

namespace {

/// What one block finds out about its particles.
template <int Dim, class Shape>
class BlockAssignment {
  using T = Tile<Dim, Shape>;

 public:
  BlockAssignment(const State<Dim>& state, const StepWork<Dim>& work, const Model<Dim>& model, std::size_t b, BlockLayers<Dim>& layers,
                  std::vector<CrossingSums>& crossing, double dt)
      : state_(state),
        work_(work),
        model_(model),
        view_(work.crack_view),
        block_(work.blocks.list[b]),
        layers_(layers),
        crossing_(crossing),
        held_(work, model, b),
        folder_(model, held_),
        dt_(dt) {}

  bool needed() const {
    if (!block_.has_particles()) return false;
    const auto first = block_.first_node();
    IndexVector<Dim> low = first, high = first;
    for (int k = 0; k < Dim; ++k) low[k] -= 2, high[k] += block_side + 1;
    if (view_.bins.any_in_box(low, high)) return true;
    if constexpr (sees_beyond_faces<Shape>) {
      if (held_.any()) return true;
      for (const SymmetryPlane& plane : model_.symmetries) {
        const double g = (plane.at - model_.grid.origin[plane.axis]) * model_.grid.inverse_cell[plane.axis] - first[plane.axis];
        if (g > -3 && g < block_side + 3) return true;
      }
    }
    return false;
  }

  /// Layers of pairs that cross nothing: one for each material field of the block.
  void begin() {
    if (!block_.has_particles()) return;
    layers_.tile.clear();
    layers_.tile_box.clear();
    for (std::uint32_t r = block_.first_run; r < block_.end_run; ++r) {
      layers_.run_layer.push_back(
          static_cast<std::uint8_t>(layer_number({model_.materials[state_.order.runs[r].material].field, Signature{}})));
    }
  }
  /// False when a line crosses too many cracks or the block has too many layers.
  bool finish() {
    sort_layers();
    return fits_;
  }

  void run() {
    const auto first = block_.first_node();
    const std::uint32_t first_pack = state_.order.runs[block_.first_run].first_pack;
    const std::uint32_t end_pack = state_.order.runs[block_.end_run - 1].end_pack;
    layers_.targets_of_pack.assign(end_pack - first_pack, -1);
    std::int32_t count = 0;
    StencilFactors<Dim, Shape> stencil;
    const Run* run = &state_.order.runs[block_.first_run];
    for (std::uint32_t k = first_pack; k < end_pack; ++k) {
      while (k >= run->end_pack) ++run;
      Pack x[Dim];
      state_.particles.pack_positions(k, x);
      bool near = false;
      for (int l = 0; l < lanes && !near; ++l) near = near_something(x, l);
      if (!near) continue;
      compute_factors<Dim, Shape>(state_.particles, model_.grid, first, model_.materials[run->material].half_size, k, stencil);
      layers_.targets_of_pack[k - first_pack] = count++;
      field_ = model_.materials[run->material].field;
      rigid_ = model_.is_rigid(field_);
      sees_cracks_ = !model_.ignores_cracks(field_);
      own_layer_ = layers_.run_layer[static_cast<std::size_t>(run - &state_.order.runs[block_.first_run])];
      for (int l = 0; l < lanes; ++l) assign(stencil, x, l, state_.particles.is_padding(std::size_t{k} * lanes + l));
    }
    if (count == 0) layers_.targets_of_pack.clear();
  }

 private:
  IndexVector<Dim> cell_of(const Pack* x, int l) const {
    IndexVector<Dim> cell{};
    for (int k = 0; k < Dim; ++k) {
      cell[k] = static_cast<int>(std::floor((x[k][l] - model_.grid.origin[k]) * model_.grid.inverse_cell[k]));
    }
    return cell;
  }
  bool near_something(const Pack* x, int l) const {
    if (!view_.bins.empty() && !view_.bins.facets_of_cell(cell_of(x, l)).empty()) return true;
    if constexpr (sees_beyond_faces<Shape>) {
      if (held_.any() && held_.near_cell(cell_of(x, l))) return true;
      for (const SymmetryPlane& p : model_.symmetries) {
        if (std::fabs(x[p.axis][l] - p.at) < Shape::reach(largest_half_extent) * model_.grid.cell[p.axis]) return true;
      }
    }
    return false;
  }

  void assign(const StencilFactors<Dim, Shape>& stencil, const Pack* x, int l, bool padding) {
    const auto first = block_.first_node();
    Vec<Dim> x_p;
    for (int k = 0; k < Dim; ++k) x_p[k] = x[k][l];
    std::array<PairTarget, T::stencil> target;
    std::array<Signature, T::stencil> signature;
    std::array<Vec<Dim>, T::stencil> x_i;  // where the line from the particle goes
    std::array<int, T::stencil> mirror;
    const auto lowest = unflatten<Dim>(stencil.base[l], T::side);
    for (int n = 0; n < T::stencil; ++n) {
      auto node = unflatten<Dim>(n, Shape::width);
      for (int k = 0; k < Dim; ++k) node[k] += lowest[k] + first[k] - T::offset;
      x_i[n] = model_.grid.node_position(node);
      target[n] = {static_cast<std::uint16_t>(stencil.base[l] + T::steps[n]), own_layer_, 0};
      mirror[n] = fold(x_p, node, x_i[n], target[n]);
    }
    if (!view_.bins.empty() && sees_cracks_) cross(stencil, x, l, x_p, x_i, target, mirror, signature, padding);
    for (int n = 0; n < T::stencil; ++n) {
      if (!signature[n].empty()) {
        const int layer = layer_number({field_, signature[n]});
        target[n].layer = static_cast<std::uint8_t>(layer);
        layers_.tile_box[static_cast<std::size_t>(layer)].include(unflatten<Dim>(target[n].node, T::side));
      }
      layers_.targets.push_back(target[n]);
    }
  }

  /// The pair goes to the mirror node where it is folded. Returns the symmetry plane, through which the line to the node beyond goes and meets
  /// the images of cracks there, or -1: of images in several planes, or in held faces, none are known, and the line goes to the mirror node.
  int fold(const Vec<Dim>& x_p, const IndexVector<Dim>& node, Vec<Dim>& x_i, PairTarget& target) {
    const FoldedPair<Dim> pair = folder_.fold(x_p, node, !rigid_);
    if (!pair.folded()) return -1;
    for (int k = 0; k < Dim; ++k) {
      target.node = static_cast<std::uint16_t>(target.node + (pair.node[k] - node[k]) * power(T::side, k));
    }
    target.flip = static_cast<std::uint8_t>(pair.flip);
    target.mirrored = static_cast<std::uint8_t>(pair.mirrored);
    target.held = pair.held;
    target.offset = offset_number(pair);
    if (pair.mirror) return static_cast<int>(pair.mirror - model_.symmetries.data());
    x_i = pair.x_i;
    return -1;
  }

  /// Faces mostly move as one: of the offsets known so far the last ones are looked through.
  std::uint16_t offset_number(const FoldedPair<Dim>& pair) {
    PairOffsets<Dim>& offsets = layers_.offsets;
    Pack start = splat(0.), end = splat(0.);
    for (int k = 0; k < Dim; ++k) start[k] = pair.offset_start[k], end[k] = pair.offset_end[k];
    const auto same = [](Pack a, Pack b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; };
    const std::size_t count = offsets.start.size();
    if (same(start, splat(0.)) && same(end, splat(0.))) return 0;
    for (std::size_t i = count; i-- > 1 && i + 32 > count;) {
      if (same(offsets.start[i], start) && same(offsets.end[i], end)) return static_cast<std::uint16_t>(i);
    }
    if (count == std::size_t{1} << 16) {
      fits_ = false;
      return 0;
    }
    const Pack rate = (end - start) * splat(1 / dt_);
    MotionRecord<Dim> motion;
    if constexpr (Dim == 2) {
      motion.r[0] = Pack{end[0], end[1], rate[0], rate[1]};
    } else {
      motion.r[0] = end;
      motion.r[1] = rate;
    }
    offsets.start.push_back(start);
    offsets.end.push_back(end);
    offsets.motion.push_back(motion);
    return static_cast<std::uint16_t>(count);
  }

  void cross(const StencilFactors<Dim, Shape>& stencil, const Pack* x, int l, const Vec<Dim>& x_p,
             const std::array<Vec<Dim>, T::stencil>& x_i, const std::array<PairTarget, T::stencil>& target,
             const std::array<int, T::stencil>& mirror, std::array<Signature, T::stencil>& signature, bool padding) {
    const std::span<const FacetRef> facets = view_.bins.facets_of_cell(cell_of(x, l));
    std::array<Crossing<Dim>, T::stencil> crossings;
    for (std::size_t f = 0; f < facets.size();) {
      const CrackId c = facets[f].crack;
      const std::size_t first = f;
      while (f < facets.size() && facets[f].crack == c) ++f;
      cross_stencil<Dim>(view_.meshes[c], facets.subspan(first, f - first), x_p, x_i, crossings);
      for (int n = 0; n < T::stencil; ++n) {
        // A corner of the stencil that the particle does not reach (uGIMP) is no pair.
        if (!crossings[n].crosses() || stencil.weight(n, l) == 0) continue;
        const CrackId crack = mirror[n] < 0 ? c : seen_in_mirror(view_, c, static_cast<std::size_t>(mirror[n]));
        fits_ = signature[n].insert(crack) && fits_;
        // Padding follows the particle it sits on, but is not a pair of its own.
        if (!padding) add_crossing(crack, target[n].node, crossings[n], mirror[n] < 0 ? 0u : target[n].mirrored);
      }
    }
  }

  /// \param mirrored  components of the normals that the node in the mirror sees turned round
  void add_crossing(CrackId c, int node, const Crossing<Dim>& crossing, unsigned mirrored) {
    std::vector<CrackId>& cracks = layers_.tile_cracks;
    const auto at = static_cast<std::size_t>(std::find(cracks.begin(), cracks.end(), c) - cracks.begin());
    if (at == cracks.size()) {
      cracks.push_back(c);
      crossing_.resize(cracks.size() * T::nodes, CrossingSums{});
    }
    CrossingSums& sum = crossing_[at * T::nodes + static_cast<std::size_t>(node)];
    const auto of_pair = CrossingSums::of_pair<Dim>(crossing.normal_sum, crossing.original_sum, crossing.side());
    for (int i = 0; i < 2; ++i) sum.r[i] += flipped(of_pair.r[i], mirrored);
  }

  int layer_number(const Layer& layer) {
    const int found = layer_of<Dim>(layers_.tile, layer);
    if (found >= 0) return found;
    if (layers_.tile.size() == 255) {
      fits_ = false;
      return 0;
    }
    layers_.tile.push_back(layer);
    layers_.tile_box.emplace_back();
    return static_cast<int>(layers_.tile.size()) - 1;
  }

  /// Layers in the order of their fields and signatures, cracks in the order of their ids: no trace of the order of discovery.
  void sort_layers() {
    if (!std::is_sorted(layers_.tile.begin(), layers_.tile.end())) {
      const std::vector<std::size_t> order = order_of(layers_.tile);
      std::vector<Layer> tile;
      std::vector<TileBox<Dim>> boxes;
      std::vector<std::uint8_t> rank(order.size());
      for (std::size_t i = 0; i < order.size(); ++i) {
        rank[order[i]] = static_cast<std::uint8_t>(i);
        tile.push_back(layers_.tile[order[i]]);
        boxes.push_back(layers_.tile_box[order[i]]);
      }
      layers_.tile = std::move(tile);
      layers_.tile_box = std::move(boxes);
      for (PairTarget& t : layers_.targets) t.layer = rank[t.layer];
      for (std::uint8_t& l : layers_.run_layer) l = rank[l];
    }
    if (!std::is_sorted(layers_.tile_cracks.begin(), layers_.tile_cracks.end())) {
      std::vector<CrossingSums> sums;
      for (const std::size_t i : order_of(layers_.tile_cracks)) {
        sums.insert(sums.end(), crossing_.begin() + static_cast<std::ptrdiff_t>(i * T::nodes),
                    crossing_.begin() + static_cast<std::ptrdiff_t>((i + 1) * T::nodes));
      }
      crossing_ = std::move(sums);
      std::sort(layers_.tile_cracks.begin(), layers_.tile_cracks.end());
    }
  }

  /// Indices of a list in ascending order of its items.
  template <class Item>
  static std::vector<std::size_t> order_of(const std::vector<Item>& items) {
    std::vector<std::size_t> order(items.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return items[a] < items[b]; });
    return order;
  }

  const State<Dim>& state_;
  const StepWork<Dim>& work_;
  const Model<Dim>& model_;
  const CrackView<Dim>& view_;
  const Block<Dim>& block_;
  BlockLayers<Dim>& layers_;
  std::vector<CrossingSums>& crossing_;  ///< [crack of the tile][tile node]
  HeldNodes<Dim, Shape> held_;
  PairFolder<Dim, Shape> folder_;
  double dt_;                ///< s
  std::uint16_t field_ = 0;  ///< of the particles at hand
  bool rigid_ = false;
  bool sees_cracks_ = true;     ///< ... else it is one, whatever cracks part the material beside it
  std::uint8_t own_layer_ = 0;  ///< ... and the layer of their pairs that cross nothing
  bool fits_ = true;
};

template <int Dim>
void reset_layers(BlockLayers<Dim>& layers) {
  layers.tile.assign(1, Layer{});
  layers.tile_box.assign(1, {});
  layers.run_layer.clear();
  layers.tile_cracks.clear();
  layers.targets.clear();
  layers.targets_of_pack.clear();
  layers.offsets.clear();
}

}  // namespace

template <int Dim, class Shape>
void assign_velocity_fields(State<Dim>& state, StepWork<Dim>& work, const Model<Dim>& model) {
  const double dt = work.now.dt;
  if (!state.cracks.empty()) view_cracks(state, work, model, cells_beyond<Shape>);
  std::vector<std::vector<CrossingSums>> crossing(work.blocks.size());
  std::atomic<bool> fits{true};
  const bool may_fold = sees_beyond_faces<Shape> && !model.conditions.empty();
  if (!state.cracks.empty() || may_fold || model.contact.several_fields()) {
    parallel_for(work.blocks.size(), model.threads, [&](std::size_t b) {
      BlockLayers<Dim>& layers = work.nodes.layers[b];
      reset_layers(layers);
      BlockAssignment<Dim, Shape> assignment(state, work, model, b, layers, crossing[b], dt);
      assignment.begin();
      if (assignment.needed()) assignment.run();
      if (!assignment.finish()) fits = false;
    });
  }
  if (!fits) {
    throw RunError("more than " + std::to_string(Signature::capacity) +
                   " cracks lie between a particle and a node of its stencil, or a block of cells holds more than 255 velocity fields; "
                   "use smaller cells or fewer cracks at one place");
  }
  lay_out_nodes<Dim, Shape>(state, work, model, crossing);
}

#define CRAMPON_INSTANTIATE(DIM, SHAPE) template void assign_velocity_fields<DIM, SHAPE>(State<DIM>&, StepWork<DIM>&, const Model<DIM>&);
CRAMPON_FOR_ALL_SHAPES(CRAMPON_INSTANTIATE)
#undef CRAMPON_INSTANTIATE

}  // namespace crampon
