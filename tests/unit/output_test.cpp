// What a run writes can be read back, bit for bit; damage and full disks are told; pictures show what they should, pixel by pixel.

#include <csignal>
#include <fcntl.h>
#include <png.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "crampon/output/display_scale.hpp"
#include "crampon/output/draw.hpp"
#include "crampon/output/file.hpp"
#include "crampon/output/history.hpp"
#include "crampon/output/plot.hpp"
#include "crampon/output/results_folder.hpp"
#include "crampon/output/run_record.hpp"

#if defined(__SANITIZE_ADDRESS__)
// Fontconfig keeps its tables to the end of the process.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace crampon {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, removed at its end.
class Output : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "crampon_output_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << what << " " << i << ": " << a[i] << " " << b[i];
}

void expect_near_relative(const std::vector<double>& a, const std::vector<double>& b, double tolerance, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(std::abs(a[i] - b[i]), tolerance * std::abs(a[i])) << what << " " << i;
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "nothing was thrown";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Particles with values of all magnitudes, more than one compression block per array.
PointFrame random_frame(std::size_t n) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-30, 30);
  const auto draw = [&] { return mantissa(random) * std::pow(10., exponent(random)); };
  PointFrame f;
  f.time = 0.1 + 0.2;  // has no short decimal form
  f.step = 123456789012;
  f.dimension = 2;
  f.cell = 1. / 3;
  f.fields = {{"id", "", 1, {}}, {"body", "", 1, {}}, {"stress", "Pa", 6, {}}, {"velocity", "m/s", 3, {}}, {"a<b & \"c\"", "1/s", 1, {}}};
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) f.positions.push_back(draw());
    for (int k = 0; k < 3; ++k) f.particle_size.push_back(std::abs(draw()));
    f.fields[0].values.push_back(static_cast<double>(16777217 + i));  // not a whole number in single precision
    f.fields[1].values.push_back(static_cast<double>(i % 3));
    for (int k = 0; k < 6; ++k) f.fields[2].values.push_back(draw());
    for (int k = 0; k < 3; ++k) f.fields[3].values.push_back(draw());
    f.fields[4].values.push_back(draw());
  }
  return f;
}

CrackFrame two_cracks() {
  CrackFrame c;
  c.time = 1e-3;
  c.step = 42;
  c.names = {"left \"<é>\"", "right"};
  c.begin = {0, 3, 5};
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::vector<double>* part : {&c.plane, &c.upper, &c.lower, &c.original})
    for (int i = 0; i < 15; ++i) part->push_back(uniform(random));
  c.fields = {{"opening", "m", 1, {1e-6, 2e-6, 3e-6, 0, -1e-9}}, {"sliding", "m", 1, {0, 0.1, 0.2, 0.3, 0.4}}};
  return c;
}

TEST_F(Output, PointFrameKeepsEveryBitInFullPrecision) {
  PointFrame written = random_frame(30000);
  written.fields[3].values[1] = -0.;
  written.fields[3].values[2] = std::numeric_limits<double>::quiet_NaN();
  written.fields[3].values[3] = std::numeric_limits<double>::infinity();
  written.fields[3].values[4] = std::numeric_limits<double>::denorm_min();
  write_vtp(folder / "p.vtp", written, Precision::full);
  const PointFrame read = read_vtp(folder / "p.vtp");
  expect_same_bits({written.time, written.cell}, {read.time, read.cell}, "time and cell");
  EXPECT_EQ(written.step, read.step);
  EXPECT_EQ(written.dimension, read.dimension);
  expect_same_bits(written.positions, read.positions, "positions");
  expect_same_bits(written.particle_size, read.particle_size, "sizes");
  ASSERT_EQ(written.fields.size(), read.fields.size());
  for (std::size_t k = 0; k < read.fields.size(); ++k) {
    EXPECT_EQ(written.fields[k].name, read.fields[k].name);
    EXPECT_EQ(written.fields[k].unit, read.fields[k].unit);
    EXPECT_EQ(written.fields[k].components, read.fields[k].components);
    expect_same_bits(written.fields[k].values, read.fields[k].values, read.fields[k].name);
  }
  EXPECT_FALSE(fs::exists(folder / "p.vtp.partial"));
}

