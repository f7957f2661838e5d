// What pictures and plots hold: labels that can be read, colours that mean what they seem to, walls, tools, outlines and names.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "crampon/geometry/boxes.hpp"
#include "crampon/geometry/flats.hpp"
#include "crampon/input/read_problem.hpp"
#include "crampon/output/vtp.hpp"
#include "crampon/picture/axis.hpp"
#include "crampon/picture/draw.hpp"
#include "crampon/picture/plot.hpp"
#include "crampon/run/rigid_shapes.hpp"
#include "output_cases.hpp"
#include "png_pixels.hpp"
#include "run_case.hpp"

namespace crampon {
namespace {

using test::Pixels;

// Particles of one size in rows and columns from a corner; the field "signal" runs from lowest to highest.
PointFrame lattice(std::array<double, 2> corner, int columns, int rows, double size, double lowest, double highest) {
  PointFrame f;
  f.cell = 2 * size;
  f.fields = {{"id", "1", 1, {}}, {"body", "1", 1, {}}, {"signal", "Pa", 1, {}}};
  const int count = columns * rows;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, row = i / columns;
    for (const double x : {corner[0] + (column + 0.5) * size, corner[1] + (row + 0.5) * size, 0.}) f.positions.push_back(x);
    for (int k = 0; k < 3; ++k) f.particle_size.push_back(size);
    f.fields[0].values.push_back(i);
    f.fields[1].values.push_back(0);
    f.fields[2].values.push_back(count == 1 ? lowest : lowest + (highest - lowest) * i / (count - 1));
  }
  f.body_names = {"block"};
  return f;
}

void add(PointFrame& all, const PointFrame& more, int body, const std::string& name) {
  for (const double x : more.positions) all.positions.push_back(x);
  for (const double x : more.particle_size) all.particle_size.push_back(x);
  for (std::size_t k = 0; k < all.fields.size(); ++k)
    for (const double v : more.fields[k].values) all.fields[k].values.push_back(all.fields[k].name == "body" ? body : v);
  all.body_names.push_back(name);
}

// Every text lies in the picture, and no two have a place in common.
void expect_readable(const std::vector<DrawnText>& texts, int width, int height, const std::string& what) {
  EXPECT_GE(texts.size(), 4u) << what;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const PixelBox& box = texts[i].box;
    EXPECT_TRUE(box.left >= 0 && box.top >= 0 && box.right() <= width && box.bottom() <= height)
        << what << ": \"" << texts[i].text << "\" leaves the picture of " << width << " x " << height;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(box.overlaps(texts[j].box)) << what << ": \"" << texts[i].text << "\" over \"" << texts[j].text << "\"";
  }
}

bool shows(const std::vector<DrawnText>& texts, const std::string& wanted) {
  return std::any_of(texts.begin(), texts.end(), [&](const DrawnText& t) { return t.text == wanted; });
}

constexpr std::array<std::array<double, 2>, 13> hard_ranges{{{0, 1},
                                                             {-1, 1},
                                                             {1e8, 1e8 + 3e1},
                                                             {-123456.789, -123456.7},
                                                             {0.99999, 1.00001},
                                                             {1e-300, 3e-300},
                                                             {-2e300, 1e300},
                                                             {0, 1e-30},
                                                             {7, 7},
                                                             {0, 0},
                                                             {1e6, 1e6 * (1 + 1e-12)},
                                                             {-999.9999, 999.9999},
                                                             {1234.5678, 98765.4321}}};

TEST_F(Output, LabelsOfPicturesNeverCollide) {
  // Windows far from the origin and much longer than high, ranges that need many digits, pictures of any size.
  const std::array<std::array<double, 2>, 5> corners{{{0, 0}, {1e3, -1e3}, {123.456, 1e5}, {-7e-7, 3e-7}, {-0.004, -0.004}}};
  const std::array<std::array<int, 2>, 4> counts{{{1, 1}, {4, 4}, {40, 1}, {1, 30}}};
  int trial = 0;
  for (const auto& range : hard_ranges) {
    for (const int width : {200, 430, 1200}) {
      const auto& corner = corners[static_cast<std::size_t>(trial) % corners.size()];
      const auto& count = counts[static_cast<std::size_t>(trial) % counts.size()];
      ++trial;
      PointFrame frame = lattice(corner, count[0], count[1], 1e-3, range[0], range[1]);
      frame.time = 1.23456789e-5;
      const DrawOptions options{.quantity = "signal", .title = "A title that says what it is", .width = width, .max_height = 600};
      const PictureMap map = draw_frame({&frame}, options, folder / "p.png");
      expect_readable(map.texts, map.width, map.height, fmt::format("range {} to {}, width {}", range[0], range[1], width));
    }
  }
  PointFrame frame = lattice({1e3, -1e3}, 5, 5, 1e-3, 100000.1, 100000.2);
  for (const int width : {200, 700, 1600}) {
    for (const int columns : {1, 2, 5}) {
      const DrawOptions options{.quantity = "signal", .title = "Panels", .columns = columns, .width = width, .max_height = 900};
      const PictureMap map = draw_panel({{&frame}, {&frame}, {&frame}, {&frame}, {&frame}}, options, folder / "p.png");
      expect_readable(map.texts, map.width, map.height, fmt::format("panels in {} columns, width {}", columns, width));
    }
  }
}

