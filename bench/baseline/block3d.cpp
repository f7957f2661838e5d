/// The bare block in three dimensions.
///
/// Records {m, x, y, z} and {V, vx, vy, vz} of particles have their vectors in the lanes of the nodal {m, p}, {0, v}, {0, a} and {0, f}, so that
/// what passes between the two needs no shuffles; stress and strain are in packs, lanes over particles. Stencils are applied as separable sums,
/// along x, then y, then z; a scatter keeps one z-plane of the stencil in registers over the particles of a pack.

#include "bench/baseline/stepped_kernel.hpp"
#include "bench/baseline/transfer3d.hpp"

namespace crampon::bench {
namespace {

/// Width: nodes of a stencil along an axis.
template <int Width>
class Block3d final : public SteppedKernel {
  using Tiles = Blocks<3, Width>;
  using Transfer = Transfer3d<Width>;
  static constexpr int tile_nodes = Tiles::tile_nodes, block_nodes = Tiles::block_nodes;
  static constexpr int chunk = 4;  ///< packs that go through a loop's parts together

 public:
  Block3d(int cells, Scheme scheme, int threads) : Block3d(cells, scheme, threads, Tiles(cells)) {}

  std::size_t particles() const override { return std::size_t{8} * cells_ * cells_ * cells_; }

  double kinetic_energy() const override {
    double sum = 0;
    for (std::size_t p = 0; p < volume_velocity_.size(); ++p) {
      const Pack u = volume_velocity_[p];
      for (int d = 1; d < 4; ++d) sum += .5 * mass_position_[p][0] * u[d] * u[d];
    }
    return sum;
  }

  std::uint64_t hash() const override {
    Fingerprint print;
    for (std::size_t p = 0; p < volume_velocity_.size(); ++p) {
      for (int d = 1; d < 4; ++d) print.add(volume_velocity_[p][d]), print.add(mass_position_[p][d]);
    }
    return print.value();
  }

 private:
  Block3d(int cells, Scheme scheme, int threads, Tiles tiles)
      : SteppedKernel(scheme, tiles.count(), threads), cells_(cells), tiles_(std::move(tiles)) {
    const auto list = tiles_.place_particles(cells);
    const std::size_t packs = list.size() / lanes, blocks = tiles_.count();
    mass_position_ = zeros<Pack>(packs * lanes);
    volume_velocity_ = zeros<Pack>(packs * lanes);
    for (std::size_t p = 0; p < list.size(); ++p) {
      const auto& [bin, x, V] = list[p];
      mass_position_[p] = Pack{Elastic::density * V, x[0], x[1], x[2]};
      volume_velocity_[p] = Pack{V, initial_velocity(x[0], cells), initial_velocity(x[1], cells), initial_velocity(x[2], cells)};
    }
    stress_ = zeros<Pack>(packs * 6);
    strain_ = zeros<Pack>(packs * 7);
    tile_momentum_ = zeros<Pack>(tile_nodes * blocks);
    tile_force_ = zeros<Pack>(tile_nodes * blocks);
    inverse_mass_ = zeros<double>(block_nodes * blocks);
    for (auto* a : {&velocity_[0], &velocity_[1], &acceleration_, &new_velocity_}) *a = zeros<Pack>(block_nodes * blocks);
  }

  // ---- A pack ---------------------------------------------------------------------------------------------------------------------

  /// first(pack, transfer, i), then second(pack, transfer, i), over the packs of a block, some at a time: i counts them. In parts, because
  /// the chains of dependent operations of several packs then overlap.
  template <class First, class Second>
  void for_packs(int b, First first, Second second) const {
    const auto origin = tiles_.tile_origin(b);
    Transfer transfer[chunk];
    const std::size_t end = tiles_.first_pack(b + 1);
    for (std::size_t begin = tiles_.first_pack(b); begin < end; begin += chunk) {
      const int count = static_cast<int>(std::min<std::size_t>(chunk, end - begin));
      for (int i = 0; i < count; ++i) {
        Pack x[4];  // {m, x, y, z} of a particle; then each over particles
        for (int l = 0; l < lanes; ++l) x[l] = mass_position_[(begin + i) * lanes + l];
        transpose(x[0], x[1], x[2], x[3]);
        transfer[i].compute(x + 1, origin, inverse_cell);
      }
      for (int i = 0; i < count; ++i) first(begin + i, transfer[i], i);
      for (int i = 0; i < count; ++i) second(begin + i, transfer[i], i);
    }
  }
  template <class F>
  void for_packs(int b, F f) const {
    for_packs(b, f, [](std::size_t, const Transfer&, int) {});
  }

