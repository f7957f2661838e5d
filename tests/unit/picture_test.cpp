// Pictures and plots show what they should, pixel by pixel.

#include <cmath>
#include <limits>

#include "crampon/output/history.hpp"
#include "crampon/picture/display_scale.hpp"
#include "crampon/picture/draw.hpp"
#include "crampon/picture/plot.hpp"
#include "output_cases.hpp"
#include "png_pixels.hpp"

#if defined(__SANITIZE_ADDRESS__)
// Fontconfig keeps its tables to the end of the process.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace crampon {
namespace {

using test::expect_colour, test::Pixels;

TEST(DisplayScale, PrefixesAndPowers) {
  const auto shown = [](double v, const char* unit) { return quantity_text(v, std::abs(v), unit); };
  EXPECT_EQ(shown(0.1e6, "Pa"), "100 kPa");
  EXPECT_EQ(shown(1e6, "Pa"), "1 MPa");
  EXPECT_EQ(shown(999e3, "Pa"), "999 kPa");
  EXPECT_EQ(shown(-2.5e-4, "m"), "−250 µm");
  EXPECT_EQ(shown(1.25e-3, "s"), "1.25 ms");
  EXPECT_EQ(shown(0.367, "kg"), "367 g");
  EXPECT_EQ(shown(2.5, "kg"), "2.5 kg");
  EXPECT_EQ(shown(0.002, "N"), "2 mN");
  EXPECT_EQ(shown(12, "m/s"), "12 m/s");
  EXPECT_EQ(shown(2e-6, "m2"), "2 ×10⁻⁶ m²");
  EXPECT_EQ(shown(0.5, ""), "0.5");
  EXPECT_EQ(shown(0, "s"), "0 s");
}

TEST(DisplayScale, TicksAreRoundAndInside) {
  const Ticks t = round_ticks(-0.03, 0.31, 8);
  EXPECT_DOUBLE_EQ(t.step, 0.05);
  ASSERT_EQ(t.at.size(), 7u);  // 0 to 0.3
  EXPECT_NEAR(t.at.front(), 0, 1e-15);
  EXPECT_NEAR(t.at.back(), 0.3, 1e-15);
  EXPECT_EQ(round_ticks(0, 1, 5).at.size(), 6u) << "both ends are kept in spite of round-off";
  EXPECT_EQ(tick_label(-0.25, 0.05), "−0.25");
  EXPECT_EQ(tick_label(-1e-18, 0.05), "0.00");
  EXPECT_EQ(tick_label(200, 100), "200");
}

TEST(Palette, UniformPaletteHasEqualStepsAndRisingLightness) {
  const int steps = 64;
  double shortest = INFINITY, longest = 0;
  OkLab last = oklab_from_srgb(palette_colour(Palette::uniform, 0));
  for (int k = 1; k <= steps; ++k) {
    const OkLab now = oklab_from_srgb(palette_colour(Palette::uniform, double(k) / steps));
    const double step = std::hypot(now.lightness - last.lightness, now.a - last.a, now.b - last.b);
    shortest = std::min(shortest, step);
    longest = std::max(longest, step);
    EXPECT_GT(now.lightness, last.lightness) << "a reader without colour vision sees the order";
    last = now;
  }
  // Equal arc length; chords and the table's 512 entries account for a per cent, colours clipped to the gamut would for far more.
  EXPECT_LT(longest / shortest, 1.02);
  const OkLab low = oklab_from_srgb(palette_colour(Palette::diverging, 0)), high = oklab_from_srgb(palette_colour(Palette::diverging, 1));
  EXPECT_NEAR(low.lightness, high.lightness, 0.01);  // one step of the least bright channel
  const Colour grey = palette_colour(Palette::grey, 0.25);
  EXPECT_EQ(grey.red, 0.25);
  EXPECT_EQ(grey.blue, 0.25);
}

PointFrame one_stress(const std::array<double, 6>& stress) {
  PointFrame f;
  f.positions = {0, 0, 0};
  f.fields = {{"stress", "Pa", 6, std::vector<double>(stress.begin(), stress.end())}, {"velocity", "m/s", 3, {2, -3, 6}}};
  return f;
}

TEST(Quantities, DerivedValuesByHand) {
  const PointFrame f = one_stress({30e6, 10e6, -4e6, 5e6, 0, 0});
  EXPECT_EQ(evaluate_quantity(f, "velocity").values[0], 7);
  EXPECT_EQ(evaluate_quantity(f, "velocity_magnitude").values[0], 7);
  EXPECT_EQ(evaluate_quantity(f, "velocity_y").values[0], -3);
  EXPECT_EQ(evaluate_quantity(f, "stress_xy").values[0], 5e6);
  EXPECT_EQ(evaluate_quantity(f, "pressure").values[0], -12e6);
  // Half the sum of squared differences: (20^2 + 14^2 + 34^2)/2 = 876, plus 3 x 25.
  EXPECT_DOUBLE_EQ(evaluate_quantity(f, "von_mises").values[0], std::sqrt(951.) * 1e6);
  // N03 Eq. 23 with the stress difference sqrt(20^2 + 4 x 5^2) = sqrt(500) MPa.
  EXPECT_NEAR(evaluate_quantity(f, "fringes").values[0], std::cos(0.0889 * std::sqrt(500.)), 1e-14);
  EXPECT_EQ(evaluate_quantity(one_stress({5e6, 5e6, 0, 0, 0, 0}), "fringes").values[0], 1);
  // Half a fringe: k_f times the difference is pi.
  const double half = 1e6 * 3.14159265358979324 / 0.0889;
  EXPECT_NEAR(evaluate_quantity(one_stress({half, 0, 0, 0, 0, 0}), "fringes").values[0], -1, 1e-14);
  EXPECT_TRUE(contains(message_of([&] { evaluate_quantity(f, "vonmises"); }), "did you mean \"von_mises\""));
  EXPECT_TRUE(contains(message_of([&] { evaluate_quantity(f, "stress"); }), "stress_xx"));
  EXPECT_TRUE(contains(message_of([&] { evaluate_quantity(PointFrame{}, "fringes"); }), "needs the field \"stress\""));
}

// A line is at least two pixels wide; antialiasing leaves one of its own colour within a pixel of the place.
void expect_line(const Pixels& pixels, const std::array<double, 2>& at, const Colour& wanted, const std::string& what) {
  int nearest = 1000;
  for (const double offset : {-1., 0., 1.}) {
    const std::array<int, 3> seen = pixels.at(at[0], at[1] + offset);
    const int distance = static_cast<int>(
        std::max({std::abs(seen[0] - 255 * wanted.red), std::abs(seen[1] - 255 * wanted.green), std::abs(seen[2] - 255 * wanted.blue)}));
    nearest = std::min(nearest, distance);
  }
  EXPECT_LE(nearest, 8) << what;  // cairo's coverage counts in 1/15 of a pixel or finer; the next curve or the paper is 90 away
}

constexpr Colour white{1, 1, 1};

// A block of 8 x 8 particles of 1 mm, value x + 10 y in Pa; the two halves moved apart by `gap` along a crack at y = 4 mm.
PointFrame block(double gap) {
  PointFrame f;
  f.cell = 2e-3;
  f.time = 1e-3;
  f.fields = {{"id", "", 1, {}}, {"signal", "Pa", 1, {}}, {"displacement", "m", 3, {}}};
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      const double u = j < 4 ? -gap / 2 : gap / 2;
      for (const double x : {(i + 0.5) * 1e-3, (j + 0.5) * 1e-3 + u, 0.}) f.positions.push_back(x);
      for (const double size : {1e-3, 1e-3, 1e-3}) f.particle_size.push_back(size);
      f.fields[0].values.push_back(8. * j + i);
      f.fields[1].values.push_back(i + 10. * j);
      for (const double v : {0., u, 0.}) f.fields[2].values.push_back(v);
    }
  }
  return f;
}