TEST_F(Output, LabelsOfPlotsNeverCollide) {
  for (const auto& range : hard_ranges) {
    for (std::size_t k = 0; k < hard_ranges.size(); k += 3) {
      const auto& along = hard_ranges[k];
      const int width = along[1] > 1e5 ? 200 : along[0] < 0 ? 500 : 1200;
      const Curve a{"a curve with a long name", {along[0], along[1]}, {range[0], range[1]}},
          b{"another", {along[0], along[1]}, {range[1], range[0]}};
      const PlotOptions options{.title = "A plot",
                                .x_name = "time",
                                .x_unit = "s",
                                .y_name = "stress xx",
                                .y_unit = "Pa",
                                .width = width,
                                .height = width * 3 / 5};
      const PlotMap map = plot_profiles({a, b}, options, folder / "p.png");
      expect_readable(map.texts, map.width, map.height, fmt::format("{} to {} over {} to {}", range[0], range[1], along[0], along[1]));
    }
  }
}

TEST_F(Output, NumbersThatDifferInTheirLastDigitsShowWhatTheyDifferBy) {
  const LabelFont font{[](const std::string& label) { return 9. * static_cast<double>(label.size()); }, 17};
  const Axis time = label_axis({1.2, 1.2 + 8e-6, "time", "s", {}}, Direction::across, 800, 20, font);
  EXPECT_EQ(time.title, "time − 1.2 s (µs)");
  ASSERT_GE(time.marks.size(), 3u);
  EXPECT_EQ(time.marks[0].label, "0");
  EXPECT_NEAR(time.marks[1].value - time.marks[0].value, 1e-6, 1e-15);
  const Axis negative = label_axis({-5e6 - 3, -5e6 - 1, "stress xx", "Pa", {}}, Direction::upwards, 500, 8, font);
  EXPECT_TRUE(contains(negative.title, "stress xx + 5 MPa (Pa)")) << negative.title;
  EXPECT_EQ(label_axis({0, 1e30, "x", "m", {}}, Direction::across, 800, 20, font).title, "x (×10³⁰ m)");
  EXPECT_EQ(label_axis({-2e-3, 5e-3, "y", "m", {}}, Direction::upwards, 800, 20, font).title, "y (mm)");
}

TEST_F(Output, ValuesOfBothSignsAreColouredAboutZero) {
  const PointFrame both = lattice({0, 0}, 3, 3, 1, -20, 70), one = lattice({0, 0}, 3, 3, 1, 20, 70);
  const auto drawn = [&](const PointFrame& frame, DrawOptions options) {
    options.quantity = "signal";
    return draw_frame({&frame}, options, folder / "p.png");
  };
  const auto expect_pale_zero = [](const PictureMap& map) {
    const Colour zero = map.colour(0), pale = palette_colour(Palette::diverging, 0.5);
    EXPECT_EQ(map.palette, Palette::diverging);
    EXPECT_EQ(zero.red, pale.red);
    EXPECT_EQ(zero.blue, pale.blue);
  };
  PictureMap map = drawn(both, {});
  EXPECT_EQ(map.lowest, -70);
  EXPECT_EQ(map.highest, 70);
  expect_pale_zero(map);
  map = drawn(one, {});
  EXPECT_EQ(map.lowest, 20);
  EXPECT_EQ(map.palette, Palette::uniform);
  map = drawn(one, {.palette = Palette::diverging});
  EXPECT_EQ(map.lowest, -70);
  expect_pale_zero(map);
  map = drawn(both, {.lowest = -10, .highest = 40});  // ends that were asked for stay
  EXPECT_EQ(map.lowest, -10);
  EXPECT_EQ(map.highest, 40);
  expect_pale_zero(map);
  map = drawn(both, {.palette = Palette::uniform});
  EXPECT_EQ(map.lowest, -20);
  EXPECT_EQ(map.highest, 70);
  map = drawn(both, {.palette = Palette::grey, .range = ColourRange::symmetric});
  EXPECT_EQ(map.lowest, -70);
  EXPECT_TRUE(shows(map.texts, "signal (Pa)")) << "the bar names the quantity";
  EXPECT_TRUE(shows(map.texts, "x (m)") && shows(map.texts, "y (m)"));
  // Numbers of single precision that should be equal are.
  map = drawn(lattice({0, 0}, 3, 3, 1, -1e6, -1e6 * (1 + 1e-7)), {});
  EXPECT_NEAR(map.highest, -0.5e6, 1);
}