  void project_pack(std::size_t k, const Transfer& transfer, Pack* tile) const {
    Pack record[lanes];  // m {1, v}
    for (int l = 0; l < lanes; ++l) {
      const std::size_t p = k * lanes + l;
      record[l] = splat(mass_position_[p][0]) * __builtin_shufflevector(volume_velocity_[p], splat(1.), 4, 1, 2, 3);
    }
    if (transfer.base.same) {
      transfer.scatter(record, 0, lanes, tile);
    } else {
      for (int l = 0; l < lanes; ++l) transfer.scatter(record, l, l + 1, tile);
    }
  }

  /// Hooke's law on a strain increment (N03 Eq. 35). factor: s; for linear functions by 1/h. s: the new {xx, yy, zz, yz, xz, xy}.
  void update_stress(const Pack* velocity, const Transfer& transfer, std::size_t k, Pack factor, Pack* s) {
    Pack a[lanes], b[lanes], c[lanes];  // {0, v},x; {0, v},y; {0, v},z of each particle; then their components over particles
    for (int l = 0; l < lanes; ++l) {
      Pack g[3];
      transfer.gradient(velocity, l, g);
      a[l] = g[0], b[l] = g[1], c[l] = g[2];
    }
    transpose(a[0], a[1], a[2], a[3]);
    transpose(b[0], b[1], b[2], b[3]);
    transpose(c[0], c[1], c[2], c[3]);
    const Pack e[6] = {a[1] * factor, b[2] * factor, c[3] * factor, (b[3] + c[2]) * factor, (a[3] + c[1]) * factor, (a[2] + b[1]) * factor};
    const Pack pressure = splat(law.lambda) * (e[0] + (e[1] + e[2])), mu = splat(law.mu), mu2 = splat(2 * law.mu);
    Pack* stress = &stress_[k * 6];
    for (int i = 0; i < 3; ++i) s[i] = stress[i] + fused(mu2, e[i], pressure);
    for (int i = 3; i < 6; ++i) s[i] = fused(mu, e[i], stress[i]);
    for (int i = 0; i < 6; ++i) stress[i] = s[i];
    Pack* strain = &strain_[k * 7];
    Pack energy = strain[6];
    for (int i = 0; i < 6; ++i) strain[i] += e[i], energy = fused(s[i], e[i], energy);
    strain[6] = energy;
  }

  void project_force(std::size_t k, const Transfer& transfer, const Pack* s, Pack* tile) const {
    const Pack* u = &volume_velocity_[k * lanes];
    const Pack V = splat(Width == 2 ? -inverse_cell : -1.) * Pack{u[0][0], u[1][0], u[2][0], u[3][0]}, zero = splat(0.);
    Pack q[6];
    for (int i = 0; i < 6; ++i) q[i] = s[i] * V;
    Pack t[3][lanes] = {{zero, q[0], q[5], q[4]}, {zero, q[5], q[1], q[3]}, {zero, q[4], q[3], q[2]}};
    for (Pack(&row)[lanes] : t) transpose(row[0], row[1], row[2], row[3]);
    if (transfer.base.same) {
      transfer.scatter_force(t, 0, lanes, tile);
    } else {
      for (int l = 0; l < lanes; ++l) transfer.scatter_force(t, l, l + 1, tile);
    }
  }

  void update_velocities(std::size_t k, const Transfer& transfer, const Pack* acceleration) {
    for (int l = 0; l < lanes; ++l) {
      Pack& u = volume_velocity_[k * lanes + l];
      u = fused(splat(dt), transfer.interpolate(l, acceleration), u);
    }
  }

  /// low, high: extreme positions so far.
  void update_positions(std::size_t k, const Transfer& transfer, const Pack* velocity, Pack& low, Pack& high) {
    for (int l = 0; l < lanes; ++l) {
      const Pack x = fused(splat(dt), transfer.interpolate(l, velocity), mass_position_[k * lanes + l]);
      mass_position_[k * lanes + l] = x;
      low = lane_min(low, x), high = lane_max(high, x);
    }
  }

  // ---- Lines of the step ----------------------------------------------------------------------------------------------------------

  void project_momentum(int b) override {
    if (!tiles_.has_particles(b)) return;
    Pack* tile = tiles_.cleared_tile(tile_momentum_, b);
    for_packs(b, [&](std::size_t k, const Transfer& transfer, int) { project_pack(k, transfer, tile); });
  }

  void compute_velocities(int b, At at) override {
    Pack sum[block_nodes];
    tiles_.assemble(tile_momentum_, b, sum);
    const std::size_t first = std::size_t{block_nodes} * b;
    for (int i = 0; i < block_nodes; ++i) {
      const double m_i = sum[i][0], r = m_i > least_mass ? 1 / m_i : 0.;
      inverse_mass_[first + i] = r;
      velocity_[static_cast<int>(at)][first + i] = __builtin_shufflevector(sum[i], splat(0.), 4, 1, 2, 3) * splat(r);
    }
  }