CrackFrame crack_through_block(double gap) {
  CrackFrame c;
  c.time = 1e-3;
  c.names = {"crack"};
  for (const double x : {0., 4e-3, 8e-3}) {
    for (const double v : {x, 4e-3, 0.}) c.plane.push_back(v);
    for (const double v : {x, 4e-3 + gap / 2, 0.}) c.upper.push_back(v);
    for (const double v : {x, 4e-3 - gap / 2, 0.}) c.lower.push_back(v);
  }
  c.begin = {0, 3};
  c.original = c.plane;
  return c;
}

TEST_F(Output, PictureShowsEachParticleInItsColour) {
  const PointFrame frame = block(0);
  for (const Palette palette : {Palette::uniform, Palette::grey}) {
    const PictureMap map = draw_frame({&frame, nullptr}, {.quantity = "signal", .palette = palette}, folder / "p.png");
    const Pixels pixels(folder / "p.png");
    EXPECT_EQ(pixels.width, map.width);
    EXPECT_EQ(pixels.height, map.height);
    EXPECT_EQ(map.lowest, 0);
    EXPECT_EQ(map.highest, 77);
    for (std::size_t i = 0; i < 64; ++i) {
      const double value = frame.fields[1].values[i];
      // Three places in the square: a body looks solid.
      for (const double offset : {-0.45e-3, 0., 0.45e-3}) {
        const auto at = map.panels[0].pixel(frame.positions[3 * i] + offset, frame.positions[3 * i + 1] - offset);
        expect_colour(pixels.at(at[0], at[1]), palette_colour(palette, value / 77), "particle " + std::to_string(i));
      }
    }
    const auto outside = map.panels[0].pixel(-0.15e-3, 4e-3);
    expect_colour(pixels.at(outside[0], outside[1]), white, "beside the body");
  }
}