TEST_F(Output, CategoriesHaveALegendWithNames) {
  PointFrame frame = lattice({0, 0}, 4, 4, 1, 0, 1);
  add(frame, lattice({4, 0}, 4, 4, 1, 0, 1), 1, "anvil");
  add(frame, lattice({0, 4}, 4, 4, 1, 0, 1), 2, "hammer");
  PictureMap map = draw_frame({&frame}, {.quantity = "body"}, folder / "b.png");
  ASSERT_EQ(map.legend.size(), 3u);
  for (const char* name : {"body", "block", "anvil", "hammer"}) EXPECT_TRUE(shows(map.texts, name)) << name;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = map.panels[0].pixel(i == 1 ? 6 : 2, i == 2 ? 6 : 2);
    test::expect_colour(Pixels(folder / "b.png").at(at[0], at[1]), map.legend[i].colour, map.legend[i].name);
  }
  // Numbers of materials may count one several times: it is one in the legend.
  frame.fields.push_back({"material", "1", 1, frame.fields[1].values});
  map = draw_frame({&frame}, {.quantity = "material", .category_names = {"steel", "rubber", "steel"}}, folder / "m.png");
  ASSERT_EQ(map.legend.size(), 2u);
  EXPECT_EQ(map.legend[0].name, "steel");
  EXPECT_TRUE(shows(map.texts, "material") && shows(map.texts, "rubber"));
  EXPECT_TRUE(is_category(frame, "material"));
  EXPECT_FALSE(is_category(frame, "id"));
  EXPECT_FALSE(is_category(frame, "signal"));
}

TEST_F(Output, LegendsOfManyAndLongNamesFit) {
  PointFrame frame = lattice({0, 0}, 1, 1, 1, 0, 1);
  for (int b = 1; b < 60; ++b) {
    const int column = b % 8, row = b / 8;
    add(frame, lattice({1. * column, 1. * row}, 1, 1, 1, 0, 1), b, fmt::format("a grain with a name that says a lot, number {}", b));
  }
  for (const int width : {200, 1200}) {
    const PictureMap map = draw_frame({&frame}, {.quantity = "body", .width = width, .max_height = 500}, folder / "b.png");
    EXPECT_EQ(map.legend.size(), 60u);
    expect_readable(map.texts, map.width, map.height, "60 bodies");
    EXPECT_TRUE(std::any_of(map.texts.begin(), map.texts.end(), [](const DrawnText& t) { return t.text.ends_with(" more"); }));
  }
  double nearest = INFINITY;
  for (std::size_t i = 0; i < 20; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const OkLab a = oklab_from_srgb(category_colour(i)), b = oklab_from_srgb(category_colour(j));
      nearest = std::min(nearest, std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b));
    }
  }
  EXPECT_GT(nearest, 0.06) << "three times what is just seen as different side by side";
}

// Darkest of some pixels across a place.
int darkest(const Pixels& pixels, const std::array<double, 2>& at, double dx, double dy) {
  int least = 255;
  for (int k = -2; k <= 2; ++k) least = std::min(least, pixels.at(at[0] + k * dx, at[1] + k * dy)[1]);
  return least;
}

