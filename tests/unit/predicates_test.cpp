// Exact signs against rational numbers (docs/theory/crossing.md, orientation).

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "crampon/core/predicates.hpp"
#include "crossing_cases.hpp"

namespace crampon {
namespace {

using namespace crampon::testing;

using boost::multiprecision::cpp_rational;

int rational_orient(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) {
  const cpp_rational ax(a[0]), ay(a[1]), bx(b[0]), by(b[1]), cx(c[0]), cy(c[1]);
  return cpp_rational((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).sign();
}

TEST(OrientSign, IsExactOnNearlyCollinearPoints) {
  Rng rng(1);
  int cases = 0, zeros = 0, naive_wrong = 0;
  for (int k = 0; k < 20000; ++k) {
    // c on the line a -> b up to rounding, then a few units in the last place away.
    const Vec<2> a{draw(rng, -1, 1), draw(rng, -1, 1)}, b{draw(rng, -1, 1), draw(rng, -1, 1)};
    const double t = k % 2 ? draw(rng, -1, 2) : pick(rng, -2, 3);
    Vec<2> c = a + (b - a) * t;
    for (int ulps = pick(rng, 0, 2); ulps > 0; --ulps) c[k / 2 % 2] = std::nextafter(c[k / 2 % 2], 2.);
    const int expected = rational_orient(a, b, c);
    ASSERT_EQ(orient_sign(a, b, c), expected);
    ASSERT_EQ(orient_sign_exact(a, b, c), expected);
    ASSERT_EQ(orient_sign(b, a, c), -expected);
    ASSERT_EQ(orient_sign(c, a, b), expected);
    const double naive = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    naive_wrong += ((naive > 0) - (naive < 0)) != expected;
    zeros += expected == 0;
    ++cases;
  }
  EXPECT_EQ(cases, 20000);
  EXPECT_GT(zeros, 500);         // the cases reach exact ties
  EXPECT_GT(naive_wrong, 1000);  // and are hard: plain arithmetic fails on them
}

TEST(OrientSign, IsExactOverWidelyDifferentMagnitudes) {
  Rng rng(2);
  const auto wide = [&] { return pick(rng, 0, 5) == 0 ? 0. : std::ldexp(draw(rng, -1, 1), pick(rng, -60, 60) * pick(rng, 0, 7)); };
  for (int k = 0; k < 5000; ++k) {
    const Vec<2> a{wide(), wide()}, b{wide(), wide()}, c{wide(), wide()};
    ASSERT_EQ(orient_sign(a, b, c), rational_orient(a, b, c));
    ASSERT_EQ(orient_sign_exact(a, b, c), rational_orient(a, b, c));
  }
}

TEST(OrientSign, PerturbationTakesTheFirstDerivativeThatIsNotZero) {
  const Vec<2> o{0, 0}, east{2, 0}, north{0, 2}, diagonal{2, 2};
  EXPECT_EQ(orient_sign_perturbed(o, east, {1, 0}), 1);       // (eps, eps^2) lies above the x axis
  EXPECT_EQ(orient_sign_perturbed(o, north, {0, 1}), -1);     // and to the right of the y axis
  EXPECT_EQ(orient_sign_perturbed(o, diagonal, {1, 1}), -1);  // and below the diagonal
  EXPECT_EQ(orient_sign_perturbed(diagonal, o, {1, 1}), 1);
  EXPECT_EQ(orient_sign_perturbed(o, o, {1, 1}), 0);
}

}  // namespace
}  // namespace crampon
