// Crack crossing against exact arithmetic (docs/theory/crossing.md; conventions 9, 15-22).

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "crampon/core/predicates.hpp"
#include "crampon/crack/crossing.hpp"
#include "crossing_cases.hpp"

namespace crampon {
namespace {

using namespace crampon::testing;

using boost::multiprecision::cpp_int;

// The oracle: rational numbers over the common denominator 2^480, kept as integers.
// Coordinates are multiples of 2^-70 and below 2^4 (checked on conversion). Then a determinant of given points is zero or at least
// 2^-140, and its derivative by one of them zero or at least 2^-70 and below 2^5. With eps = 2^-160 the node's displacement
// (eps, eps^2) changes a determinant by less than 2^-154, and its second part matters only where the first has none: the explicit
// displacement does what the symbolic one says. Determinants with the displaced node are multiples of 2^-390, so a particle on the
// crack displaced by at most 2^-410 * 2^8 leaves every other sign alone.

constexpr int input_bits = 70, scale_bits = 480, eps_bits = 160, delta_bits = 410;

struct ExactPoint {
  cpp_int x, y;
  friend ExactPoint operator-(const ExactPoint& a, const ExactPoint& b) { return {a.x - b.x, a.y - b.y}; }
};

cpp_int to_exact(double x) {
  const double scaled = std::ldexp(x, 52);
  const double whole = std::floor(scaled), rest = std::ldexp(scaled - whole, input_bits - 52);  // both exact
  if (std::fabs(x) > 16 || rest != std::floor(rest)) throw std::invalid_argument("outside the oracle's proof");
  cpp_int n = static_cast<long long>(whole);
  n <<= input_bits - 52;
  n += static_cast<long long>(rest);
  return n << (scale_bits - input_bits);
}
ExactPoint to_exact(const Vec<2>& p) { return {to_exact(p[0]), to_exact(p[1])}; }
ExactPoint displaced(const Vec<2>& node) {
  ExactPoint n = to_exact(node);
  n.x += cpp_int(1) << (scale_bits - eps_bits);
  n.y += cpp_int(1) << (scale_bits - 2 * eps_bits);
  return n;
}
ExactPoint moved(const ExactPoint& p, const ExactPoint& direction) {
  return {p.x + (direction.x >> delta_bits), p.y + (direction.y >> delta_bits)};  // directions are multiples of 2^-70: exact
}
cpp_int cross(const ExactPoint& a, const ExactPoint& b) { return a.x * b.y - a.y * b.x; }
int sign(const cpp_int& x) { return x.sign(); }

/// Do p -> n and a -> b cross at inner points of both? By the parameters t and s of their intersection, as fractions.
bool meet_inside(const ExactPoint& p, const ExactPoint& n, const ExactPoint& a, const ExactPoint& b) {
  const ExactPoint r = n - p, e = b - a, d = a - p;
  cpp_int below = cross(r, e);
  if (below == 0) return false;
  cpp_int t = cross(d, e), s = cross(d, r);
  if (below < 0) {
    below = -below;
    t = -t;
    s = -s;
  }
  return t > 0 && t < below && s > 0 && s < below;
}

struct Answer {
  int above = 0, below = 0;
  std::vector<int> crossed;         ///< per segment; segments that meet at the particle's own position are counted at the first
  bool corner_on_tip_line = false;  ///< particle on an inner vertex, node in line with a tip: the tie rule has no unique reading
  bool crosses() const { return (above + below) % 2 != 0; }
};

Answer ask_oracle(const Polyline& crack, const Vec<2>& particle, const Vec<2>& node) {
  const std::size_t count = crack.vertices.size() - 1;
  const ExactPoint p = to_exact(particle), n_plain = to_exact(node), n = displaced(node);
  std::vector<ExactPoint> v;
  for (const Vec<2>& x : crack.vertices) v.push_back(to_exact(x));
  Answer answer;
  answer.crossed.assign(count, 0);
  for (std::size_t s = 0; s < count; ++s) {
    const ExactPoint e = v[s + 1] - v[s];
    const bool start_tip = s == 0 && !crack.closed, end_tip = s + 1 == count && !crack.closed;
    const bool tie = (start_tip && cross(n_plain - p, v[s] - p) == 0) || (end_tip && cross(n_plain - p, v[s + 1] - p) == 0);
    const bool at_start = particle == crack.vertices[s], at_end = particle == crack.vertices[s + 1];
    bool crossed = false, is_above = cross(e, p - v[s]) >= 0;
    if ((at_start && !start_tip) || (at_end && !end_tip)) {
      // The corner's two segments together, the particle moved into the corner above; told once, for the segment that ends here.
      const std::size_t before = at_end ? s : (s == 0 ? count - 1 : s - 1), after = at_end ? (s + 1 == count ? 0 : s + 1) : s;
      const bool before_tip = before == 0 && !crack.closed, after_tip = after + 1 == count && !crack.closed;
      answer.corner_on_tip_line |=
          (before_tip && cross(n_plain - p, v[before] - p) == 0) || (after_tip && cross(n_plain - p, v[after + 1] - p) == 0);
      if (at_end) {
        const ExactPoint to = v[after + 1] - p, back = v[before] - p;
        const int turn = sign(cross(p - v[before], to));
        ExactPoint inside{to.x + back.x, to.y + back.y};
        if (turn < 0) inside = {-inside.x, -inside.y};
        if (turn == 0) inside = {back.y, -back.x};
        const ExactPoint q = moved(p, inside);
        const bool first = meet_inside(q, n, v[before], p), second = meet_inside(q, n, p, v[after + 1]);
        crossed = first != second;  // both: in and out again
      }
    } else {
      ExactPoint q = p;
      if (cross(e, p - v[s]) == 0) q = moved(p, {-e.y, e.x});
      crossed = !tie && meet_inside(q, n, v[s], v[s + 1]);
    }
    if (!crossed) continue;
    answer.crossed[s] = 1;
    ++(is_above ? answer.above : answer.below);
  }
  return answer;
}

enum class Kind { random, lattice, near_lattice };

double coordinate(Rng& rng, Kind kind, int lattice) {
  if (kind == Kind::random) {
    const double x = draw(rng, 0, 4);
    return x < 0x1p-10 ? 0 : x;
  }
  double x = pick(rng, 0, lattice);
  // A few units in the last place off the lattice; multiples of 2^-52 throughout.
  if (kind == Kind::near_lattice) x += pick(rng, -2, 2) * 0x1p-52;
  return x;
}
Vec<2> point(Rng& rng, Kind kind, int lattice = 4) { return {coordinate(rng, kind, lattice), coordinate(rng, kind, lattice)}; }

/// 1 to 6 segments; no zero segments and no segment straight back on the one before.
Polyline polyline(Rng& rng, Kind kind, bool closed, int lattice = 4) {
  for (;;) {
    const int segments = closed ? pick(rng, 3, 6) : pick(rng, 1, 6);
    Points v;
    for (int k = 0; k < segments + (closed ? 0 : 1); ++k) v.push_back(point(rng, kind, lattice));
    if (closed) v.push_back(v.front());
    bool good = true;
    const std::size_t count = v.size() - 1;
    for (std::size_t s = 0; s < count && good; ++s) {
      if (v[s] == v[s + 1]) good = false;
      if (!closed && s + 1 == count) break;
      const Vec<2> u = v[s], m = v[s + 1], w = s + 1 == count ? v[1] : v[s + 2];
      if (good && orient_sign(u, m, w) == 0 && dot(m - u, w - m) <= 0) good = false;
    }
    if (good) return Polyline(std::move(v), closed);
  }
}

Vec<2> mirrored(Vec<2> p) { return {-p[0], p[1]}; }
Polyline mirrored(const Polyline& c) {
  Points v;
  for (const Vec<2>& p : c.vertices) v.push_back(mirrored(p));
  return Polyline(std::move(v), c.closed);
}
Polyline reversed(const Polyline& c) { return Polyline(Points(c.vertices.rbegin(), c.vertices.rend()), c.closed); }

bool on_segment(const Vec<2>& p, const Vec<2>& a, const Vec<2>& b) {
  return orient_sign(a, b, p) == 0 && p[0] >= std::min(a[0], b[0]) && p[0] <= std::max(a[0], b[0]) && p[1] >= std::min(a[1], b[1]) &&
         p[1] <= std::max(a[1], b[1]);
}
bool on_crack(const Polyline& c, const Vec<2>& p) {
  for (std::size_t s = 0; s + 1 < c.vertices.size(); ++s) {
    if (on_segment(p, c.vertices[s], c.vertices[s + 1])) return true;
  }
  return false;
}
bool in_line_with_tip(const Polyline& c, const Vec<2>& p, const Vec<2>& n) {
  return !c.closed && (orient_sign(p, n, c.vertices.front()) == 0 || orient_sign(p, n, c.vertices.back()) == 0);
}

/// In line with a whole tip segment: the line touches the tip, which excuses that segment, runs along it, and where the next segment
/// turns off, the displaced node decides. Nothing tells the sides apart there.
bool along_tip_segment(const Polyline& c, const Vec<2>& p, const Vec<2>& n) {
  if (c.closed) return false;
  const std::size_t last = c.vertices.size() - 1;
  const auto on_line = [&](std::size_t k) { return orient_sign(p, n, c.vertices[k]) == 0; };
  return (on_line(0) && on_line(1)) || (on_line(last) && on_line(last - 1));
}

/// Of segment s, or the mean of two when the line goes through a vertex between them.
Vec<2> crossed_normal(const Polyline& crack, std::size_t s, const Vec<2>& p, const Vec<2>& n) {
  const std::size_t count = crack.normals.size();
  std::size_t other = s;
  if ((s > 0 || crack.closed) && orient_sign_exact(p, n, crack.vertices[s]) == 0) other = (s + count - 1) % count;
  if ((s + 1 < count || crack.closed) && orient_sign_exact(p, n, crack.vertices[s + 1]) == 0) other = (s + 1) % count;
  return (crack.normals[s] + crack.normals[other]) * 0.5;
}

TEST(Crossing, AgreesWithExactRationals) {
  struct Group {
    Kind kind;
    bool closed;
    int cases, lattice;
  };
  const Group groups[] = {{Kind::random, false, 25000, 0},     {Kind::random, true, 10000, 0},   {Kind::lattice, false, 40000, 3},
                          {Kind::lattice, true, 20000, 3},     {Kind::lattice, false, 20000, 6}, {Kind::near_lattice, false, 20000, 3},
                          {Kind::near_lattice, true, 10000, 3}};
  int compared = 0, skipped = 0, crossed = 0, multiple = 0, node_on_crack = 0, particle_on_crack = 0, particle_on_vertex = 0;
  Rng rng(3);
  for (const Group& g : groups) {
    for (int k = 0; k < g.cases; ++k) {
      const Polyline crack = polyline(rng, g.kind, g.closed, g.lattice);
      Vec<2> p = point(rng, g.kind, g.lattice);
      const Vec<2> n = point(rng, g.kind, g.lattice);
      if (g.kind == Kind::lattice && k % 2) p = {p[0] + 0.25 - 0.5 * pick(rng, 0, 1), p[1] + 0.25 - 0.5 * pick(rng, 0, 1)};
      const Answer expected = ask_oracle(crack, p, n);
      if (expected.corner_on_tip_line) {
        ++skipped;
        continue;
      }
      const Crossing got = cross_crack(crack.mesh(), p, n);
      const auto at_vertex = std::find(crack.vertices.begin(), crack.vertices.end(), p) != crack.vertices.end();
      ASSERT_EQ(got.crosses(), expected.crosses()) << "case " << k;
      ASSERT_EQ(got.above, expected.above) << "case " << k;
      ASSERT_EQ(got.below, expected.below) << "case " << k;
      if (!at_vertex) {
        Vec<2> normal_sum;
        for (std::size_t s = 0; s < expected.crossed.size(); ++s) {
          if (expected.crossed[s]) normal_sum += crossed_normal(crack, s, p, n);
          const FacetRef one{0, static_cast<FacetId>(s)};
          const Crossing of_one = cross_crack(crack.mesh(), {&one, 1}, p, n);
          ASSERT_EQ(of_one.above + of_one.below, expected.crossed[s]);
        }
        ASSERT_EQ(got.normal_sum, normal_sum);
      }
      ++compared;
      crossed += expected.crosses();
      multiple += expected.above + expected.below > 1;
      node_on_crack += on_crack(crack, n);
      particle_on_crack += on_crack(crack, p);
      particle_on_vertex += at_vertex;
    }
  }
  EXPECT_EQ(compared + skipped, 145000);
  EXPECT_GE(compared, 140000);
  // The cases reach what they are meant for.
  EXPECT_GT(crossed, 20000);
  EXPECT_GT(multiple, 10000);
  EXPECT_GT(node_on_crack, 10000);
  EXPECT_GT(particle_on_crack, 5000);
  EXPECT_GT(particle_on_vertex, 2000);
}

/// Is p inside the closed polyline by the even-odd rule? A ray to +x from a generic height, in exact numbers.
bool inside(const Polyline& c, const ExactPoint& p) {
  bool in = false;
  for (std::size_t s = 0; s + 1 < c.vertices.size(); ++s) {
    const ExactPoint a = to_exact(c.vertices[s]), b = to_exact(c.vertices[s + 1]);
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const int side = sign(cross(b - a, p - a));
    if ((b.y > a.y) == (side > 0)) in = !in;
  }
  return in;
}

TEST(Crossing, OfAClosedCrackTellsInsideFromOutside) {
  Rng rng(4);
  int compared = 0, parted = 0;
  for (int k = 0; k < 20000; ++k) {
    const Polyline crack = polyline(rng, k % 2 ? Kind::lattice : Kind::random, true);
    const Vec<2> p = point(rng, k % 4 < 2 ? Kind::random : Kind::lattice), n = point(rng, Kind::lattice);
    if (on_crack(crack, p)) continue;
    const bool expected = inside(crack, to_exact(p)) != inside(crack, displaced(n));
    ASSERT_EQ(cross_crack(crack.mesh(), p, n).crosses(), expected);
    ++compared;
    parted += expected;
  }
  EXPECT_GT(compared, 15000);
  EXPECT_GT(parted, 2000);
}

TEST(Crossing, StencilGivesWhatPairsGive) {
  Rng rng(5);
  int crossed = 0;
  for (int k = 0; k < 5000; ++k) {
    const Kind kind = k % 2 ? Kind::lattice : Kind::random;
    const Polyline crack = polyline(rng, kind, k % 5 == 0);
    std::vector<FacetRef> facets;
    for (std::uint32_t s = 0; s + 1 < crack.vertices.size(); ++s) facets.push_back({0, s});
    const Vec<2> p = point(rng, kind);
    Points nodes;
    for (int i = 0; i < 9; ++i) nodes.push_back(point(rng, Kind::lattice));
    std::vector<Crossing<2>> got(nodes.size());
    CrackMesh mesh = crack.mesh();
    const std::vector<Vec<2>> original(facets.size(), Vec<2>{0, -1});  // a crack that was straight at the start
    mesh.original_normals = original;
    cross_stencil<2>(mesh, facets, p, nodes, got);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Crossing one = cross_crack(mesh, facets, p, nodes[i]);
      ASSERT_EQ(got[i].above, one.above);
      ASSERT_EQ(got[i].below, one.below);
      ASSERT_EQ(got[i].normal_sum, one.normal_sum);
      ASSERT_EQ(got[i].original_sum, one.original_sum);
      ASSERT_EQ(one.original_sum[1], -(one.above + one.below));
      crossed += one.crosses();
    }
  }
  EXPECT_GT(crossed, 2000);
}

TEST(Crossing, ReversedCrackSwapsAboveAndBelow) {
  Rng rng(6);
  int compared = 0, crossed = 0;
  for (int k = 0; k < 60000; ++k) {
    const Kind kind = k % 3 ? Kind::lattice : Kind::random;
    const Polyline crack = polyline(rng, kind, k % 5 == 0), back = reversed(crack);
    const Vec<2> p = point(rng, kind), n = point(rng, kind);
    if (on_crack(crack, p)) continue;  // counts as above in either direction
    const Crossing one = cross_crack(crack.mesh(), p, n), two = cross_crack(back.mesh(), p, n);
    ASSERT_EQ(one.above, two.below);
    ASSERT_EQ(one.below, two.above);
    ASSERT_EQ(one.side(), -two.side());
    // Sums of at most six unit vectors in another order.
    ASSERT_NEAR(one.normal_sum[0], -two.normal_sum[0], 1e-14);
    ASSERT_NEAR(one.normal_sum[1], -two.normal_sum[1], 1e-14);
    ++compared;
    crossed += one.crosses();
  }
  EXPECT_GT(compared, 40000);
  EXPECT_GT(crossed, 10000);
}

TEST(Crossing, MirrorImageIsClassifiedAlike) {
  Rng rng(7);
  int off_crack = 0, tip_ties = 0, on_crack_nodes = 0, flipped = 0;
  for (int k = 0; k < 40000; ++k) {
    const Kind kind = k % 4 ? Kind::lattice : Kind::random;
    const Polyline crack = polyline(rng, kind, k % 5 == 0), image = mirrored(crack);
    const Vec<2> n = point(rng, kind);
    if (!on_crack(crack, n)) {
      const Vec<2> p = point(rng, kind);
      if (on_crack(crack, p)) continue;
      const Crossing one = cross_crack(crack.mesh(), p, n), two = cross_crack(image.mesh(), mirrored(p), mirrored(n));
      if (along_tip_segment(crack, p, n)) continue;
      tip_ties += in_line_with_tip(crack, p, n);
      ASSERT_EQ(one.crosses(), two.crosses());
      if (one.crosses()) {
        ASSERT_EQ(one.side(), -two.side());
      }
      ++off_crack;
      continue;
    }
    // A node on the crack may go to either side, but its particles are parted in the same way.
    int same = 0, other = 0;
    for (int i = 0; i < 8; ++i) {
      const Vec<2> p = point(rng, Kind::lattice);
      if (on_crack(crack, p) || in_line_with_tip(crack, p, n)) continue;
      const bool one = cross_crack(crack.mesh(), p, n).crosses();
      const bool two = cross_crack(image.mesh(), mirrored(p), mirrored(n)).crosses();
      ++(one == two ? same : other);
    }
    // Away from points where the crack meets itself: there more than two sides meet.
    int through = 0;
    for (std::size_t s = 0; s + 1 < crack.vertices.size(); ++s) {
      through += on_segment(n, crack.vertices[s], crack.vertices[s + 1]);
      if (n == crack.vertices[s + 1]) --through;
    }
    const bool tip = !crack.closed && (n == crack.vertices.front() || n == crack.vertices.back());
    if (through != 1 || tip || same + other == 0) continue;
    ASSERT_TRUE(same == 0 || other == 0) << "case " << k;
    ++on_crack_nodes;
    flipped += other > 0;
  }
  EXPECT_GT(off_crack, 15000);
  EXPECT_GT(tip_ties, 1000);
  EXPECT_GT(on_crack_nodes, 2000);
  EXPECT_GT(flipped, 500);
}

TEST(Crossing, ParticlesAroundANodeOnTheCrackAgreeOnItsSide) {
  Rng rng(8);
  int nodes = 0, pairs = 0, at_vertex = 0;
  while (nodes < 4000) {
    // Node (0, 0) between u and w, at a vertex or inside a segment; the tips are u and w.
    const Vec<2> o{0, 0}, u = point(rng, Kind::lattice) - Vec<2>{2, 2}, w = point(rng, Kind::lattice) - Vec<2>{2, 2};
    const int turn = orient_sign(u, o, w);
    if (u == o || w == o || (turn == 0 && dot(u, w) > 0)) continue;
    const bool bent = turn != 0 || nodes % 2 == 0;
    const Polyline crack(bent ? Points{u, o, w} : Points{u, w});
    int crossed_above = 0, crossed_below = 0, above = 0, below = 0;
    for (int k = 0; k < 40; ++k) {
      const Vec<2> p{pick(rng, -6, 6) / 16., pick(rng, -6, 6) / 16.};  // nearer to the node than any tip
      if (on_crack(crack, p) || in_line_with_tip(crack, p, o)) continue;
      // Above: in the corner to the left of u -> o -> w.
      const bool left_u = orient_sign(u, o, p) > 0, left_w = orient_sign(o, w, p) > 0;
      const bool is_above = turn >= 0 ? left_u && left_w : left_u || left_w;
      const Crossing c = cross_crack(crack.mesh(), p, o);
      ++(is_above ? above : below);
      (is_above ? crossed_above : crossed_below) += c.crosses();
      if (c.crosses()) {
        ASSERT_EQ(c.side(), is_above ? 1 : -1);
      }
    }
    // One side owns the node: the whole of the other crosses, none of its own does.
    const bool above_owns = crossed_above == 0 && crossed_below == below;
    const bool below_owns = crossed_below == 0 && crossed_above == above;
    ASSERT_TRUE(above_owns || below_owns);
    ++nodes;
    at_vertex += bent;
    pairs += above + below;
  }
  EXPECT_GT(pairs, 100000);
  EXPECT_GT(at_vertex, 1000);
}

TEST(Crossing, CrackAlongAGridLineSplitsEveryNodeButItsTips) {
  // The natural input that vanishes under the paper's rule (conventions 16).
  Points v;
  for (int i = 0; i <= 4; ++i) v.push_back({double(i), 1.});
  const Polyline crack(v);
  for (int i = -1; i <= 5; ++i) {
    const Vec<2> node{double(i), 1};
    int crossed = 0;
    for (const double dx : {-0.75, -0.25, 0.25, 0.75}) {
      for (const double dy : {-0.75, -0.25, 0.25, 0.75}) {
        const Crossing c = cross_crack(crack.mesh(), node + Vec<2>{dx, dy}, node);
        crossed += c.crosses();
        if (c.crosses()) {
          EXPECT_EQ(c.side(), -1);
          EXPECT_EQ(c.normal_sum, (Vec<2>{0, -1}));
        }
      }
    }
    EXPECT_EQ(crossed, i >= 1 && i <= 3 ? 8 : 0) << "node " << i;
  }
}

TEST(Crossing, ParticleOnTheCrackCountsAsAbove) {
  const Polyline crack({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  for (const double x : {0.5, 1., 1.25, 2., 2.5}) {
    EXPECT_FALSE(cross_crack(crack.mesh(), {x, 0}, {1.5, 1}).crosses());
    const Crossing c = cross_crack(crack.mesh(), {x, 0}, {1.5, -1});
    EXPECT_TRUE(c.crosses());
    EXPECT_EQ(c.side(), 1);
  }
}

TEST(Crossing, ParticleOnACornerSeesTheWholeSideBelow) {
  const Polyline square({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, true);  // above is inside
  for (const Vec<2>& corner : square.vertices) {
    for (const Vec<2>& node : Points{{2, 0.5}, {2, -1}, {0.5, -1}, {-1, 0.5}, {-1, 2}, {0.5, 2}}) {
      EXPECT_TRUE(cross_crack(square.mesh(), corner, node).crosses());
    }
    EXPECT_FALSE(cross_crack(square.mesh(), corner, {0.5, 0.25}).crosses());
  }
}

}  // namespace
}  // namespace crampon