TEST_F(Output, TouchingBodiesHaveAnOutline) {
  PointFrame frame = lattice({0, 0}, 4, 4, 1, 1, 1);
  add(frame, lattice({4, 0}, 4, 4, 1, 1, 1), 1, "right");
  const PictureMap map = draw_frame({&frame}, {.quantity = "signal"}, folder / "b.png");
  const Pixels pixels(folder / "b.png");
  const int colour = static_cast<int>(std::lround(255 * map.colour(1).green));
  for (const double y : {0.3, 1.5, 2.0, 3.7}) {
    EXPECT_LT(darkest(pixels, map.panels[0].pixel(4, y), 1, 0), 100) << "between the bodies at " << y;
    EXPECT_EQ(darkest(pixels, map.panels[0].pixel(3, y), 1, 0), colour) << "within a body at " << y;
    EXPECT_LT(darkest(pixels, map.panels[0].pixel(8, y), 1, 0), 100) << "at the edge at " << y;
  }
}

RigidShape tool_of(const RegionPtr& shape, int body) {
  RigidShape tool{"tool", body, shape};
  const Bounds3 box = shape->bounds();
  if (std::isfinite(box.low[0] + box.high[0])) tool.surface = box;
  return tool;
}

TEST_F(Output, RigidBodiesAndWallsAreDrawnByTheirShapes) {
  PointFrame frame = lattice({0, 0}, 8, 4, 1, 1, 2);
  add(frame, lattice({2, 4}, 4, 2, 1, -50, 50), 1, "tool");  // its own values are nobody's
  RigidShape tool = tool_of(std::make_shared<Rectangle>(Vec<2>{{2, 4}}, Vec<2>{{6, 6}}), 1);
  tool.place = {{4, 5, 0}, {4, 5.5, 0}, {0, -1, 0, 1, 0, 0, 0, 0, 1}};  // a quarter turn, and up by half
  RigidShape floor = tool_of(std::make_shared<HalfPlane>(Vec<3>{{0, 0, 0}}, Vec<3>{{0, 1, 0}}, 2), -1);
  floor.name = "floor";
  PictureMap map = draw_frame({&frame, nullptr, {tool, floor}}, {.quantity = "signal"}, folder / "b.png");
  EXPECT_EQ(map.lowest, 1) << "what is rigid has no part in the range";
  EXPECT_EQ(map.highest, 2);
  const Pixels pixels(folder / "b.png");
  const PictureMap::Panel& panel = map.panels[0];
  const auto is_rigid = [&](double x, double y) {  // grey, of the fill or the hatching
    const auto at = panel.pixel(x, y);
    const std::array<int, 3> c = pixels.at(at[0], at[1]);
    return std::abs(c[0] - c[2]) <= 6 && c[0] > 120 && c[0] < 225;
  };
  // The turned tool covers 3 < x < 5, 3.5 < y < 7.5, but for the block before it.
  for (const double y : {4.2, 5.5, 7.3}) EXPECT_TRUE(is_rigid(3.2, y) && is_rigid(4.8, y)) << y;
  for (const double x : {2.7, 5.3}) test::expect_colour(pixels.at(panel.pixel(x, 5.5)[0], panel.pixel(x, 5.5)[1]), {1, 1, 1}, "beside it");
  for (const auto& [x, y] : {std::pair{3., 5.5}, {5., 6.1}}) EXPECT_LT(darkest(pixels, panel.pixel(x, y), 1, 0), 100) << "its outline";
  EXPECT_LT(darkest(pixels, panel.pixel(4, 7.5), 0, 1), 100) << "its upper edge";
  EXPECT_TRUE(is_rigid(1, -0.4) && is_rigid(7.5, -0.3)) << "the floor";
  EXPECT_LT(darkest(pixels, panel.pixel(-0.5, 0), 0, 1), 100) << "its surface beside the block";
  // Magnified like everything else: from (4, 5), up by 1.
  frame.fields.push_back({"displacement", "m", 3, Numbers(std::vector<double>(3 * frame.fields[0].values.size(), 0.))});
  tool.place.turn = RigidPlace{}.turn;
  map = draw_frame({&frame, nullptr, {tool}}, {.quantity = "signal", .magnification = 2}, folder / "m.png");
  const Pixels magnified(folder / "m.png");
  EXPECT_LT(darkest(magnified, map.panels[0].pixel(4, 7), 0, 1), 100) << "its upper edge, one above where it began";
  // Bodies told apart: tools and walls have names too.
  map = draw_frame({&frame, nullptr, {tool, floor}}, {.quantity = "body"}, folder / "n.png");
  for (const char* name : {"block", "tool", "floor"}) EXPECT_TRUE(shows(map.texts, name)) << name;
}

