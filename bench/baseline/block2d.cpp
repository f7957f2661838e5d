/// The bare block in plane strain.
///
/// What nodes exchange is a record, moved as one vector: {x, y, vx, vy} of particles, {m, px, py, V} and {v', a} of nodes. Stress, strain, mass
/// and volume are in packs, lanes over particles.

#include "bench/baseline/stepped_kernel.hpp"
#include "bench/baseline/transfer2d.hpp"

namespace crampon::bench {
namespace {

/// Width: nodes of a stencil along an axis.
template <int Width>
class Block2d final : public SteppedKernel {
  using Tiles = Blocks<2, Width>;
  using Transfer = Transfer2d<Width>;
  static constexpr int tile_nodes = Tiles::tile_nodes, block_nodes = Tiles::block_nodes;
  static constexpr int chunk = 8;  ///< packs whose weights are computed together

 public:
  Block2d(int cells, Scheme scheme, int threads) : Block2d(cells, scheme, threads, Tiles(cells)) {}

  std::size_t particles() const override { return std::size_t{4} * cells_ * cells_; }

  double kinetic_energy() const override {
    double sum = 0;
    for (std::size_t p = 0; p < motion_.size(); ++p) {
      const Pack q = motion_[p];
      sum += .5 * mass_volume_[p / lanes * 2][p % lanes] * (q[2] * q[2] + q[3] * q[3]);
    }
    return sum;
  }

  std::uint64_t hash() const override {
    Fingerprint print;
    for (const Pack& q : motion_) {
      for (int c = 0; c < 4; ++c) print.add(q[c]);
    }
    return print.value();
  }

 private:
  Block2d(int cells, Scheme scheme, int threads, Tiles tiles)
      : SteppedKernel(scheme, tiles.count(), threads), cells_(cells), tiles_(std::move(tiles)) {
    const auto list = tiles_.place_particles(cells);
    const std::size_t packs = list.size() / lanes, blocks = tiles_.count();
    motion_ = zeros<Pack>(packs * lanes);
    mass_volume_ = zeros<Pack>(packs * 2);
    for (std::size_t p = 0; p < list.size(); ++p) {
      const auto& [bin, x, V] = list[p];
      motion_[p] = Pack{x[0], x[1], initial_velocity(x[0], cells), initial_velocity(x[1], cells)};
      mass_volume_[p / lanes * 2][p % lanes] = Elastic::density * V;
      mass_volume_[p / lanes * 2 + 1][p % lanes] = V;
    }
    stress_ = zeros<Pack>(packs * 4);
    strain_ = zeros<Pack>(packs * 4);
    tile_momentum_ = zeros<Pack>(tile_nodes * blocks);
    tile_force_ = zeros<Pair>(tile_nodes * blocks);
    inverse_mass_ = zeros<double>(block_nodes * blocks);
    velocity_[0] = zeros<Pair>(block_nodes * blocks);
    velocity_[1] = zeros<Pair>(block_nodes * blocks);
    node_motion_ = zeros<Pack>(block_nodes * blocks);
  }

  // ---- A pack ---------------------------------------------------------------------------------------------------------------------

  void positions(std::size_t k, Pack& x, Pack& y) const {
    const Pack* p = &motion_[k * lanes];
    const Pack a = join(low_half(p[0]), low_half(p[2])), b = join(low_half(p[1]), low_half(p[3]));
    x = even_lanes(a, b), y = odd_lanes(a, b);
  }

  /// f(pack, transfer) over a block. The weights of several packs come first: their chains of dependent operations overlap.
  template <class F>
  void for_packs(int b, F f) const {
    const auto origin = tiles_.tile_origin(b);
    Transfer transfer[chunk];
    const std::size_t end = tiles_.first_pack(b + 1);
    for (std::size_t begin = tiles_.first_pack(b); begin < end; begin += chunk) {
      const std::size_t stop = std::min(end, begin + chunk);
      for (std::size_t k = begin; k < stop; ++k) {
        Pack x, y;
        positions(k, x, y);
        transfer[k - begin].compute(x, y, origin, inverse_cell);
      }
      for (std::size_t k = begin; k < stop; ++k) f(k, transfer[k - begin]);
    }
  }