TEST_F(Output, OpenCrackIsWhiteBetweenItsSurfacesAndClosedOneALine) {
  const double gap = 1e-3;
  const CrackFrame open = crack_through_block(gap), closed = crack_through_block(0);
  // Particles drawn without displacement would cover the gap: the white comes from the crack itself.
  const PointFrame frame = block(0);
  PictureMap map = draw_frame({&frame, &open}, {.quantity = "signal"}, folder / "open.png");
  const Pixels with_gap(folder / "open.png");
  for (const double y : {3.7e-3, 4e-3, 4.3e-3}) {
    const auto at = map.panels[0].pixel(5.5e-3, y);
    expect_colour(with_gap.at(at[0], at[1]), white, "in the gap");
  }
  const auto surface = map.panels[0].pixel(5.5e-3, 4.5e-3);
  expect_line(with_gap, surface, {0, 0, 0}, "upper surface");
  const auto body = map.panels[0].pixel(5.5e-3, 5.5e-3);
  expect_colour(with_gap.at(body[0], body[1]), map.colour(5 + 10 * 5), "above the crack");

  map = draw_frame({&frame, &closed}, {.quantity = "signal"}, folder / "closed.png");
  const Pixels without(folder / "closed.png");
  const auto line = map.panels[0].pixel(5.5e-3, 4e-3);
  expect_line(without, line, {0, 0, 0}, "closed crack");
  const auto near = map.panels[0].pixel(5.5e-3, 4.3e-3);
  expect_colour(without.at(near[0], near[1]), map.colour(5 + 10 * 4), "beside the closed crack");

  // Surfaces that overlap leave no gap to fill.
  const CrackFrame overlapping = crack_through_block(-gap);
  map = draw_frame({&frame, &overlapping}, {.quantity = "signal"}, folder / "overlap.png");
  const auto middle = map.panels[0].pixel(5.5e-3, 4.25e-3);
  expect_colour(Pixels(folder / "overlap.png").at(middle[0], middle[1]), map.colour(5 + 10 * 4), "between overlapping surfaces");
}