TEST_F(Output, SolidRigidBodiesStandBeforeAndBehind) {
  PointFrame frame = lattice({0, 0}, 4, 4, 1, 1, 2);
  frame.dimension = 3;
  const auto box = [](double z) { return tool_of(std::make_shared<Box>(Vec<3>{{1, 1, z}}, Vec<3>{{3, 6, z + 1}}), -1); };
  for (const double z : {2., -3.}) {
    const PictureMap map = draw_frame({&frame, nullptr, {box(z)}}, {.quantity = "signal", .window = {{-1, 7, -1, 7}}}, folder / "b.png");
    const Pixels pixels(folder / "b.png");
    const auto seen = [&](double x, double y) { return pixels.at(map.panels[0].pixel(x, y)[0], map.panels[0].pixel(x, y)[1]); };
    const std::array<int, 3> over = seen(2.2, 2.3), beside = seen(2.2, 5);
    EXPECT_LE(std::abs(beside[0] - beside[2]), 6) << "grey where nothing else is";
    EXPECT_EQ(std::abs(over[0] - over[2]) <= 6, z > 0) << "before the particles from above, behind them from below";
  }
  const RigidShape face_on = tool_of(std::make_shared<HalfPlane>(Vec<3>{{0, 0, -5}}, Vec<3>{{0, 0, 1}}, 3), -1);
  EXPECT_FALSE(RigidView(face_on, 1, 0).shows_an_edge());
}

const char* const turning_tool = R"(
analysis = "plane_strain"
[grid]
origin = [0, 0]
size = [10, 10]
cell = 0.5
[time]
end = 0.5
[contact]
fields = "bodies"
[[material]]
name = "elastic"
law = "elastic_small_strain"
E = 100
nu = 0.3
density = 1
[[body]]
name = "block"
material = "elastic"
shape = { kind = "rectangle", low = [1, 1], high = [3, 3] }
[[rigid]]
name = "tool"
shape = { kind = "rectangle", low = [5, 5], high = [7, 6] }
velocity = [0, { expression = "2*t" }]
spin = [1.2]
[[wall]]
name = "floor"
point = [0, 0.5]
normal = [0, 1]
velocity = [0, -0.2]
[[wall]]
name = "drum"
kind = "hollow_ball"
centre = [5, 5]
radius = 4.5
)";

TEST_F(Output, FramesTellWhereRigidBodiesAndWallsAre) {
  const Problem problem = read_problem_text(turning_tool, "turning.toml");
  const auto simulation = Simulation::create(problem, 1);
  while (!simulation->finished()) simulation->step(simulation->end_time());
  const double t = simulation->time();
  write_vtp(folder / "f.vtp", simulation->particles());
  const PointFrame frame = read_vtp(folder / "f.vtp");
  const std::vector<RigidShape> shapes = rigid_shapes(problem, frame);
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].name, "tool");
  EXPECT_EQ(shapes[0].body, 1);
  EXPECT_NEAR(shapes[0].place.centre[1], 5.5 + t * t, 1e-12);
  EXPECT_NEAR(shapes[0].place.turn[3], std::sin(1.2 * t), 1e-12);
  // Each particle of the tool lies in its shape as drawn, less than its size from where the shape's edge would be.
  const RigidView tool(shapes[0], 1, 0);
  for (std::size_t p = 0; p < frame.positions.size() / 3; ++p)
    EXPECT_EQ(tool.cover(frame.positions[3 * p], frame.positions[3 * p + 1], 0) == RigidView::Cover::all, frame.fields[1].values[p] == 1);
  const RigidView floor(shapes[1], 1, 0), drum(shapes[2], 1, 0);
  EXPECT_EQ(floor.cover(3, 0.5 - 0.2 * t - 1e-6, 0), RigidView::Cover::all);
  EXPECT_EQ(floor.cover(3, 0.5 - 0.2 * t + 1e-6, 0), RigidView::Cover::none);
  EXPECT_EQ(drum.cover(5, 5, 4), RigidView::Cover::none);
  EXPECT_EQ(drum.cover(5 + 4.51 * 0.6, 5 + 4.51 * 0.8, 0), RigidView::Cover::all);
  // The whole drum is in the picture, and no part of the endless floor decides.
  const PictureExtent extent = picture_extent({&frame, nullptr, shapes}, {.quantity = "velocity_y"});
  EXPECT_NEAR(extent.window[0], 0.5, 1e-12);
  EXPECT_NEAR(extent.window[3], 9.5, 1e-12);
  PointFrame old = frame;
  old.rigid.clear();
  EXPECT_TRUE(rigid_shapes(problem, old).empty()) << "frames of older versions do not tell";
}