TEST_F(Output, SinglePrecisionIsWithinItsRoundingAndKeepsIds) {
  const PointFrame written = random_frame(1000);
  write_vtp(folder / "p.vtp", written, Precision::single);
  const PointFrame read = read_vtp(folder / "p.vtp");
  const double tolerance = 6e-8;  // half a unit in the last of 24 bits: 2^-24 = 5.96e-8
  expect_near_relative(written.positions, read.positions, tolerance, "positions");
  for (std::size_t k = 2; k < 5; ++k) expect_near_relative(written.fields[k].values, read.fields[k].values, tolerance, "field");
  expect_same_bits(written.fields[0].values, read.fields[0].values, "id");
  expect_same_bits({written.time}, {read.time}, "time");
  EXPECT_LT(fs::file_size(folder / "p.vtp"), 4 * 18 * 1000);  // 15 floats and two small integers a particle, cells included
}

TEST_F(Output, EmptyFramesAreFiles) {
  write_vtp(folder / "p.vtp", PointFrame{});
  EXPECT_TRUE(read_vtp(folder / "p.vtp").positions.empty());
  write_vtp(folder / "c.vtp", CrackFrame{});
  EXPECT_TRUE(read_crack_vtp(folder / "c.vtp").names.empty());
}

TEST_F(Output, CrackFrameRoundTrip) {
  const CrackFrame written = two_cracks();
  for (const Precision precision : {Precision::full, Precision::single}) {
    write_vtp(folder / "c.vtp", written, precision);
    const CrackFrame read = read_crack_vtp(folder / "c.vtp");
    EXPECT_EQ(written.names, read.names);
    EXPECT_EQ(written.begin, read.begin);
    EXPECT_EQ(written.step, read.step);
    expect_same_bits({written.time}, {read.time}, "time");
    const double tolerance = precision == Precision::full ? 0 : 6e-8;  // 2^-24
    expect_near_relative(written.plane, read.plane, tolerance, "plane");
    expect_near_relative(written.upper, read.upper, tolerance, "upper");
    expect_near_relative(written.lower, read.lower, tolerance, "lower");
    expect_near_relative(written.original, read.original, tolerance, "original");
    ASSERT_EQ(read.fields.size(), 2u);
    EXPECT_EQ(read.fields[1].name, "sliding");
    EXPECT_EQ(read.fields[1].unit, "m");
    expect_near_relative(written.fields[0].values, read.fields[0].values, tolerance, "opening");
  }
}

TEST_F(Output, FieldOfWrongLengthIsRefusedAndNothingWritten) {
  PointFrame frame = random_frame(4);
  frame.fields[2].values.pop_back();
  EXPECT_TRUE(contains(message_of([&] { write_vtp(folder / "p.vtp", frame); }), "\"stress\" has 23 values"));
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Output, EveryFlippedBitAndEveryCutIsDetected) {
  const fs::path path = folder / "p.vtp";
  write_vtp(path, random_frame(20), Precision::full);
  const std::string good = read_file(path);
  std::mt19937 random(3);
  for (int trial = 0; trial < 400; ++trial) {
    std::string bad = good;
    const std::size_t at = random() % (bad.size() - 1);  // the last byte is a line break
    bad[at] = static_cast<char>(bad[at] ^ (1 << (random() % 8)));
    write_file(path, bad);
    const std::string message = message_of([&] { read_vtp(path); });
    ASSERT_TRUE(contains(message, path.string() + ": damaged file")) << at << ": " << message;
  }
  for (std::size_t length = 0; length < good.size(); length += 97) {
    write_file(path, std::string_view(good).substr(0, length));
    ASSERT_TRUE(contains(message_of([&] { read_vtp(path); }), "damaged file")) << length;
  }
  EXPECT_TRUE(contains(message_of([&] { read_vtp(folder / "none.vtp"); }), "none.vtp: cannot read: No such file"));
  write_vtp(path, two_cracks());
  EXPECT_TRUE(contains(message_of([&] { read_vtp(path); }), "not a file of the expected kind"));
  write_vtp(path, random_frame(3));
  EXPECT_TRUE(contains(message_of([&] { read_crack_vtp(path); }), "not a file of the expected kind"));
}