TEST_F(Output, MagnifiedDisplacementsMoveParticlesAndCracks) {
  const double gap = 0.2e-3;
  const PointFrame frame = block(gap);
  CrackFrame crack = crack_through_block(gap);
  const DrawOptions options{.quantity = "signal", .magnification = 10};
  const PictureMap map = draw_frame({&frame, &crack}, options, folder / "m.png");
  const Pixels pixels(folder / "m.png");
  const auto gap_at = map.panels[0].pixel(5.5e-3, 4.8e-3);  // the gap reaches from 3 to 5 mm
  expect_colour(pixels.at(gap_at[0], gap_at[1]), white, "magnified gap");
  const auto particle = map.panels[0].pixel(5.5e-3, 5.5e-3);  // the row of y = 4.5 mm, moved by 1 mm
  expect_colour(pixels.at(particle[0], particle[1]), map.colour(5 + 10 * 4), "moved particle");
  crack.original.clear();
  EXPECT_THROW(draw_frame({&frame, &crack}, options, folder / "n.png"), std::invalid_argument);
  PointFrame without = frame;
  without.fields.pop_back();
  const std::string message = message_of([&] { draw_frame({&without, nullptr}, options, folder / "n.png"); });
  EXPECT_TRUE(contains(message, "need the field \"displacement\"")) << message;
  EXPECT_FALSE(fs::exists(folder / "n.png"));
}

TEST_F(Output, StretchedParticlesFillTheirDeformedSize) {
  PointFrame f;
  f.cell = 2e-3;
  f.positions = {0, 0, 0};
  f.particle_size = {1e-3, 1e-3, 1e-3};
  f.fields = {{"signal", "", 1, {1}}, {"deformation_gradient", "", 9, {3, 0, 0, 0, 1, 0, 0, 0, 1}}};
  const DrawOptions options{.quantity = "signal", .window = {{-3e-3, 3e-3, -2e-3, 2e-3}}};
  PictureMap map = draw_frame({&f, nullptr}, options, folder / "f.png");
  const auto inside = map.panels[0].pixel(1.4e-3, 0.4e-3), beyond = map.panels[0].pixel(1.6e-3, 0), above = map.panels[0].pixel(0, 0.6e-3);
  const Pixels pixels(folder / "f.png");
  expect_colour(pixels.at(inside[0], inside[1]), map.colour(1), "stretched along x");
  expect_colour(pixels.at(beyond[0], beyond[1]), white, "beyond its end");
  expect_colour(pixels.at(above[0], above[1]), white, "not stretched along y");
}

TEST_F(Output, FringePictureIsDarkAndBrightByTheFormula) {
  const double half = 1e6 * 3.14159265358979324 / 0.0889;  // dark: cos = -1
  PointFrame f;
  f.cell = 1e-3;
  DataArray stress{"stress", "Pa", 6, {}};
  const std::vector<double> differences{0, half / 2, half, 2 * half};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double x : {static_cast<double>(i) * 1e-3, 0., 0.}) f.positions.push_back(x);
    for (int k = 0; k < 3; ++k) f.particle_size.push_back(1e-3);
    for (const double s : {0., 0., 0., differences[i] / 2, 0., 0.}) stress.values.push_back(s);  // in shear: 4 sxy^2
  }
  f.fields = {stress};
  const PictureMap map = draw_frame({&f, nullptr}, {.quantity = "fringes"}, folder / "f.png");
  const Pixels pixels(folder / "f.png");
  const std::vector<double> brightness{1, 0.5, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = map.panels[0].pixel(static_cast<double>(i) * 1e-3, 0);
    expect_colour(pixels.at(at[0], at[1]), {brightness[i], brightness[i], brightness[i]}, "fringe " + std::to_string(i));
  }
}

