#include <gtest/gtest.h>

#include <any>
#include <map>
#include <string>
#include <vector>

#include "crampon/geometry/shapes.hpp"
#include "geometry_cases.hpp"

namespace crampon {
namespace {

using namespace testing;

// What a parser does with one alternative: sets keys by name, checks, builds.
struct Built {
  RegionPtr shape;
  std::vector<std::string> errors;
};
Built build(const std::string& kind, const std::map<std::string, EntryValue>& values,
            const std::map<std::string, std::vector<RegionPtr>>& parts = {}) {
  const Alternative* alternative = shapes().find(kind);
  if (!alternative) return {nullptr, {"no such kind"}};
  const auto object = alternative->record->create();
  for (const auto& [key, value] : values) alternative->record->find(key)->set(object.get(), value);
  for (const auto& [key, list] : parts)
    for (const RegionPtr& part : list) alternative->record->find(key)->assign(object.get(), std::any(part));
  Diagnostics diagnostics;
  alternative->record->check(object.get(), diagnostics);
  Built built;
  for (const Diagnostic& d : diagnostics.list()) built.errors.push_back(d.text());
  if (built.errors.empty()) built.shape = std::any_cast<RegionPtr>(alternative->build(object.get()));
  return built;
}
using Numbers = std::vector<double>;
using Points = std::vector<Numbers>;

TEST(ShapeFamily, BuildsEveryKind) {
  const RegionPtr disk = build("disk", {{"centre", Numbers{1, 2}}, {"radius", 3.}}).shape;
  const RegionPtr rectangle = build("rectangle", {{"centre", Numbers{1, 2}}, {"size", Numbers{4, 2}}}).shape;
  std::map<std::string, Built> built;
  built["disk"].shape = disk;
  built["rectangle"].shape = rectangle;
  built["ellipse"] = build("ellipse", {{"centre", Numbers{1, 2}}, {"semi_axes", Numbers{2, 1}}, {"angle", 1.}});
  built["ring"] = build("ring", {{"centre", Numbers{1, 2}}, {"inner", 1.}, {"outer", 2.}});
  built["sector"] = build("sector", {{"centre", Numbers{1, 2}}, {"radius", 2.}, {"from", -1.}, {"to", 1.}});
  built["polygon"] = build("polygon", {{"corners", Points{{0, 0}, {1, 0}, {0, 1}}}});
  built["half_plane"] = build("half_plane", {{"point", Numbers{1, 2, 3}}, {"normal", Numbers{0, 0, 2}}});
  built["box"] = build("box", {{"low", Numbers{0, 0, 0}}, {"high", Numbers{1, 2, 3}}});
  built["sphere"] = build("sphere", {{"centre", Numbers{1, 2, 3}}, {"radius", 3.}});
  built["cylinder"] = build("cylinder", {{"from", Numbers{0, 0, 0}}, {"to", Numbers{0, 0, 2}}, {"radius", 1.}});
  built["point"] = build("point", {{"at", Numbers{1, 2}}});
  built["line"] = build("line", {{"from", Numbers{1, 2}}, {"to", Numbers{2, 2}}});
  built["everywhere"] = build("everywhere", {});
  built["union"] = build("union", {}, {{"of", {disk, rectangle}}});
  built["intersection"] = build("intersection", {}, {{"of", {disk, rectangle}}});
  built["difference"] = build("difference", {}, {{"of", {disk}}, {"without", {rectangle}}});
  built["rotated"] = build("rotated", {{"angle", pi / 2}, {"about", Numbers{1, 2}}}, {{"of", {rectangle}}});
  built["translated"] = build("translated", {{"by", Numbers{10, 0}}}, {{"of", {disk}}});
  for (const Alternative& a : shapes().alternatives()) {
    ASSERT_TRUE(built.contains(a.name())) << a.name();
    EXPECT_TRUE(built[a.name()].shape) << a.name();
    EXPECT_FALSE(a.record->help().empty());
  }
  EXPECT_EQ(shapes().alternatives().size(), built.size());
  EXPECT_EQ(shapes().tag_key(), "kind");
  EXPECT_TRUE(rectangle->contains({{3, 3, 0}}));
  EXPECT_FALSE(rectangle->contains({{3.1, 3, 0}}));
  EXPECT_TRUE(built["rotated"].shape->contains({{0, 4, 0}}));
  EXPECT_TRUE(built["translated"].shape->contains({{11, 2, 0}}));
  EXPECT_FALSE(built["difference"].shape->contains({{1, 2, 0}}));
  EXPECT_TRUE(built["difference"].shape->contains({{1, 4.5, 0}}));
  for (const char* kind : {"box", "sphere", "cylinder", "half_plane"}) EXPECT_EQ(built[kind].shape->dimension(), 3) << kind;
  for (const char* kind : {"disk", "polygon", "point", "line", "rotated"}) EXPECT_EQ(built[kind].shape->dimension(), 2) << kind;
}

TEST(ShapeFamily, ChecksAcrossKeys) {
  const auto first = [](const Built& built) { return built.errors.empty() ? std::string() : built.errors[0]; };
  EXPECT_EQ(first(build("ring", {{"centre", Numbers{0, 0}}, {"inner", 2.}, {"outer", 2.}})),
            "the inner radius is not below the outer one (2 m >= 2 m leaves no area); make inner smaller than outer");
  EXPECT_EQ(first(build("rectangle", {{"low", Numbers{0, 1}}, {"high", Numbers{1, 0}}})),
            "high is below low along y (0 < 1); exchange the two numbers");
  EXPECT_EQ(first(build("rectangle", {{"low", Numbers{0, 1}}})),
            "high is missing (the shape has no extent); give low and high, or centre and size");
  EXPECT_EQ(first(build("box", {})), "low and high are missing (the shape has no extent); give low and high, or centre and size");
  EXPECT_EQ(first(build("rectangle", {{"low", Numbers{0, 0}}, {"high", Numbers{1, 1}}, {"size", Numbers{1, 1}}})).substr(0, 28),
            "corners and centre with size");
  EXPECT_NE(first(build("sector", {{"centre", Numbers{0, 0}}, {"radius", 1.}, {"from", 1.}, {"to", 0.}})), "");
  EXPECT_NE(first(build("sector", {{"centre", Numbers{0, 0}}, {"radius", 1.}, {"from", 0.}, {"to", 7.}})), "");
  EXPECT_NE(first(build("half_plane", {{"point", Numbers{0, 0}}, {"normal", Numbers{0, 0}}})), "");
  EXPECT_NE(first(build("half_plane", {{"point", Numbers{0, 0}}, {"normal", Numbers{0, 0, 1}}})), "");
  EXPECT_NE(first(build("cylinder", {{"from", Numbers{0, 0, 0}}, {"to", Numbers{0, 0, 0}}, {"radius", 1.}})), "");
  EXPECT_NE(first(build("rotated", {{"axis", Numbers{0, 0, 0}}, {"about", Numbers{0, 0, 0}}}, {{"of", {make<Everywhere>()}}})), "");
  EXPECT_NE(first(build("line", {{"from", Numbers{0, 0}}, {"to", Numbers{0, 0, 1}}})), "");
  EXPECT_EQ(
      first(build("polygon", {{"corners", Points{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}})),
      "the polygon crosses itself: the edge from corner 1 meets the edge from corner 3 (such loops do not bound an area); list each corner "
      "once, in order along the boundary");
  EXPECT_FALSE(shapes().find("disk")->record->find("radius")->bounds.contains(0)) << "a radius of zero";
}

}  // namespace
}  // namespace crampon