TEST_F(Output, PvdListsFramesAfterEachAppend) {
  PvdSeries series(folder / "particles.pvd");
  EXPECT_FALSE(fs::exists(folder / "particles.pvd"));
  series.append(0, "particles/a.vtp");
  EXPECT_EQ(read_pvd(folder / "particles.pvd").size(), 1u);
  series.append(0.1 + 0.2, "particles/b.vtp");
  const std::vector<PvdEntry> read = read_pvd(folder / "particles.pvd");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].time, 0.1 + 0.2);
  EXPECT_EQ(read[1].file, "particles/b.vtp");
  write_file(folder / "particles.pvd", read_file(folder / "particles.pvd").substr(0, 150));
  EXPECT_TRUE(contains(message_of([&] { read_pvd(folder / "particles.pvd"); }), "ends too early"));
}

TEST_F(Output, HistoryRowsAreOnDiskAtOnceAndKeepEveryBit) {
  const fs::path path = folder / "history.csv";
  const std::vector<HistoryColumn> columns{{"time", "s"}, {"kinetic_energy", "J"}, {"opening_max.crack1", "m"}};
  HistoryWriter writer(path, columns);
  const std::vector<std::vector<double>> rows{{0, 0.1 + 0.2, -1e-300}, {1. / 3, std::numeric_limits<double>::quiet_NaN(), 5e-324}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    writer.write_row(rows[k]);
    const History read = read_history(path);  // the writer is still open
    ASSERT_EQ(read.rows(), k + 1);
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::isnan(rows[k][c]))
        EXPECT_TRUE(std::isnan(read.values[c][k]));
      else
        expect_same_bits({rows[k][c]}, {read.values[c][k]}, columns[c].name);
    }
  }
  EXPECT_TRUE(contains(read_file(path), "time[s],kinetic_energy[J],opening_max.crack1[m]\n"));
  EXPECT_THROW(writer.write_row({1, 2}), std::invalid_argument);
  EXPECT_THROW(HistoryWriter(folder / "h2.csv", {{"a,b", ""}}), std::invalid_argument);
}

TEST_F(Output, HistoryOfAKilledRunAndBadLines) {
  const fs::path path = folder / "history.csv";
  write_file(path, "time[s],a[]\n0,1\n1,2\n2,3.5");  // cut within the last number, for all one can tell
  EXPECT_EQ(read_history(path).rows(), 2u);
  write_file(path, "time[s],a[]\n0,1\n1\n");
  EXPECT_TRUE(contains(message_of([&] { read_history(path); }), "history.csv:3: fewer values than columns"));
  write_file(path, "time[s],a[]\n0,1,2\n");
  EXPECT_TRUE(contains(message_of([&] { read_history(path); }), "history.csv:2: more values than columns"));
  write_file(path, "time[s],a[]\n0,x\n");
  EXPECT_TRUE(contains(message_of([&] { read_history(path); }), "history.csv:2: \"x\" is no number"));
  write_file(path, "time,a\n0,1\n");
  EXPECT_TRUE(contains(message_of([&] { read_history(path); }), "is not name[unit]"));
  write_file(path, "");
  EXPECT_TRUE(contains(message_of([&] { read_history(path); }), "no header"));
}

TEST(HistoryLookup, InterpolationAndStatisticsByHand) {
  History h;
  h.columns = {{"time", "s"}, {"energy", "J"}};
  h.values = {{0, 1, 2, 4}, {10, 20, 0, 8}};
  EXPECT_EQ(h.value_at("energy", 1), 20);
  EXPECT_EQ(h.value_at("energy", 0.25), 12.5);
  EXPECT_EQ(h.value_at("energy", 3), 4);
  EXPECT_EQ(h.value_at("energy", 4 * (1 + 1e-12)), 8);
  const HistoryStatistics s = h.statistics("energy", 0.5, 3);
  EXPECT_EQ(s.minimum, 0);
  EXPECT_EQ(s.maximum, 20);
  EXPECT_EQ(s.spread, 20);
  // Trapezoids: 15 to 20 over 0.5, 20 to 0 over 1, 0 to 4 over 1: 8.75 + 10 + 2 = 20.75 over 2.5.
  EXPECT_DOUBLE_EQ(s.mean, 20.75 / 2.5);
  EXPECT_EQ(h.statistics("energy", 2, 2).mean, 0);
  EXPECT_EQ(h.statistics("energy", 0.25, 0.5).minimum, 12.5);
  EXPECT_THROW(h.value_at("energy", 4.1), std::out_of_range);
  EXPECT_THROW(h.value_at("energy", -0.1), std::out_of_range);
  EXPECT_THROW(h.statistics("energy", 3, 2), std::invalid_argument);
  EXPECT_EQ(h.unit("energy"), "J");
  EXPECT_TRUE(contains(message_of([&] { h.column("enegry"); }), "no column \"enegry\"; did you mean \"energy\""));
  EXPECT_TRUE(contains(message_of([&] { h.column("temperature"); }), "choose from: time, energy"));
  h.values[1][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(h.statistics("energy", 0.5, 3).maximum));
}