TEST_F(Output, PicturesOfASeriesShareWindowAndRange) {
  const PointFrame early = lattice({0, 0}, 3, 3, 1, 0, 5), late = lattice({4, 1}, 3, 3, 1, 2, 9);
  PointFrame none = lattice({0, 0}, 0, 0, 1, 0, 0);
  DrawOptions options{.quantity = "signal"};
  PictureExtent extent;
  for (const PointFrame* frame : {&early, &late, static_cast<const PointFrame*>(&none)}) extent.include(picture_extent({frame}, options));
  options.extent = extent;
  const PictureMap a = draw_frame({&early}, options, folder / "a.png"), b = draw_frame({&late}, options, folder / "b.png");
  const PictureMap c = draw_frame({&none}, options, folder / "c.png");
  for (const PictureMap* map : {&a, &b, &c}) {
    EXPECT_EQ(map->lowest, 0);
    EXPECT_EQ(map->highest, 9);
    EXPECT_EQ(map->panels[0].x_lowest, a.panels[0].x_lowest);
    EXPECT_EQ(map->panels[0].scale, a.panels[0].scale);
    EXPECT_EQ(map->width, a.width);
    EXPECT_EQ(map->height, a.height);
  }
  // Without any body at all the grid is drawn.
  EXPECT_THROW(draw_frame({&none}, {.quantity = "signal"}, folder / "d.png"), std::invalid_argument);
  const PictureMap grid = draw_frame({&none}, {.quantity = "signal", .grid = {{0, 2, 0, 1}}}, folder / "d.png");
  EXPECT_NEAR(grid.panels[0].x_lowest, 0, 1e-12);
}

// A path of vertices one apart along y = up, whose number `first` and those after it up to `last` lay there at the start.
CrackFrame crack_along(double up, int vertices, int first, int last, CrackFrame& start) {
  CrackFrame c;
  c.names = start.names = {"notch"};
  c.fields = {{"tip_status", "1", 1, {}}};
  for (int v = 0; v < vertices; ++v) {
    const bool is_old = v >= first && v <= last;
    for (auto* points : {&c.plane, &c.upper, &c.lower, &c.original}) points->insert(points->end(), {1. + v, up, 0.});
    if (is_old) start.plane.insert(start.plane.end(), {1. + v, up, 0.});
    c.fields[0].values.push_back(std::nan(""));
  }
  start.original = start.plane;
  c.begin = {0, vertices};
  start.begin = {0, last + 1 - first};
  return c;
}

TEST_F(Output, CracksShowWhatHasGrownAndTheirTips) {
  const PointFrame frame = lattice({0, 0}, 12, 12, 1, 0, 1);
  CrackFrame start;
  CrackFrame crack = crack_along(6.5, 9, 2, 5, start);  // from 1 to 9; 3 to 6 at the start
  crack.fields[0].values.set(0, static_cast<double>(TipStatus::left));
  crack.fields[0].values.set(8, static_cast<double>(TipStatus::grows));
  const DrawOptions options{.quantity = "signal", .tip_names = true};
  PictureMap map = draw_frame({&frame, &crack, {}, &start}, options, folder / "g.png");
  expect_readable(map.texts, map.width, map.height, "crack with a tip");
  for (const char* text : {"notch end", "crack", "grown", "tip"}) EXPECT_TRUE(shows(map.texts, text)) << text;
  EXPECT_FALSE(shows(map.texts, "notch start")) << "that one has left the body";
  const Pixels pixels(folder / "g.png");
  const auto seen = [&](double x) {
    const auto at = map.panels[0].pixel(x, 6.5);
    return pixels.at(at[0], at[1]);
  };
  for (const double x : {1.5, 2.5, 6.5, 8.2}) test::expect_colour(seen(x), grown_colour, fmt::format("grown, at {}", x));
  for (const double x : {3.5, 5.5}) test::expect_colour(seen(x), {0, 0, 0}, fmt::format("there at the start, at {}", x));
  test::expect_colour(seen(9), {1, 1, 1}, "the mark of a tip");
  test::expect_colour(seen(1.1), grown_colour, "no mark where the tip has left");

  // Without an earlier frame, or without growth, a crack is black.
  map = draw_frame({&frame, &crack}, options, folder / "n.png");
  const Pixels without(folder / "n.png");
  const auto at = map.panels[0].pixel(8.2, 6.5);
  test::expect_colour(without.at(at[0], at[1]), {0, 0, 0}, "no start to compare with");
  EXPECT_FALSE(shows(map.texts, "grown"));
  EXPECT_TRUE(shows(map.texts, "tip"));
  // A crack that was not there at the start has grown as a whole.
  start.names = {"another"};
  map = draw_frame({&frame, &crack, {}, &start}, options, folder / "w.png");
  const auto middle = map.panels[0].pixel(4.5, 6.5);
  test::expect_colour(Pixels(folder / "w.png").at(middle[0], middle[1]), grown_colour, "new");
  // Names are written where they are asked for, and cracks without tips need no key.
  map = draw_frame({&frame, &crack}, {.quantity = "signal"}, folder / "o.png");
  EXPECT_FALSE(shows(map.texts, "notch end"));
  crack.fields.clear();
  map = draw_frame({&frame, &crack}, options, folder / "c.png");
  EXPECT_FALSE(shows(map.texts, "tip") || shows(map.texts, "crack"));
}

