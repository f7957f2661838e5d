/// The bare block in plane strain.
///
/// Particles are ordered by block and base node, in packs of four; a block's packs are filled up with particles without mass. What nodes
/// exchange is a record, moved as one vector: {x, y, vx, vy} of particles, {m, px, py, V} and {v', a} of nodes. Stress, strain, mass and
/// volume are in packs, lanes over particles. A block's particles work on a private tile of nodes, of which only the box that they touch is
/// cleared, gathered and assembled; the update of positions finds the box for the next step, and with it who has drifted too far.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <vector>

#include "baseline/kernel.hpp"
#include "crampon/core/aligned_array.hpp"
#include "crampon/core/parallel.hpp"

namespace crampon::bench {
namespace {

using namespace baseline;

/// Tile nodes [x0, x1) x [y0, y1).
struct Box {
  int x0, x1, y0, y1;
};

inline Pair low_half(Pack a) { return __builtin_shufflevector(a, a, 0, 1); }
inline Pair high_half(Pack a) { return __builtin_shufflevector(a, a, 2, 3); }
inline Pack join(Pair a, Pair b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3); }
inline Pack even_lanes(Pack a, Pack b) { return __builtin_shufflevector(a, b, 0, 4, 2, 6); }
inline Pack odd_lanes(Pack a, Pack b) { return __builtin_shufflevector(a, b, 1, 5, 3, 7); }

/// Vectors of neighbouring nodes in one load; nodes are aligned to 16 bytes only.
inline Pack load_two(const Pair* node) {
  Pack both;
  std::memcpy(&both, node, sizeof both);
  return both;
}

/// {sum a, sum b} and {sum a, sum b, sum c, sum d} over lanes, always in the same order.
inline Pair lane_sums(Pack a, Pack b) {
  const Pack h = even_lanes(a, b) + odd_lanes(a, b);
  return low_half(h) + high_half(h);
}
inline Pack lane_sums(Pack a, Pack b, Pack c, Pack d) {
  const Pack h = even_lanes(a, b) + odd_lanes(a, b), g = even_lanes(c, d) + odd_lanes(c, d);
  return __builtin_shufflevector(h, g, 0, 1, 4, 5) + __builtin_shufflevector(h, g, 2, 3, 6, 7);
}

/// Width: nodes of a stencil along an axis.
template <int Width>
class Block2d final : public Kernel {
 public:
  Block2d(int cells, Scheme scheme, int threads) : scheme_(scheme), threads_(threads), along_(blocks_along(cells)) { place_particles(cells); }

  void step() override {
    if (drifted_) start_over();
    const double dt = law_.dt, stress_dt = scheme_ == Scheme::usavg ? dt / 2 : dt;  // N03 Eq. 35: half at a time for USAVG
    for_blocks([&](int b) { project_momentum(b); });
    for_blocks([&](int b) { compute_velocities(b, velocity_); });
    for_blocks([&](int b) { update_stress_and_project_forces(b, stress_dt); });
    for_blocks([&](int b) { update_momenta(b, dt); });
    if (scheme_ == Scheme::usf) {
      for_blocks([&](int b) { update_particles(b, dt); });
    } else {
      for_blocks([&](int b) { update_velocities_and_project(b, dt); });
      for_blocks([&](int b) { compute_velocities(b, end_velocity_); });
      for_blocks([&](int b) { update_stress_and_positions(b, stress_dt, dt); });
    }
  }

  std::size_t particles() const override { return particles_; }

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
  static constexpr int below = Width == 3 ? 1 : 0;                ///< stencil nodes below the bin's own
  static constexpr int offset = margin + below;                   ///< tile index of the block's first node, per axis
  static constexpr int tile_side = side + Width - 1 + 2 * margin;  ///< nodes
  static constexpr int tile_nodes = tile_side * tile_side, block_nodes = side * side;
  static constexpr double bin_shift = Width == 3 ? .5 : 0.;  ///< bins are cells, or cells around nodes
  static constexpr double half_size = .25;                   ///< of a particle, in cells
  static constexpr int chunk = 8;                            ///< packs whose weights are computed together