TEST_F(Output, RunRecordRoundTrip) {
  RunRecord r = describe_program();
  EXPECT_FALSE(r.version.empty());
  EXPECT_TRUE(contains(r.compiler, "."));
  EXPECT_EQ(r.started.size(), std::string("2003-01-01T00:00:00Z").size());
  r.status = "stopped: NaN in step 7";
  r.input = "disks.toml";
  r.title = "quote \" and \xff";  // not UTF-8
  r.threads = 3;
  r.particles = 58017;
  r.steps = 1234567890123;
  r.time_step = 0.1 + 0.2;
  r.end_time = std::numeric_limits<double>::quiet_NaN();
  r.wall_seconds = 1.5;
  r.cpu_seconds = 4.25;
  r.phases = {{"project_momentum", 0.5}, {"move_cracks", 0.25}};
  r.particle_steps_per_second = 1e7 / 3;
  r.peak_memory_bytes = 123e6;
  r.state_hash = 0xfedcba9876543210;
  r.notes = {"3 nodes saw more than two cracks"};
  write_run_record(folder / "run.json", r);
  const RunRecord back = read_run_record(folder / "run.json");
  EXPECT_EQ(back.status, r.status);
  EXPECT_EQ(back.version, r.version);
  EXPECT_EQ(back.instruction_set, r.instruction_set);
  EXPECT_EQ(back.input, r.input);
  EXPECT_EQ(back.threads, 3);
  EXPECT_EQ(back.particles, r.particles);
  EXPECT_EQ(back.steps, r.steps);
  EXPECT_EQ(back.time_step, r.time_step);
  EXPECT_TRUE(std::isnan(back.end_time));
  EXPECT_EQ(back.cpu_seconds, 4.25);
  EXPECT_EQ(back.particle_steps_per_second, r.particle_steps_per_second);
  EXPECT_EQ(back.state_hash, r.state_hash);
  ASSERT_EQ(back.phases.size(), 2u);
  EXPECT_EQ(back.phases[1].name, "move_cracks");
  EXPECT_EQ(back.phases[1].seconds, 0.25);
  EXPECT_EQ(back.notes, r.notes);
  write_file(folder / "run.json", "{\"version\": \"1\"}");
  EXPECT_TRUE(contains(message_of([&] { read_run_record(folder / "run.json"); }), "run.json: damaged run record"));
  EXPECT_GT(used_cpu_seconds(), 0);
  EXPECT_GT(peak_memory_bytes(), 1e6);  // no process with this library is smaller than a megabyte
}