TEST_F(Output, NamesOfManyTipsNeverCollide) {
  PointFrame frame = lattice({0, 0}, 12, 12, 1, 0, 1);
  CrackFrame many;
  many.fields = {{"tip_status", "1", 1, {}}};
  for (int k = 0; k < 12; ++k) {  // a star: all begin near the middle, some end at the edge
    const double angle = 0.5 * k, x = std::cos(angle), y = std::sin(angle);
    for (const double r : {0.3, 0.5 * (k + 1)}) many.plane.insert(many.plane.end(), {6 + r * x, 6 + r * y, 0.});
    many.names.push_back(fmt::format("crack number {}", k));
    many.begin.push_back(2 * (k + 1));
    many.fields[0].values.push_back(static_cast<double>(TipStatus::waits));
    many.fields[0].values.push_back(static_cast<double>(TipStatus::arrested));
  }
  many.upper = many.lower = many.original = many.plane;
  for (const int width : {200, 500, 1200}) {
    for (const std::size_t panels : {1u, 4u}) {
      const DrawOptions options{.quantity = "signal", .tip_names = true, .title = "Many tips", .width = width, .max_height = 900};
      const PictureMap map = draw_panel(std::vector<Snapshot>(panels, {&frame, &many}), options, folder / "m.png");
      expect_readable(map.texts, map.width, map.height, fmt::format("{} panels, width {}", panels, width));
      EXPECT_TRUE(shows(map.texts, "tip"));
      for (const DrawnText& text : map.texts) {
        if (!text.text.starts_with("crack number")) continue;
        EXPECT_TRUE(std::any_of(map.panels.begin(), map.panels.end(), [&](const PictureMap::Panel& p) {
          return text.box.left >= p.left && text.box.right() <= p.left + p.width && text.box.top >= p.top &&
                 text.box.bottom() <= p.top + p.height;
        })) << text.text;
      }
    }
  }
}

TEST_F(Output, AxesOfPlotsNameTheirQuantity) {
  History history;
  history.columns = {{"time", "s"},           {"kinetic_energy", "J"}, {"strain_energy", "J"}, {"load_work", "J"},
                     {"reaction_y.top", "N"}, {"reaction_x.top", "N"}, {"ratio", ""},          {"other", ""}};
  history.values.assign(8, {0, 1, 3});
  const auto drawn = [&](const std::vector<std::string>& columns) { return plot_history(history, columns, {}, folder / "p.png").texts; };
  EXPECT_TRUE(shows(drawn({"kinetic_energy"}), "kinetic energy (J)"));
  EXPECT_TRUE(shows(drawn({"kinetic_energy", "strain_energy"}), "energy (J)"));
  EXPECT_TRUE(shows(drawn({"kinetic_energy", "load_work"}), "energy (J)"));
  EXPECT_TRUE(shows(drawn({"reaction_y.top", "reaction_x.top"}), "force (N)"));
  EXPECT_TRUE(shows(drawn({"ratio", "other"}), "ratio, other"));
  EXPECT_TRUE(shows(drawn({"ratio"}), "time (s)"));
}

}  // namespace
}  // namespace crampon