  /// Shape functions of a pack, one factor per axis.
  struct Weights {
    Pack x[Width], y[Width], dx[Width], dy[Width];
    Base base;
  };

  // ---- Particles ------------------------------------------------------------------------------------------------------------------

  void place_particles(int cells) {
    struct Start {
      int bin;
      double x, y;
    };
    std::vector<Start> starts;
    starts.reserve(std::size_t{4} * cells * cells);
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        for (int q = 0; q < 4; ++q) {
          const double x = side + i + .25 + .5 * (q & 1), y = side + j + .25 + .5 * (q >> 1);
          const int bx = static_cast<int>(x + bin_shift), by = static_cast<int>(y + bin_shift);
          const int block = by / side * along_ + bx / side;
          starts.push_back({block * block_nodes + by % side * side + bx % side, x, y});
        }
      }
    }
    std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.bin < b.bin; });
    particles_ = starts.size();

    const int blocks = along_ * along_;
    first_pack_.assign(blocks + 1, 0);
    for (const Start& s : starts) ++first_pack_[s.bin / block_nodes + 1];
    for (int b = 0; b < blocks; ++b) first_pack_[b + 1] = first_pack_[b] + (first_pack_[b + 1] + lanes - 1) / lanes;
    const std::size_t packs = first_pack_[blocks];
    start_.resize_discarding(packs * lanes);
    motion_.resize_discarding(packs * lanes);
    mass_volume_.resize_discarding(packs * 2);
    auto next = starts.begin();
    for (int b = 0; b < blocks; ++b) {
      for (std::size_t p = first_pack_[b] * lanes; p < first_pack_[b + 1] * lanes; ++p) {
        const bool real = next != starts.end() && next->bin / block_nodes == b;
        const Start s = real ? *next++ : *(next - 1);  // padding sits on the last particle
        const double V_p = real ? cell * cell / 4 : 0.;
        start_[p] = Pack{s.x, s.y, .1 * std::sin(s.x * .01), .1 * std::cos(s.y * .013)};
        mass_volume_[p / lanes * 2][p % lanes] = Elastic::density * V_p;
        mass_volume_[p / lanes * 2 + 1][p % lanes] = V_p;
      }
    }

    stress_.resize_discarding(packs * 4);
    strain_.resize_discarding(packs * 4);
    tile_momentum_.resize_discarding(std::size_t{tile_nodes} * blocks);
    tile_force_.resize_discarding(std::size_t{tile_nodes} * blocks);
    inverse_mass_.resize_discarding(std::size_t{block_nodes} * blocks);
    velocity_.resize_discarding(std::size_t{block_nodes} * blocks);
    end_velocity_.resize_discarding(std::size_t{block_nodes} * blocks);
    node_motion_.resize_discarding(std::size_t{block_nodes} * blocks);
    box_.resize(blocks);
    start_over();
  }

  void start_over() {
    std::copy(start_.begin(), start_.end(), motion_.begin());
    std::fill(stress_.begin(), stress_.end(), splat(0.));
    std::fill(strain_.begin(), strain_.end(), splat(0.));
    for (int b = 0; b < along_ * along_; ++b) {
      if (!has_particles(b)) continue;
      Pack low = splat(1e300), high = splat(-1e300);
      for (std::size_t p = first_pack_[b] * lanes; p < first_pack_[b + 1] * lanes; ++p) {
        low = lane_min(low, motion_[p]), high = lane_max(high, motion_[p]);
      }
      find_box(b, low, high);
    }
    drifted_ = false;
  }

  bool has_particles(int b) const { return first_pack_[b + 1] > first_pack_[b]; }

  /// In cells: the lower end of tile index 0 among bins.
  double tile_origin(int block) const { return block * side - margin - bin_shift; }

  /// The box of tile nodes in reach. low, high: extreme positions {x, y, ., .} of a block's particles, m.
  void find_box(int b, Pack low, Pack high) {
    const double x0 = tile_origin(b % along_), y0 = tile_origin(b / along_);
    const auto bin = [&](double x, double origin) { return static_cast<int>(std::floor(x * inverse_cell_ - origin)); };
    Box q{bin(low[0], x0), bin(high[0], x0) + Width, bin(low[1], y0), bin(high[1], y0) + Width};
    if (q.x0 < 0 || q.y0 < 0 || q.x1 > tile_side || q.y1 > tile_side) {
      drifted_ = true;
      q = {std::max(q.x0, 0), std::min(q.x1, tile_side), std::max(q.y0, 0), std::min(q.y1, tile_side)};
    }
    box_[b] = q;
  }

  // ---- Tiles and nodes ------------------------------------------------------------------------------------------------------------

  template <class F>
  void for_blocks(F f) {
    parallel_for(box_.size(), threads_, [&](std::size_t b) { f(static_cast<int>(b)); });
  }

  /// f(neighbour, x step, y step) over the blocks around b and itself, always in the same order.
  template <class F>
  void for_neighbours(int b, F f) const {
    const int bx = b % along_, by = b / along_;
    for (int sy = -1; sy <= 1; ++sy) {
      for (int sx = -1; sx <= 1; ++sx) {
        const int x = bx + sx, y = by + sy;
        if (x >= 0 && y >= 0 && x < along_ && y < along_) f(y * along_ + x, sx, sy);
      }
    }
  }

  template <class Record>
  Record* cleared_tile(AlignedArray<Record>& tiles, int b) const {
    Record* tile = &tiles[std::size_t{tile_nodes} * b];
    const Box q = box_[b];
    for (int j = q.y0; j < q.y1; ++j) {
      std::memset(static_cast<void*>(tile + j * tile_side + q.x0), 0, static_cast<std::size_t>(q.x1 - q.x0) * sizeof(Record));
    }
    return tile;
  }

  /// Sum of all tiles over the own nodes of a block.
  template <class Record>
  void assemble(const AlignedArray<Record>& tiles, int b, Record* sum) const {
    for (int i = 0; i < block_nodes; ++i) sum[i] = Record{};
    for_neighbours(b, [&](int c, int sx, int sy) {
      if (!has_particles(c)) return;
      const Box q = box_[c];
      const int dx = sx * side - offset, dy = sy * side - offset;  // own node = tile node + d
      const int x0 = std::max(0, q.x0 + dx), x1 = std::min(side, q.x1 + dx), y0 = std::max(0, q.y0 + dy), y1 = std::min(side, q.y1 + dy);
      const Record* tile = &tiles[std::size_t{tile_nodes} * c];
      for (int j = y0; j < y1; ++j) {
        const Record* from = tile + (j - dy) * tile_side - dx;
        for (int i = x0; i < x1; ++i) sum[j * side + i] += from[i];
      }
    });
  }

  /// Copies the nodes of a block's box into a tile.
  template <class Record>
  void gather(const AlignedArray<Record>& nodes, int b, Record* tile) const {
    const Box q = box_[b];
    for_neighbours(b, [&](int c, int sx, int sy) {
      const int dx = sx * side + offset, dy = sy * side + offset;  // tile node = neighbour's node + d
      const int x0 = std::max(0, q.x0 - dx), x1 = std::min(side, q.x1 - dx), y0 = std::max(0, q.y0 - dy), y1 = std::min(side, q.y1 - dy);
      const Record* block = &nodes[std::size_t{block_nodes} * c];
      for (int j = y0; j < y1; ++j) {
        Record* to = tile + (j + dy) * tile_side + dx;
        for (int i = x0; i < x1; ++i) to[i] = block[j * side + i];
      }
    });
  }

  // ---- A pack ---------------------------------------------------------------------------------------------------------------------

  void positions(std::size_t k, Pack& x, Pack& y) const {
    const Pack* p = &motion_[k * lanes];
    const Pack a = join(low_half(p[0]), low_half(p[2])), b = join(low_half(p[1]), low_half(p[3]));
    x = even_lanes(a, b), y = odd_lanes(a, b);
  }

  void compute_weights(Pack x, Pack y, Pack x0, Pack y0, Weights& w) const {
    const Pack h = splat(inverse_cell_), gx = fused(x, h, -x0), gy = fused(y, h, -y0), bx = lane_floor(gx), by = lane_floor(gy);
    w.base.set(fused(by, splat(tile_side), bx));
    axis_weights<Width>(gx - bx, half_size, inverse_cell_, w.x, w.dx);
    axis_weights<Width>(gy - by, half_size, inverse_cell_, w.y, w.dy);
  }

  /// f(pack, weights) over a block. The weights of several packs come first: their chains of dependent operations overlap.
  template <class F>
  void for_packs(int b, F f) const {
    const Pack x0 = splat(tile_origin(b % along_)), y0 = splat(tile_origin(b / along_));
    Weights w[chunk];
    const std::size_t end = first_pack_[b + 1];
    for (std::size_t begin = first_pack_[b]; begin < end; begin += chunk) {
      const std::size_t stop = std::min(end, begin + chunk);
      for (std::size_t k = begin; k < stop; ++k) {
        Pack x, y;
        positions(k, x, y);
        compute_weights(x, y, x0, y0, w[k - begin]);
      }
      for (std::size_t k = begin; k < stop; ++k) f(k, w[k - begin]);
    }
  }

  /// S_ip of all nodes, lanes over particles.
  static void multiply_weights(const Weights& w, Pack* S) {
    for (int n = 0; n < Width * Width; ++n) S[n] = w.x[n % Width] * w.y[n / Width];
  }
  static constexpr int tile_step(int n) { return n / Width * tile_side + n % Width; }

  /// {m, m vx, m vy, V} of each particle.
  void momentum_records(std::size_t k, Pack* record) const {
    const Pack* p = &motion_[k * lanes];
    const Pack m_p = mass_volume_[2 * k], V_p = mass_volume_[2 * k + 1];
    const Pack a = join(high_half(p[0]), high_half(p[2])), b = join(high_half(p[1]), high_half(p[3]));
    record[0] = m_p, record[1] = m_p * even_lanes(a, b), record[2] = m_p * odd_lanes(a, b), record[3] = V_p;
    transpose(record[0], record[1], record[2], record[3]);
  }

  /// Adds S_ip {m, m v, V} to every node (N03 Eqs. 26, 27); one sum per node when the pack shares its nodes.
  static void scatter(const Weights& w, const Pack* record, Pack* tile) {
    Pack S[Width * Width];
    multiply_weights(w, S);
    if (w.base.same) {
      for (int n = 0; n < Width * Width; ++n) {
        Pack& q = tile[w.base.of[0] + tile_step(n)];
        Pack sum = q;
        for (int l = 0; l < lanes; ++l) sum = fused(broadcast(S[n], l), record[l], sum);
        q = sum;
      }
    } else {
      for (int l = 0; l < lanes; ++l) {
        for (int n = 0; n < Width * Width; ++n) {
          Pack& q = tile[w.base.of[l] + tile_step(n)];
          q = fused(broadcast(S[n], l), record[l], q);
        }
      }
    }
  }

  /// Velocity gradient {vx,x; vy,y; vx,y + vy,x}, 1/s (N03 Eq. 36).
  void gradient(const Pair* velocity, const Weights& w, Pack* L) const {
    if constexpr (Width == 2) {
      Pack v[2][4];  // [row]{vx, vy of its first node, vx, vy of its second}, lanes over particles
      for (int j = 0; j < 2; ++j) {
        for (int l = 0; l < lanes; ++l) v[j][l] = load_two(velocity + w.base.of[l] + j * tile_side);
        transpose(v[j][0], v[j][1], v[j][2], v[j][3]);
      }
      const Pack h = splat(inverse_cell_);
      const auto between = [](const Pack* S, Pack a, Pack b) { return fused(S[1], b, S[0] * a); };
      const Pack vx_y = between(w.x, v[1][0] - v[0][0], v[1][2] - v[0][2]), vy_x = between(w.y, v[0][3] - v[0][1], v[1][3] - v[1][1]);
      L[0] = h * between(w.y, v[0][2] - v[0][0], v[1][2] - v[1][0]);
      L[1] = h * between(w.x, v[1][1] - v[0][1], v[1][3] - v[0][3]);
      L[2] = h * (vy_x + vx_y);
    } else {
      L[0] = L[1] = L[2] = splat(0.);
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        const Pair* row = velocity + j * tile_side;
        Pack v[4];
        for (int l = 0; l < lanes; ++l) v[l] = load_two(row + w.base.of[l]);
        transpose(v[0], v[1], v[2], v[3]);
        const Pack a = join(row[w.base.of[0] + 2], row[w.base.of[2] + 2]), b = join(row[w.base.of[1] + 2], row[w.base.of[3] + 2]);
        const Pack vx[3] = {v[0], v[2], even_lanes(a, b)}, vy[3] = {v[1], v[3], odd_lanes(a, b)};
        const auto sum = [](const Pack* S, const Pack* q) { return fused(S[0], q[0], fused(S[1], q[1], S[2] * q[2])); };
        L[0] = fused(w.y[j], sum(w.dx, vx), L[0]);
        L[1] = fused(w.dy[j], sum(w.x, vy), L[1]);
        L[2] = fused(w.y[j], sum(w.dx, vy), fused(w.dy[j], sum(w.x, vx), L[2]));
      }
    }
  }

  /// Hooke's law on a strain increment (N03 Eq. 35), L: velocity gradient. Returns the new {xx, yy, xy}.
  std::array<Pack, 3> update_stress(std::size_t k, const Pack* L, Pack dt) {
    const Pack exx = L[0] * dt, eyy = L[1] * dt, exy = L[2] * dt;
    const Pack pressure = splat(law_.lambda) * (exx + eyy), mu2 = splat(2 * law_.mu);
    Pack* s = &stress_[k * 4];
    const Pack xx = s[0] + fused(mu2, exx, pressure), yy = s[1] + fused(mu2, eyy, pressure), xy = fused(splat(law_.mu), exy, s[2]);
    s[0] = xx, s[1] = yy, s[2] = xy, s[3] += pressure;
    Pack* e = &strain_[k * 4];
    e[0] += exx, e[1] += eyy, e[2] += exy;
    e[3] = fused(xx, exx, fused(yy, eyy, fused(xy, exy, e[3])));
    return {xx, yy, xy};
  }

  /// Adds -V sigma . G_ip to every node (N03 Eq. 28). xx, yy, xy: -V sigma, N m; by h for linear functions, whose G is then -1, 1.
  static void scatter_force(const Weights& w, Pack xx, Pack yy, Pack xy, Pair* tile) {
#pragma GCC unroll 3
    for (int j = 0; j < Width; ++j) {
      Pair* row = tile + j * tile_side;
      Pack f[2 * Width];  // {fx, fy} of each node of the row, lanes over particles
      if constexpr (Width == 2) {
        const Pack a = xx * w.y[j], b = xy * w.y[j], c = j == 0 ? -xy : xy, d = j == 0 ? -yy : yy;
        f[0] = fused(c, w.x[0], -a), f[1] = fused(d, w.x[0], -b), f[2] = fused(c, w.x[1], a), f[3] = fused(d, w.x[1], b);
      } else {
        const Pack a = xx * w.y[j], b = xy * w.dy[j], c = xy * w.y[j], d = yy * w.dy[j];
        for (int i = 0; i < 3; ++i) f[2 * i] = fused(w.dx[i], a, w.x[i] * b), f[2 * i + 1] = fused(w.dx[i], c, w.x[i] * d);
      }
      // In halves: the next pack's loads of single nodes can take them from the store under way.
      if (w.base.same) {
        Pair* q = row + w.base.of[0];
        const Pack sum = lane_sums(f[0], f[1], f[2], f[3]);
        q[0] += low_half(sum), q[1] += high_half(sum);
        if constexpr (Width == 3) q[2] += lane_sums(f[4], f[5]);
      } else {
        transpose(f[0], f[1], f[2], f[3]);
        for (int l = 0; l < lanes; ++l) {
          Pair* q = row + w.base.of[l];
          q[0] += low_half(f[l]), q[1] += high_half(f[l]);
        }
        if constexpr (Width == 3) {
          const Pack e = even_lanes(f[4], f[5]), o = odd_lanes(f[4], f[5]);
          row[w.base.of[0] + 2] += low_half(e), row[w.base.of[1] + 2] += low_half(o);
          row[w.base.of[2] + 2] += high_half(e), row[w.base.of[3] + 2] += high_half(o);
        }
      }
    }
  }

  /// {v', a} at each particle of a pack: sum of S_ip {v'_i, a_i}.
  static void interpolate(const Weights& w, const Pack* nodes, Pack* motion) {
    Pack S[Width * Width];
    multiply_weights(w, S);
    for (int l = 0; l < lanes; ++l) {
      const Pack* q = nodes + w.base.of[l];
      Pack sum[2] = {splat(0.), splat(0.)};  // two chains
#pragma GCC unroll 9
      for (int n = 0; n < Width * Width; ++n) sum[n & 1] = fused(broadcast(S[n], l), q[tile_step(n)], sum[n & 1]);
      motion[l] = sum[0] + sum[1];
    }
  }

  // ---- Lines of the step ----------------------------------------------------------------------------------------------------------

  void project_momentum(int b) {
    if (!has_particles(b)) return;
    Pack* tile = cleared_tile(tile_momentum_, b);
    for_packs(b, [&](std::size_t k, const Weights& w) {
      Pack record[lanes];
      momentum_records(k, record);
      scatter(w, record, tile);
    });
  }

  void compute_velocities(int b, AlignedArray<Pair>& velocity) {
    Pack sum[block_nodes];
    assemble(tile_momentum_, b, sum);
    Pair* v_i = &velocity[std::size_t{block_nodes} * b];
    double* inverse = &inverse_mass_[std::size_t{block_nodes} * b];
    for (int i = 0; i < block_nodes; ++i) {
      const double m_i = sum[i][0], r = m_i > least_mass ? 1 / m_i : 0.;
      inverse[i] = r;
      v_i[i] = Pair{sum[i][1] * r, sum[i][2] * r};
    }
  }

  void update_stress_and_project_forces(int b, double stress_dt) {
    if (!has_particles(b)) return;
    Pair velocity[tile_nodes];
    gather(velocity_, b, velocity);
    Pair* tile = cleared_tile(tile_force_, b);
    const Pack dt = splat(stress_dt), scale = splat(Width == 2 ? -inverse_cell_ : -1.);
    for_packs(b, [&](std::size_t k, const Weights& w) {
      Pack L[3];
      gradient(velocity, w, L);
      const auto [xx, yy, xy] = update_stress(k, L, dt);
      const Pack V = mass_volume_[2 * k + 1] * scale;
      scatter_force(w, xx * V, yy * V, xy * V, tile);
    });
  }

  /// v' = v + a dt with a = f/m (N03 Eq. 29).
  void update_momenta(int b, double dt) {
    Pair f_i[block_nodes];
    assemble(tile_force_, b, f_i);
    const std::size_t first = std::size_t{block_nodes} * b;
    for (int i = 0; i < block_nodes; ++i) {
      const double r = inverse_mass_[first + i], ax = f_i[i][0] * r, ay = f_i[i][1] * r;
      const Pair v_i = velocity_[first + i];
      node_motion_[first + i] = Pack{v_i[0] + dt * ax, v_i[1] + dt * ay, ax, ay};
    }
  }

  /// x += v' dt, v += a dt (N03 Eq. 30).
  void update_particles(int b, double dt) {
    if (!has_particles(b)) return;
    Pack nodes[tile_nodes];
    gather(node_motion_, b, nodes);
    const Pack factor = splat(dt);
    Pack low = splat(1e300), high = splat(-1e300);
    for_packs(b, [&](std::size_t k, const Weights& w) {
      Pack motion[lanes];
      interpolate(w, nodes, motion);
      advance(k, factor, motion, low, high);
    });
    find_box(b, low, high);
  }

  /// Velocities alone, and the momenta they give (N03 Eq. 31); positions stay those that all shape functions of a step belong to.
  void update_velocities_and_project(int b, double dt) {
    if (!has_particles(b)) return;
    Pack nodes[tile_nodes];
    gather(node_motion_, b, nodes);
    Pack* tile = cleared_tile(tile_momentum_, b);
    const Pack factor = Pack{0., 0., dt, dt};
    for_packs(b, [&](std::size_t k, const Weights& w) {
      Pack motion[lanes];
      interpolate(w, nodes, motion);
      Pack* p = &motion_[k * lanes];
      for (int l = 0; l < lanes; ++l) p[l] = fused(factor, motion[l], p[l]);
      Pack record[lanes];
      momentum_records(k, record);
      scatter(w, record, tile);
    });
  }

  void update_stress_and_positions(int b, double stress_dt, double dt) {
    if (!has_particles(b)) return;
    Pair velocity[tile_nodes];
    Pack nodes[tile_nodes];
    gather(end_velocity_, b, velocity);
    gather(node_motion_, b, nodes);
    const Pack half = splat(stress_dt), factor = Pack{dt, dt, 0., 0.};
    Pack low = splat(1e300), high = splat(-1e300);
    for_packs(b, [&](std::size_t k, const Weights& w) {
      Pack L[3], motion[lanes];
      gradient(velocity, w, L);
      update_stress(k, L, half);
      interpolate(w, nodes, motion);
      advance(k, factor, motion, low, high);
    });
    find_box(b, low, high);
  }

  void advance(std::size_t k, Pack factor, const Pack* motion, Pack& low, Pack& high) {
    Pack* p = &motion_[k * lanes];
    for (int l = 0; l < lanes; ++l) {
      const Pack q = fused(factor, motion[l], p[l]);
      p[l] = q;
      low = lane_min(low, q), high = lane_max(high, q);
    }
  }

  static constexpr double least_mass = 1e-12;  ///< kg: nodes with less stand still

  Scheme scheme_;
  int threads_;
  int along_;  ///< blocks along a side; those around the material are empty
  Elastic law_;
  double inverse_cell_ = 1 / cell;  ///< 1/m
  std::size_t particles_ = 0;
  std::atomic<bool> drifted_ = false;

  std::vector<std::size_t> first_pack_;  ///< of each block, and the end
  std::vector<Box> box_;                 ///< of each block: what its particles touch
  AlignedArray<Pack> start_;             ///< the initial motion_
  AlignedArray<Pack> motion_;            ///< [particle]: {x, y, vx, vy}, m, m/s
  AlignedArray<Pack> mass_volume_;       ///< [pack]{m, V}: kg, m3
  AlignedArray<Pack> stress_;            ///< [pack]{xx, yy, xy, zz}: Pa
  AlignedArray<Pack> strain_;            ///< [pack]{xx, yy, 2 xy, energy in J/m3}

  AlignedArray<Pack> tile_momentum_;   ///< [block][tile node]: {m, px, py, V}
  AlignedArray<Pair> tile_force_;      ///< [block][tile node]: N
  AlignedArray<double> inverse_mass_;  ///< [block][node]: 1/kg
  AlignedArray<Pair> velocity_;        ///< [block][node]: from the momenta at the start of a step, m/s
  AlignedArray<Pair> end_velocity_;    ///< from those at its end
  AlignedArray<Pack> node_motion_;     ///< [block][node]: {v', a}, m/s, m/s2
};

}  // namespace

std::unique_ptr<Kernel> make_block2d(int cells, Scheme scheme, Stencil stencil, int threads) {
  if (stencil == Stencil::linear) return std::make_unique<Block2d<2>>(cells, scheme, threads);
  return std::make_unique<Block2d<3>>(cells, scheme, threads);
}

}  // namespace crampon::bench