TEST_F(Output, ResultsFolderRefusesAndForceRemovesOnlyItsOwn) {
  const fs::path path = folder / "deep" / "results";
  ResultsFolder first = ResultsFolder::create(path);
  EXPECT_TRUE(fs::is_directory(path));
  EXPECT_NO_THROW(ResultsFolder::create(path)) << "an empty folder holds no results";
  EXPECT_THROW(ResultsFolder::open(path), std::runtime_error);
  for (int k = 0; k < 3; ++k) {
    PointFrame frame = random_frame(2);
    frame.time = k;
    first.write_particles(frame);
    first.write_cracks(two_cracks());
  }
  first.write_grid(random_frame(1));
  first.write_resolved_input("title = \"x\"\n");
  write_file(first.original_input(), "title = \"x\"\n");
  HistoryWriter(first.history(), {{"time", "s"}});
  write_run_record(first.run_record(), describe_program());
  ASSERT_EQ(first.particle_frames().size(), 3u);
  EXPECT_EQ(first.particle_frames()[2].file, "particles/particles_000002.vtp");
  EXPECT_EQ(first.particle_frames()[2].time, 2);
  EXPECT_EQ(ResultsFolder::open(path).read_particles(first.particle_frames()[1]).time, 1);
  EXPECT_EQ(first.read_cracks(first.crack_frames()[0]).step, 42);
  EXPECT_EQ(first.grid_frames().size(), 1u);

  const std::vector<fs::path> foreign{path / "notes.txt", path / "particles" / "particles_best.vtp", path / "particles.png",
                                      path / "cracks" / "cracks_000000.vtp.bak", path / "particles_000000.vtp"};
  for (const fs::path& file : foreign) write_file(file, "mine");
  write_file(path / "grid" / "grid_000001.vtp.partial", "left by a killed run");
  EXPECT_THROW(ResultsFolder::create(path), ResultsExist);
  EXPECT_TRUE(contains(message_of([&] { ResultsFolder::create(path); }), "--force"));
  EXPECT_EQ(first.particle_frames().size(), 3u) << "refusing leaves everything";

  const ResultsFolder second = ResultsFolder::create(path, Overwrite::replace);
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) left.push_back(entry.path());
  EXPECT_TRUE(std::is_permutation(left.begin(), left.end(), foreign.begin(), foreign.end()));
  EXPECT_FALSE(fs::exists(path / "grid")) << "an empty sub-folder goes";
  EXPECT_NO_THROW(ResultsFolder::create(path)) << "foreign files alone are no results";
  EXPECT_TRUE(second.particle_frames().empty());

  write_file(folder / "file", "");
  EXPECT_TRUE(contains(message_of([&] { ResultsFolder::create(folder / "file"); }), "cannot create folder"));
  EXPECT_TRUE(contains(message_of([&] { ResultsFolder::open(folder / "none"); }), "no such results folder"));
}

TEST_F(Output, ForceLeavesLinkedFoldersAlone) {
  const fs::path other = folder / "other", path = folder / "results";
  fs::create_directories(other);
  fs::create_directories(path);
  write_file(other / "particles_000000.vtp", "somebody else's");
  fs::create_directory_symlink(other, path / "particles");
  write_run_record(path / "run.json", describe_program());
  ResultsFolder::create(path, Overwrite::replace);
  EXPECT_FALSE(fs::exists(path / "run.json"));
  EXPECT_TRUE(fs::exists(other / "particles_000000.vtp"));
}

TEST_F(Output, ForceLeavesAloneWhatNoRunWrote) {
  const fs::path path = folder / "mine";
  fs::create_directories(path);
  write_file(path / "history.csv", "my own");
  EXPECT_THROW(ResultsFolder::create(path, Overwrite::replace), ResultsExist);
  write_file(path / "run.json", "{\"program\": \"another\"}");
  EXPECT_TRUE(contains(message_of([&] { ResultsFolder::create(path, Overwrite::replace); }), "no run.json of Crampon"));
  EXPECT_EQ(read_file(path / "history.csv"), "my own");
  // A run's own pictures go with it: they would show the old one.
  write_run_record(path / "run.json", describe_program());
  fs::create_directories(path / "pictures");
  write_file(path / "pictures" / "history.png", "");
  write_file(path / "pictures" / "sketch.svg", "");
  ResultsFolder::create(path, Overwrite::replace);
  EXPECT_FALSE(fs::exists(path / "pictures" / "history.png"));
  EXPECT_TRUE(fs::exists(path / "pictures" / "sketch.svg"));
}