TEST_F(Output, PanelSharesColoursAndWindow) {
  const PointFrame a = block(0);
  PointFrame b = block(0);
  for (std::size_t i = 0; i < b.fields[1].values.size(); ++i) b.fields[1].values.set(i, -2 * b.fields[1].values[i]);
  b.positions.set(0, std::numeric_limits<double>::quiet_NaN());         // left out
  b.fields[1].values.set(9, std::numeric_limits<double>::quiet_NaN());  // shown as such
  DrawOptions options{.quantity = "signal", .range = ColourRange::symmetric, .title = "panel", .columns = 2};
  const PictureMap map = draw_panel({{&a, nullptr}, {&b, nullptr}, {&a, nullptr}}, options, folder / "p.png");
  ASSERT_EQ(map.panels.size(), 3u);
  EXPECT_EQ(map.palette, Palette::diverging);
  EXPECT_EQ(map.lowest, -154);
  EXPECT_EQ(map.highest, 154);
  EXPECT_EQ(map.panels[0].top, map.panels[1].top);
  EXPECT_EQ(map.panels[0].left, map.panels[2].left);
  EXPECT_GT(map.panels[2].top, map.panels[0].top + map.panels[0].height);
  const Pixels pixels(folder / "p.png");
  const auto at_a = map.panels[0].pixel(7.5e-3, 7.5e-3), at_b = map.panels[1].pixel(7.5e-3, 7.5e-3);
  expect_colour(pixels.at(at_a[0], at_a[1]), palette_colour(Palette::diverging, 0.75), "half of the highest");
  expect_colour(pixels.at(at_b[0], at_b[1]), palette_colour(Palette::diverging, 0), "the lowest");
  const auto missing = map.panels[1].pixel(0.5e-3, 0.5e-3), nan = map.panels[1].pixel(1.5e-3, 1.5e-3);
  expect_colour(pixels.at(missing[0], missing[1]), white, "particle without a position");
  expect_colour(pixels.at(nan[0], nan[1]), {1, 0, 1}, "NaN");
  EXPECT_THROW(draw_panel({}, options, folder / "q.png"), std::invalid_argument);
}

