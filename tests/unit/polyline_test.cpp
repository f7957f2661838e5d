#include <gtest/gtest.h>
// After gtest.h.
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "crampon/geometry/arc.hpp"

namespace crampon {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Arc, EndPointsAndChords) {
  const auto points = divide_arc({{1, 2}}, 2, 0, pi / 2, 6);
  ASSERT_EQ(points.size(), 7u);
  EXPECT_EQ(points.front(), (Vec<2>{{3, 2}}));
  EXPECT_EQ(points.back(), (Vec<2>{{1, 4}}));
  const double chord = norm(points[1] - points[0]);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    EXPECT_NEAR(norm(points[k + 1] - points[k]), chord, 1e-14);
    EXPECT_NEAR(norm(points[k] - Vec<2>{{1, 2}}), 2, 1e-15);
  }
  const auto clockwise = divide_arc({{0, 0}}, 1, pi, pi / 2, 3);
  EXPECT_EQ(clockwise.front(), (Vec<2>{{-1, 0}}));
  EXPECT_EQ(clockwise.back(), (Vec<2>{{0, 1}}));
  EXPECT_GT(clockwise[1][1], 0);
  const auto circle = divide_arc({{.1, .2}}, .3, .4, .4 + 2 * pi, 12);
  EXPECT_EQ(circle.front(), circle.back());
  const int n = count_arc_segments(2, 0, pi, .1);
  EXPECT_LE(norm(divide_arc({}, 2, 0, pi, n)[1] - Vec<2>{{2, 0}}), .1);
  EXPECT_GT(norm(divide_arc({}, 2, 0, pi, n - 1)[1] - Vec<2>{{2, 0}}), .1);
  EXPECT_THROW(divide_arc({}, 1, 0, 1, 0), std::invalid_argument);
  EXPECT_THROW(divide_arc({}, 0, 0, 1, 2), std::invalid_argument);
}

RC_GTEST_PROP(PolylineProperty, DividesEvenlyAndKeepsVertices, ()) {
  const auto raw =
      *rc::gen::container<std::vector<std::pair<int, int>>>(rc::gen::pair(rc::gen::inRange(-99, 99), rc::gen::inRange(-99, 99)));
  const double longest = *rc::gen::inRange(1, 50) * .1;
  std::vector<Vec<2>> points;
  for (const auto& [x, y] : raw) points.push_back({{x * .1, y * .1}});
  const auto divided = divide_polyline(points, longest);
  std::size_t next = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    // Every given vertex reappears bit by bit, and the way from one to the next is in equal steps.
    std::size_t parts = 0;
    if (k > 0) {
      const double length = norm(points[k] - points[k - 1]);
      parts = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length / longest * (1 - 1e-9))));
      for (std::size_t i = next; i < next + parts; ++i)
        RC_ASSERT(std::abs(norm(divided[i + 1] - divided[i]) - length / static_cast<double>(parts)) < 1e-13);
    }
    next += parts;
    RC_ASSERT(divided.at(next) == points[k]);
  }
  RC_ASSERT(divided.size() == (points.empty() ? 0 : next + 1));
  RC_ASSERT(divided.empty() || divided.size() >= points.size());
}

TEST(Polyline, WholeNumbersOfSegmentsStay) {
  EXPECT_EQ(divide_polyline<2>({{{0, 0}}, {{.3, 0}}}, .1).size(), 4u);  // 0.3/0.1 is 2.9999999999999996 or so either way
  EXPECT_EQ(divide_polyline<3>({{{0, 0, 0}}, {{0, 0, 1.2}}}, .4).size(), 4u);
  EXPECT_THROW(divide_polyline<2>({{{0, 0}}, {{1, 0}}}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace crampon