// Lets files grow to a few bytes only, as a disk that fills up within one file.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit small{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    ::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST_F(Output, FailedWriteNamesFileAndReasonAndLeavesTheOldOne) {
  ResultsFolder results = ResultsFolder::create(folder / "r");
  results.write_particles(random_frame(2));
  const std::string series = read_file(results.particles_series());
  write_file(folder / "picture.png", "old picture");
  HistoryWriter history(results.history(), {{"time", "s"}, {"energy", "J"}});
  history.write_row({0, 1});
  const PointFrame big = random_frame(2000);
  std::string frame_error, picture_error, history_error;
  {
    const SmallFiles limit(700);
    frame_error = message_of([&] { results.write_particles(big, Precision::full); });
    picture_error = message_of([&] { draw_frame(big, nullptr, {.quantity = "id"}, folder / "picture.png"); });
    history_error = message_of([&] {
      for (int k = 1; k < 1000; ++k) history.write_row({k + 1. / 3, 2. / 3});
    });
  }
  const std::string failed = (folder / "r" / "particles" / "particles_000001.vtp").string();
  EXPECT_EQ(frame_error, failed + ": cannot write: File too large");
  EXPECT_FALSE(fs::exists(failed));
  EXPECT_FALSE(fs::exists(failed + ".partial"));
  EXPECT_EQ(read_file(results.particles_series()), series);
  EXPECT_EQ(picture_error, (folder / "picture.png").string() + ": cannot write: File too large");
  EXPECT_EQ(read_file(folder / "picture.png"), "old picture");
  EXPECT_EQ(history_error, results.history().string() + ": cannot write: File too large");
  EXPECT_EQ(read_file(results.history()).back(), '\n') << "the row begun is taken back";
  EXPECT_GT(read_history(results.history()).rows(), 5u);  // 700 bytes hold more than five rows of 45
  history.write_row({5000, 1});                           // and once there is room again, rows go on where they stopped
  EXPECT_EQ(read_history(results.history()).values[0].back(), 5000);
  results.write_particles(big);
  EXPECT_EQ(results.particle_frames().size(), 2u);
}

TEST(FullDisk, HistoryOnAFullDeviceSaysSo) {
  EXPECT_EQ(message_of([] { HistoryWriter("/dev/full", {{"time", "s"}}); }), "/dev/full: cannot write: No space left on device");
}

// A real file system of 64 kB, mounted for a child process alone. Exit code 77: this machine does not allow that.
int fill_small_disk(const fs::path& where) {
  const uid_t user = ::getuid();
  const gid_t group = ::getgid();
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return 77;
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
  std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
  if (::mount("none", where.c_str(), "tmpfs", 0, "size=64k") != 0) return 77;
  ResultsFolder results = ResultsFolder::create(where / "r");
  const PointFrame frame = random_frame(60);
  std::string error;
  while (error.empty() && results.particle_frames().size() < 100) {
    try {
      results.write_particles(frame, Precision::full);
    } catch (const std::runtime_error& e) {
      error = e.what();
    }
  }
  if (!contains(error, "No space left on device") || !contains(error, (where / "r").string())) return 1;
  const std::vector<PvdEntry> frames = results.particle_frames();
  if (frames.empty()) return 2;
  for (const PvdEntry& entry : frames)
    if (results.read_particles(entry).positions != frame.positions) return 3;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(where)) {
    if (entry.path().extension() == ".partial") return 4;
    if (entry.path().extension() == ".vtp" && read_vtp(entry.path()).positions != frame.positions) return 5;
  }
  return 0;
}

TEST_F(Output, FullDiskLeavesAllEarlierFramesReadable) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    try {
      ::_exit(fill_small_disk(folder));
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      ::_exit(99);
    }
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no private mounts here; FailedWriteNamesFileAndReason covers the logic";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

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
  f.fields = {{"stress", "Pa", 6, {stress.begin(), stress.end()}}, {"velocity", "m/s", 3, {2, -3, 6}}};
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

// A PNG as 8-bit RGB.
struct Pixels {
  explicit Pixels(const fs::path& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) throw std::runtime_error(image.message);
    image.format = PNG_FORMAT_RGB;
    bytes.resize(PNG_IMAGE_SIZE(image));
    width = static_cast<int>(image.width);
    height = static_cast<int>(image.height);
    png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr);
  }
  std::array<int, 3> at(double x, double y) const {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {bytes.at(i), bytes.at(i + 1), bytes.at(i + 2)};
  }
  std::vector<unsigned char> bytes;
  int width = 0, height = 0;
};