  void update_stress_and_project_forces(int b, double stress_dt) override {
    if (!tiles_.has_particles(b)) return;
    static thread_local Pack velocity[tile_nodes];
    tiles_.gather(velocity_[0], b, velocity);
    Pack* tile = tiles_.cleared_tile(tile_force_, b);
    const Pack factor = stress_factor(stress_dt);
    Pack s[chunk][6];
    for_packs(
        b, [&](std::size_t k, const Transfer& transfer, int i) { update_stress(velocity, transfer, k, factor, s[i]); },
        [&](std::size_t k, const Transfer& transfer, int i) { project_force(k, transfer, s[i], tile); });
  }

  void update_momenta(int b) override {
    Pack f_i[block_nodes];
    tiles_.assemble(tile_force_, b, f_i);
    const std::size_t first = std::size_t{block_nodes} * b;
    for (int i = 0; i < block_nodes; ++i) {
      const Pack a_i = f_i[i] * splat(inverse_mass_[first + i]);
      acceleration_[first + i] = a_i;
      new_velocity_[first + i] = fused(splat(dt), a_i, velocity_[0][first + i]);
    }
  }

  void update_particles(int b) override {
    if (!tiles_.has_particles(b)) return;
    static thread_local Pack velocity[tile_nodes], acceleration[tile_nodes];
    tiles_.gather(new_velocity_, b, velocity);
    tiles_.gather(acceleration_, b, acceleration);
    Pack low = splat(1e300), high = -low;
    for_packs(b, [&](std::size_t k, const Transfer& transfer, int) {
      update_velocities(k, transfer, acceleration);
      update_positions(k, transfer, velocity, low, high);
    });
    find_box(b, low, high);
  }

  void update_velocities_and_project(int b) override {
    if (!tiles_.has_particles(b)) return;
    static thread_local Pack acceleration[tile_nodes];
    tiles_.gather(acceleration_, b, acceleration);
    Pack* tile = tiles_.cleared_tile(tile_momentum_, b);
    for_packs(
        b, [&](std::size_t k, const Transfer& transfer, int) { update_velocities(k, transfer, acceleration); },
        [&](std::size_t k, const Transfer& transfer, int) { project_pack(k, transfer, tile); });
  }

  void update_stress_and_positions(int b, double stress_dt) override {
    if (!tiles_.has_particles(b)) return;
    static thread_local Pack end_velocity[tile_nodes], velocity[tile_nodes];
    tiles_.gather(velocity_[1], b, end_velocity);
    tiles_.gather(new_velocity_, b, velocity);
    const Pack factor = stress_factor(stress_dt);
    Pack low = splat(1e300), high = -low;
    for_packs(b, [&](std::size_t k, const Transfer& transfer, int) {
      Pack s[6];
      update_stress(end_velocity, transfer, k, factor, s);
      update_positions(k, transfer, velocity, low, high);
    });
    find_box(b, low, high);
  }

  void find_box(int b, Pack low, Pack high) {
    if (!tiles_.find_box(b, low, high, inverse_cell)) drifted_ = true;
  }

  Pack stress_factor(double stress_dt) const { return splat(Width == 2 ? stress_dt * inverse_cell : stress_dt); }

  int cells_;
  Tiles tiles_;
  AlignedArray<Pack> mass_position_;    ///< [particle]: {m, x, y, z}, kg, m
  AlignedArray<Pack> volume_velocity_;  ///< [particle]: {V, vx, vy, vz}, m3, m/s
  AlignedArray<Pack> stress_;           ///< [pack]{xx, yy, zz, yz, xz, xy}: Pa
  AlignedArray<Pack> strain_;           ///< [pack]{xx, yy, zz, 2 yz, 2 xz, 2 xy, energy in J/m3}

  AlignedArray<Pack> tile_momentum_;   ///< [block][tile node]: {m, p}, kg, kg m/s
  AlignedArray<Pack> tile_force_;      ///< [block][tile node]: {0, f}, N
  AlignedArray<double> inverse_mass_;  ///< [block][node]: 1/kg
  AlignedArray<Pack> velocity_[2];     ///< [At][block][node]: {0, v}, m/s
  AlignedArray<Pack> acceleration_;    ///< {0, a}, m/s2
  AlignedArray<Pack> new_velocity_;    ///< {0, v'}, m/s
};

}  // namespace

std::unique_ptr<Kernel> make_block3d(int cells, Scheme scheme, Stencil stencil, int threads) {
  if (stencil == Stencil::linear) return std::make_unique<Block3d<2>>(cells, scheme, threads);
  return std::make_unique<Block3d<3>>(cells, scheme, threads);
}

}  // namespace crampon::bench
