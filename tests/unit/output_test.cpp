// What a run writes can be read back, bit for bit; damage and full disks are told.

#include <csignal>
#include <fcntl.h>
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

#include "crampon/output/file.hpp"
#include "crampon/output/history.hpp"
#include "crampon/output/picture_mark.hpp"
#include "crampon/output/results_folder.hpp"
#include "crampon/output/results_hash.hpp"
#include "crampon/output/run_record.hpp"
#include "crampon/picture/draw.hpp"
#include "output_cases.hpp"

namespace crampon {
namespace {

namespace fs = std::filesystem;

void expect_same_bits(const Numbers& a, const Numbers& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << what << " " << i << ": " << a[i] << " " << b[i];
}

void expect_near_relative(const Numbers& a, const Numbers& b, double tolerance, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(std::abs(a[i] - b[i]), tolerance * std::abs(a[i])) << what << " " << i;
}

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
  written.body_names = {"block", "a <tool> & \"more\""};
  written.fields[3].values.set(1, -0.);
  written.fields[3].values.set(2, std::numeric_limits<double>::quiet_NaN());
  written.fields[3].values.set(3, std::numeric_limits<double>::infinity());
  written.fields[3].values.set(4, std::numeric_limits<double>::denorm_min());
  write_vtp(folder / "p.vtp", written, Precision::full);
  const PointFrame read = read_vtp(folder / "p.vtp");
  expect_same_bits({written.time, written.cell}, {read.time, read.cell}, "time and cell");
  EXPECT_EQ(written.step, read.step);
  EXPECT_EQ(written.dimension, read.dimension);
  EXPECT_EQ(written.body_names, read.body_names);
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
  // 15 random floats a particle, which do not compress, and two small integers, cells included.
  EXPECT_LT(fs::file_size(folder / "p.vtp"), 4 * 19 * 1000);
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
  frame.fields[2].values.push_back(0);
  EXPECT_TRUE(contains(message_of([&] { write_vtp(folder / "p.vtp", frame); }), "\"stress\" has 25 values"));
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

/// As long as the first chunks of a picture, with the mark.
std::string drawn_picture() {
  std::string png(100, 'x');
  mark_picture(png);
  return png;
}

TEST_F(Output, ForceLeavesAloneWhatNoRunWrote) {
  const fs::path path = folder / "mine";
  fs::create_directories(path);
  write_file(path / "history.csv", "my own");
  EXPECT_THROW(ResultsFolder::create(path, Overwrite::replace), ResultsExist);
  write_file(path / "run.json", "{\"program\": \"another\"}");
  EXPECT_TRUE(contains(message_of([&] { ResultsFolder::create(path, Overwrite::replace); }), "no run.json of Crampon"));
  EXPECT_EQ(read_file(path / "history.csv"), "my own");
  // Pictures that were drawn of a run go with it: they would show the old one.
  write_run_record(path / "run.json", describe_program());
  fs::create_directories(path / "pictures");
  write_file(path / "pictures" / "history.png", drawn_picture());
  write_file(path / "pictures" / "photo.png",
             "\x89PNG of a camera, which is longer than the mark of a picture that was drawn by the program");
  write_file(path / "pictures" / "sketch.svg", "");
  ResultsFolder::create(path, Overwrite::replace);
  EXPECT_FALSE(fs::exists(path / "pictures" / "history.png"));
  EXPECT_TRUE(fs::exists(path / "pictures" / "photo.png"));
  EXPECT_TRUE(fs::exists(path / "pictures" / "sketch.svg"));
}

TEST_F(Output, OlderResultsComeBackUnlessTheNewRunHasStarted) {
  const fs::path path = folder / "results";
  const auto write_run = [&](ResultsFolder run, double time) {
    PointFrame frame = random_frame(2);
    frame.time = time;
    run.write_particles(frame);
    write_run_record(run.run_record(), describe_program());
  };
  write_run(ResultsFolder::create(path), 1);
  fs::create_directories(path / "pictures");
  write_file(path / "pictures" / "history.png", drawn_picture());
  write_file(path / "mine.txt", "mine");
  const auto time_there = [&] { return ResultsFolder::open(path).particle_frames().front().time; };
  {
    const OlderResults older(path);
    EXPECT_FALSE(fs::exists(path / "run.json"));
    write_run(ResultsFolder::start(older), 2);
    EXPECT_EQ(time_there(), 2);
  }
  EXPECT_EQ(time_there(), 1);
  EXPECT_TRUE(fs::exists(path / "pictures" / "history.png"));
  {
    OlderResults older(path);
    write_run(ResultsFolder::start(older), 2);
    older.remove();
  }
  EXPECT_EQ(time_there(), 2);
  EXPECT_FALSE(fs::exists(path / "pictures"));
  EXPECT_EQ(read_file(path / "mine.txt"), "mine");

  // A run that is killed as it starts leaves the older results aside: the next one finds them.
  fs::create_directories(path / "replaced.partial" / "particles");
  for (const char* file : {"run.json", "particles.pvd", "particles/particles_000000.vtp"})
    fs::rename(path / file, path / "replaced.partial" / file);
  EXPECT_THROW(ResultsFolder::check(path, Overwrite::refuse), ResultsExist);
  { const OlderResults older(path); }
  EXPECT_EQ(time_there(), 2);
  EXPECT_FALSE(fs::exists(path / "replaced.partial"));
}

TEST_F(Output, HashIsOfTheLastFramesOnDisk) {
  const auto hash_of = [&](const char* name, const PointFrame& first, const PointFrame& last, const CrackFrame& cracks) {
    ResultsFolder results = ResultsFolder::create(folder / name);
    results.write_particles(first, Precision::full);
    results.write_particles(last, Precision::full);
    results.write_cracks(cracks, Precision::full);
    return hash_results(ResultsFolder::open(folder / name));
  };
  const PointFrame a = random_frame(3), b = random_frame(2);
  const std::uint64_t hash = hash_of("a", a, b, two_cracks());
  EXPECT_EQ(hash_of("same", b, b, two_cracks()), hash) << "the first frame does not count";
  EXPECT_NE(hash_of("other", b, a, two_cracks()), hash);
  PointFrame moved = b;
  moved.positions.set(0, std::nextafter(b.positions[0], HUGE_VAL));
  EXPECT_NE(hash_of("moved", a, moved, two_cracks()), hash) << "the last bit of one number counts";
  CrackFrame cracks = two_cracks();
  cracks.upper[0] += 1;
  EXPECT_NE(hash_of("cracks", a, b, cracks), hash);
  EXPECT_THROW(hash_results(ResultsFolder::create(folder / "empty")), std::runtime_error);
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
    picture_error = message_of([&] { draw_frame({&big}, {.quantity = "id"}, folder / "picture.png"); });
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

}  // namespace
}  // namespace crampon