// One step of eight bits: cairo and the test may round a half either way.
void expect_colour(const std::array<int, 3>& seen, const Colour& wanted, const std::string& what) {
  EXPECT_NEAR(seen[0], 255 * wanted.red, 1) << what << " red";
  EXPECT_NEAR(seen[1], 255 * wanted.green, 1) << what << " green";
  EXPECT_NEAR(seen[2], 255 * wanted.blue, 1) << what << " blue";
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
    const PictureMap map = draw_frame(frame, nullptr, {.quantity = "signal", .palette = palette}, folder / "p.png");
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
  PictureMap map = draw_frame(frame, &open, {.quantity = "signal"}, folder / "open.png");
  const Pixels with_gap(folder / "open.png");
  for (const double y : {3.7e-3, 4e-3, 4.3e-3}) {
    const auto at = map.panels[0].pixel(5.5e-3, y);
    expect_colour(with_gap.at(at[0], at[1]), white, "in the gap");
  }
  const auto surface = map.panels[0].pixel(5.5e-3, 4.5e-3);
  expect_line(with_gap, surface, {0, 0, 0}, "upper surface");
  const auto body = map.panels[0].pixel(5.5e-3, 5.5e-3);
  expect_colour(with_gap.at(body[0], body[1]), map.colour(5 + 10 * 5), "above the crack");

  map = draw_frame(frame, &closed, {.quantity = "signal"}, folder / "closed.png");
  const Pixels without(folder / "closed.png");
  const auto line = map.panels[0].pixel(5.5e-3, 4e-3);
  expect_line(without, line, {0, 0, 0}, "closed crack");
  const auto near = map.panels[0].pixel(5.5e-3, 4.3e-3);
  expect_colour(without.at(near[0], near[1]), map.colour(5 + 10 * 4), "beside the closed crack");

  // Surfaces that overlap leave no gap to fill.
  const CrackFrame overlapping = crack_through_block(-gap);
  map = draw_frame(frame, &overlapping, {.quantity = "signal"}, folder / "overlap.png");
  const auto middle = map.panels[0].pixel(5.5e-3, 4.25e-3);
  expect_colour(Pixels(folder / "overlap.png").at(middle[0], middle[1]), map.colour(5 + 10 * 4), "between overlapping surfaces");
}

TEST_F(Output, MagnifiedDisplacementsMoveParticlesAndCracks) {
  const double gap = 0.2e-3;
  const PointFrame frame = block(gap);
  CrackFrame crack = crack_through_block(gap);
  const DrawOptions options{.quantity = "signal", .magnification = 10};
  const PictureMap map = draw_frame(frame, &crack, options, folder / "m.png");
  const Pixels pixels(folder / "m.png");
  const auto gap_at = map.panels[0].pixel(5.5e-3, 4.8e-3);  // the gap reaches from 3 to 5 mm
  expect_colour(pixels.at(gap_at[0], gap_at[1]), white, "magnified gap");
  const auto particle = map.panels[0].pixel(5.5e-3, 5.5e-3);  // the row of y = 4.5 mm, moved by 1 mm
  expect_colour(pixels.at(particle[0], particle[1]), map.colour(5 + 10 * 4), "moved particle");
  crack.original.clear();
  EXPECT_THROW(draw_frame(frame, &crack, options, folder / "n.png"), std::invalid_argument);
  PointFrame without = frame;
  without.fields.pop_back();
  const std::string message = message_of([&] { draw_frame(without, nullptr, options, folder / "n.png"); });
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
  PictureMap map = draw_frame(f, nullptr, options, folder / "f.png");
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
  Field stress{"stress", "Pa", 6, {}};
  const std::vector<double> differences{0, half / 2, half, 2 * half};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double x : {static_cast<double>(i) * 1e-3, 0., 0.}) f.positions.push_back(x);
    for (int k = 0; k < 3; ++k) f.particle_size.push_back(1e-3);
    for (const double s : {0., 0., 0., differences[i] / 2, 0., 0.}) stress.values.push_back(s);  // in shear: 4 sxy^2
  }
  f.fields = {stress};
  const PictureMap map = draw_frame(f, nullptr, {.quantity = "fringes"}, folder / "f.png");
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
  for (double& v : b.fields[1].values) v *= -2;
  b.positions[0] = std::numeric_limits<double>::quiet_NaN();         // left out
  b.fields[1].values[9] = std::numeric_limits<double>::quiet_NaN();  // shown as such
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

}  // namespace
}  // namespace crampon