TEST_F(Output, PlotPutsCurvesWhereTheyBelong) {
  Curve flat{"flat", {0, 1, 2}, {5, 5, 5}}, rising{"rising", {0, 1, 2}, {0, 5, 10}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Curve broken{"broken", {0, 0.5, 1, 1.5, 2}, {2, 2, nan, 2, 2}};
  const PlotMap map = plot_profiles({flat, rising, broken}, {.title = "plot", .x_name = "x", .x_unit = "m"}, folder / "p.png");
  const Pixels pixels(folder / "p.png");
  EXPECT_EQ(pixels.width, 1200);
  ASSERT_EQ(map.areas.size(), 1u);
  EXPECT_EQ(map.areas[0].x_highest, 2);
  const auto colour_at = [&](double x, double y) {
    const auto at = map.areas[0].pixel(x, y);
    return pixels.at(at[0], at[1]);
  };
  expect_line(pixels, map.areas[0].pixel(0.3, 5), curve_colours()[0], "flat");
  expect_line(pixels, map.areas[0].pixel(1.63, 8.15), curve_colours()[1], "rising");
  expect_line(pixels, map.areas[0].pixel(0.015, 2), curve_colours()[2], "broken");  // in the middle of the first dash
  expect_colour(colour_at(1.07, 2.05), white, "where the curve is interrupted");
  expect_colour(colour_at(1.37, 8.9), white, "beside the curves");
  EXPECT_THROW(plot_profiles({{"bad", {0, 1}, {0}}}, {}, folder / "q.png"), std::invalid_argument);
  EXPECT_THROW(plot_profiles({}, {}, folder / "q.png"), std::invalid_argument);
}

TEST_F(Output, HistoryPlotStacksUnitsAndJoinsRuns) {
  History one, two;
  one.columns = two.columns = {{"time", "s"}, {"kinetic_energy", "J"}, {"strain_energy", "J"}, {"momentum_x", "kg*m/s"}};
  one.values = {{0, 1, 2}, {1, 2, 3}, {3, 2, 1}, {7, 7, 7}};
  two.values = {{0, 1}, {4, 4}, {0, 0}, {-7, 7}};
  const PlotMap stacked = plot_history(one, {"kinetic_energy", "momentum_x", "strain_energy"}, {}, folder / "s.png");
  ASSERT_EQ(stacked.areas.size(), 2u);
  EXPECT_LT(stacked.areas[0].y_highest, 7) << "the energies are together";
  EXPECT_EQ(stacked.areas[0].left, stacked.areas[1].left);
  const Pixels pixels(folder / "s.png");
  const auto momentum = stacked.areas[1].pixel(0.3, 7), strain = stacked.areas[0].pixel(0.015, 2.985);
  expect_line(pixels, momentum, curve_colours()[1], "momentum");
  expect_line(pixels, strain, curve_colours()[2], "strain energy");
  const PlotMap joined = plot_history({{&one, "kinetic_energy", "one"}, {&two, "kinetic_energy", "two"}}, {}, folder / "j.png");
  ASSERT_EQ(joined.areas.size(), 1u);
  const auto second = joined.areas[0].pixel(0.3, 4);
  expect_line(Pixels(folder / "j.png"), second, curve_colours()[1], "second run");
  EXPECT_THROW(plot_history(one, {"kinetic"}, {}, folder / "k.png"), std::out_of_range);
}

TEST_F(Output, HistoryPlotOfFormulasOverAColumn) {
  History history;
  history.columns = {{"time", "s"}, {"reaction_y.top", "N"}, {"opening.left-most", "m"}};
  history.values = {{0, 1, 2}, {4, 6, 100}, {0, 0, 0}};
  history.add_column({"length", "m"}, "2*time + 1");
  history.add_column({"work", "J"}, "reaction_y.top*length");
  EXPECT_EQ(history.column("length"), (std::vector<double>{1, 3, 5}));
  EXPECT_EQ(history.column("work"), (std::vector<double>{4, 18, 500}));
  const PlotMap map = plot_history({{&history, "work", "", "length"}}, {.x_highest = 4}, folder / "w.png");
  ASSERT_EQ(map.areas.size(), 1u);
  EXPECT_EQ(map.areas[0].x_lowest, 1);
  EXPECT_LT(map.areas[0].y_highest, 30) << "what lies outside sets no range";
  expect_line(Pixels(folder / "w.png"), map.areas[0].pixel(1.3, 6.1), curve_colours()[0], "work over length");

  EXPECT_TRUE(contains(message_of([&] { history.add_column({"work", "J"}, "1"); }), "another name"));
  const std::string message = message_of([&] { history.add_column({"other", "J"}, "work + tame"); });
  EXPECT_TRUE(contains(message, "\"tame\"") && contains(message, "did you mean \"time\"")) << message;
  EXPECT_EQ(history.columns.size(), 5u);
  EXPECT_EQ(history.values.size(), 5u);

  // A name that no formula can hold stands in one all the same, but as a whole.
  history.values[2] = {1, 2, 3};
  history.add_column({"twice", "m"}, "2*opening.left-most - time");
  EXPECT_EQ(history.column("twice"), (std::vector<double>{2, 3, 4}));
  EXPECT_TRUE(contains(message_of([&] { history.add_column({"other", "m"}, "opening.left-mosty"); }), "opening.left"));
}

History of_tips() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  History h;
  h.columns = {{"time", "s"},           {"J.a.start", "J/m2"},       {"J.a.end", "J/m2"},
               {"J.b.end", "J/m2"},     {"K_I.a.end", "Pa m^(1/2)"}, {"K_II.a.end", "Pa m^(1/2)"},
               {"crack_length.a", "m"}, {"crack_length.b", "m"}};
  h.values = {{0, 1, 2, 3}, {1, 1, 1, 1}, {2, nan, 5, nan}, {3, 3, 3, 3}, {1, 2, 3, 4}, {0, 0, 0, 0}, {1, 1, 2, 3}, {7, 7, 7, 7}};
  return h;
}