  /// {m, m vx, m vy, V} of each particle.
  void momentum_records(std::size_t k, Pack* record) const {
    const Pack* p = &motion_[k * lanes];
    const Pack m_p = mass_volume_[2 * k], V_p = mass_volume_[2 * k + 1];
    const Pack a = join(high_half(p[0]), high_half(p[2])), b = join(high_half(p[1]), high_half(p[3]));
    record[0] = m_p, record[1] = m_p * even_lanes(a, b), record[2] = m_p * odd_lanes(a, b), record[3] = V_p;
    transpose(record[0], record[1], record[2], record[3]);
  }

  /// Hooke's law on a strain increment (N03 Eq. 35), L: velocity gradient. Returns the new {xx, yy, xy}.
  std::array<Pack, 3> update_stress(std::size_t k, const Pack* L, Pack stress_dt) {
    const Pack exx = L[0] * stress_dt, eyy = L[1] * stress_dt, exy = L[2] * stress_dt;
    const Pack pressure = splat(law.lambda) * (exx + eyy), mu2 = splat(2 * law.mu);
    Pack* s = &stress_[k * 4];
    const Pack xx = s[0] + fused(mu2, exx, pressure), yy = s[1] + fused(mu2, eyy, pressure), xy = fused(splat(law.mu), exy, s[2]);
    s[0] = xx, s[1] = yy, s[2] = xy, s[3] += pressure;
    Pack* e = &strain_[k * 4];
    e[0] += exx, e[1] += eyy, e[2] += exy;
    e[3] = fused(xx, exx, fused(yy, eyy, fused(xy, exy, e[3])));
    return {xx, yy, xy};
  }

  /// particle += factor {v', a}. low, high: extreme positions so far.
  void advance(std::size_t k, Pack factor, const Pack* motion, Pack& low, Pack& high) {
    for (int l = 0; l < lanes; ++l) {
      const Pack q = fused(factor, motion[l], motion_[k * lanes + l]);
      motion_[k * lanes + l] = q;
      low = lane_min(low, q), high = lane_max(high, q);
    }
  }

  // ---- Lines of the step ----------------------------------------------------------------------------------------------------------

  void project_momentum(int b) override {
    if (!tiles_.has_particles(b)) return;
    Pack* tile = tiles_.cleared_tile(tile_momentum_, b);
    for_packs(b, [&](std::size_t k, const Transfer& transfer) {
      Pack record[lanes];
      momentum_records(k, record);
      transfer.scatter(record, tile);
    });
  }

  void compute_velocities(int b, At at) override {
    Pack sum[block_nodes];
    tiles_.assemble(tile_momentum_, b, sum);
    Pair* v_i = &velocity_[static_cast<int>(at)][std::size_t{block_nodes} * b];
    double* inverse = &inverse_mass_[std::size_t{block_nodes} * b];
    for (int i = 0; i < block_nodes; ++i) {
      const double m_i = sum[i][0], r = m_i > least_mass ? 1 / m_i : 0.;
      inverse[i] = r;
      v_i[i] = Pair{sum[i][1] * r, sum[i][2] * r};
    }
  }

  void update_stress_and_project_forces(int b, double stress_dt) override {
    if (!tiles_.has_particles(b)) return;
    Pair velocity[tile_nodes];
    tiles_.gather(velocity_[0], b, velocity);
    Pair* tile = tiles_.cleared_tile(tile_force_, b);
    const Pack half = splat(stress_dt), scale = splat(Width == 2 ? -inverse_cell : -1.);
    for_packs(b, [&](std::size_t k, const Transfer& transfer) {
      Pack L[3];
      transfer.gradient(velocity, inverse_cell, L);
      const auto [xx, yy, xy] = update_stress(k, L, half);
      const Pack V = mass_volume_[2 * k + 1] * scale;
      transfer.scatter_force(xx * V, yy * V, xy * V, tile);
    });
  }