TEST_F(Output, ColumnsOfTipsArePlottedTogether) {
  const History h = of_tips();
  EXPECT_EQ(h.columns_of("J"), (std::vector<std::string>{"J.a.start", "J.a.end", "J.b.end"}));
  EXPECT_EQ(h.columns_of("J.a.end"), (std::vector<std::string>{"J.a.end"}));
  EXPECT_EQ(h.columns_of("crack_length").size(), 2u);
  EXPECT_TRUE(contains(message_of([&] { h.columns_of("J.c.end"); }), "did you mean \"J.a.end\""));
  EXPECT_TRUE(contains(message_of([&] { h.columns_of("J.of another"); }), "choose from: J.a.start, J.a.end, J.b.end"))
      << "those of the quantity";
  EXPECT_TRUE(contains(message_of([&] { h.columns_of("crack_lenght"); }), "did you mean \"crack_length\""));

  const auto texts_of = [&](const std::vector<std::string>& columns) { return plot_history(h, columns, {}, folder / "p.png").texts; };
  const auto shows = [](const std::vector<DrawnText>& texts, const char* wanted) {
    return std::any_of(texts.begin(), texts.end(), [&](const DrawnText& t) { return t.text == wanted; });
  };
  std::vector<DrawnText> texts = texts_of({"J.a.end", "J.b.end", "K_I.a.end", "K_II.a.end", "crack_length.a"});
  for (const char* text : {"J (J/m²)", "K (Pa √m)", "J, a end", "K_II, a end", "crack length, a"}) EXPECT_TRUE(shows(texts, text)) << text;
  // In an area too low for its name the quantity stands for it, and the legend has the name.
  texts = texts_of({"J.a.end", "K_I.a.end", "crack_length.a", "time"});
  for (const char* text : {"K_I, a end", "crack length, a"}) EXPECT_TRUE(shows(texts, text)) << text;
  // Each curve over a column of its own; the axis is named by what they have in common.
  const PlotMap map = plot_history({{&h, "J.a.end", "", "crack_length.a"}, {&h, "J.b.end", "", "crack_length.b"}}, {}, folder / "o.png");
  EXPECT_TRUE(shows(map.texts, "crack length (m)"));
  EXPECT_THROW(plot_history({{&h, "J.a.end", "", "crack_length.a"}, {&h, "J.b.end", ""}}, {}, folder / "q.png"), std::invalid_argument);
}

TEST_F(Output, GapsOfCurvesAreGapsAndLoneValuesDots) {
  const History h = of_tips();
  const PlotMap map = plot_history(h, {"J.a.end"}, {}, folder / "p.png");
  const Pixels pixels(folder / "p.png");
  for (const auto& [time, value] : {std::pair{0., 2.}, {2., 5.}}) {
    const auto at = map.areas[0].pixel(time, value);
    expect_colour(pixels.at(at[0] + (time == 0 ? 1 : 0), at[1]), curve_colours()[0], "a lone value");
  }
  const auto between = map.areas[0].pixel(1.1, 3.6);
  expect_colour(pixels.at(between[0], between[1]), white, "no line across the gap");
}

TEST(DisplayScale, UnitsAndNamesOfTips) {
  EXPECT_EQ(quantity_text(1.2e6, 1.2e6, "Pa m^(1/2)"), "1.2 MPa √m");
  EXPECT_EQ(spelt_out("K_II.notch.end"), "K_II, notch end");
  EXPECT_EQ(spelt_out("crack_length.left_notch"), "crack length, left notch");
  EXPECT_EQ(spelt_out("mid.velocity_x"), "mid, velocity x");
  EXPECT_EQ(spelt_out("1.5 times the load"), "1.5 times the load");
  EXPECT_EQ(spelt_out("cohesive_loss_II"), "cohesive loss II");
}

}  // namespace
}  // namespace crampon