  void update_momenta(int b) override {
    Pair f_i[block_nodes];
    tiles_.assemble(tile_force_, b, f_i);
    const std::size_t first = std::size_t{block_nodes} * b;
    for (int i = 0; i < block_nodes; ++i) {
      const Pair a_i = f_i[i] * inverse_mass_[first + i];
      node_motion_[first + i] = join(velocity_[0][first + i] + a_i * dt, a_i);
    }
  }

  void update_particles(int b) override {
    if (!tiles_.has_particles(b)) return;
    Pack nodes[tile_nodes];
    tiles_.gather(node_motion_, b, nodes);
    const Pack factor = splat(dt);
    Pack low = splat(1e300), high = -low;
    for_packs(b, [&](std::size_t k, const Transfer& transfer) {
      Pack motion[lanes];
      transfer.interpolate(nodes, motion);
      advance(k, factor, motion, low, high);
    });
    find_box(b, low, high);
  }

  void update_velocities_and_project(int b) override {
    if (!tiles_.has_particles(b)) return;
    Pack nodes[tile_nodes];
    tiles_.gather(node_motion_, b, nodes);
    Pack* tile = tiles_.cleared_tile(tile_momentum_, b);
    const Pack factor{0., 0., dt, dt};
    for_packs(b, [&](std::size_t k, const Transfer& transfer) {
      Pack motion[lanes], record[lanes];
      transfer.interpolate(nodes, motion);
      for (int l = 0; l < lanes; ++l) motion_[k * lanes + l] = fused(factor, motion[l], motion_[k * lanes + l]);
      momentum_records(k, record);
      transfer.scatter(record, tile);
    });
  }

  void update_stress_and_positions(int b, double stress_dt) override {
    if (!tiles_.has_particles(b)) return;
    Pair velocity[tile_nodes];
    Pack nodes[tile_nodes];
    tiles_.gather(velocity_[1], b, velocity);
    tiles_.gather(node_motion_, b, nodes);
    const Pack half = splat(stress_dt), factor{dt, dt, 0., 0.};
    Pack low = splat(1e300), high = -low;
    for_packs(b, [&](std::size_t k, const Transfer& transfer) {
      Pack L[3], motion[lanes];
      transfer.gradient(velocity, inverse_cell, L);
      update_stress(k, L, half);
      transfer.interpolate(nodes, motion);
      advance(k, factor, motion, low, high);
    });
    find_box(b, low, high);
  }

  void find_box(int b, Pack low, Pack high) {
    if (!tiles_.find_box(b, low, high, inverse_cell)) drifted_ = true;
  }

  int cells_;
  Tiles tiles_;
  AlignedArray<Pack> motion_;       ///< [particle]: {x, y, vx, vy}, m, m/s
  AlignedArray<Pack> mass_volume_;  ///< [pack]{m, V}: kg, m3
  AlignedArray<Pack> stress_;       ///< [pack]{xx, yy, xy, zz}: Pa
  AlignedArray<Pack> strain_;       ///< [pack]{xx, yy, 2 xy, energy in J/m3}

  AlignedArray<Pack> tile_momentum_;   ///< [block][tile node]: {m, px, py, V}
  AlignedArray<Pair> tile_force_;      ///< [block][tile node]: N
  AlignedArray<double> inverse_mass_;  ///< [block][node]: 1/kg
  AlignedArray<Pair> velocity_[2];     ///< [At][block][node]: m/s
  AlignedArray<Pack> node_motion_;     ///< [block][node]: {v', a}, m/s, m/s2
};

}  // namespace

std::unique_ptr<Kernel> make_block2d(int cells, Scheme scheme, Stencil stencil, int threads) {
  if (stencil == Stencil::linear) return std::make_unique<Block2d<2>>(cells, scheme, threads);
  return std::make_unique<Block2d<3>>(cells, scheme, threads);
}

}  // namespace crampon::bench
