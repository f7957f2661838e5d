#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "crampon/output/file.hpp"
#include "crampon/output/history.hpp"
#include "crampon/run/check.hpp"
#include "crampon/run/estimate.hpp"
#include "crampon/run/run_problem.hpp"
#include "crampon/run/schedule.hpp"
#include "scratch_folder.hpp"

namespace crampon {
namespace {

namespace fs = std::filesystem;

/// Two particles on known paths, x = t^2 and x = 10 - t, in steps of a fixed length: whatever the driver writes can be told in advance.
class FakeSimulation : public Simulation {
 public:
  FakeSimulation(double step_length, double end) : dt_(step_length), end_(end) {}
  std::int64_t fail_in_step = -1;
  std::vector<double> ends_of_steps;  // s

  void step(double longest, const NextLook&) override {
    if (steps_ + 1 == fail_in_step) {
      broken_ = true;
      throw RunError("step 4, particle 1: NaN; take a smaller time step");
    }
    double target = time_ + dt_;
    if (target > longest - 1e-9 * dt_) target = longest;
    time_ = target > end_ - 1e-9 * dt_ ? end_ : target;
    ++steps_;
    ends_of_steps.push_back(time_);
  }
  double time() const override { return time_; }
  std::int64_t steps_done() const override { return steps_; }
  bool finished() const override { return time_ >= end_; }
  double end_time() const override { return end_; }
  SimulationSize size() const override {
    SimulationSize size;
    size.particles = 2;
    size.steps = static_cast<std::int64_t>(std::ceil(end_ / dt_));
    size.time_step = dt_;
    return size;
  }
  std::vector<std::string> particle_quantities() const override { return {"id", "body", "speed"}; }
  PointFrame particles(const std::vector<std::string>&, Precision) const override {
    PointFrame frame;
    frame.time = time_;
    frame.step = steps_;
    frame.positions = {broken_ ? std::nan("") : time_ * time_, 0, 0, 10 - time_, 0, 0};
    frame.fields = {{"id", "", 1, {0, 1}}, {"body", "", 1, {0, 0}}, {"speed", "m/s", 1, {2 * time_, 1}}};
    frame.cell = 1;
    return frame;
  }
  CrackFrame cracks() const override { return {}; }
  SavedState save() const override { return {}; }
  void load(const SavedState&) override {}
  std::int64_t last_reordering() const override { return -1; }
  PointFrame nodes() const override { return {}; }
  std::vector<HistoryColumn> history_columns() const override { return {{"time", "s"}, {"ramp", "m"}, {"square", "m2"}}; }
  std::vector<double> history_row() const override { return {time_, 3 * time_, time_ * time_}; }
  std::uint64_t state_hash() const override { return 0xabcU + static_cast<std::uint64_t>(steps_); }
  std::vector<PhaseTime> phases() const override { return {{"everything", 0.5}}; }
  std::vector<std::string> notes_at_start() const override { return {"an early note"}; }
  std::vector<std::string> notes() const override { return {"a note"}; }

 private:
  double dt_, end_, time_ = 0;
  std::int64_t steps_ = 0;
  bool broken_ = false;
};

/// Cannot show its particles, so that no run can start.
class BrokenSimulation : public FakeSimulation {
 public:
  using FakeSimulation::FakeSimulation;
  PointFrame particles(const std::vector<std::string>&, Precision) const override { throw std::runtime_error("no frame"); }
};

class RunTest : public ::testing::Test {
 protected:
  RunTest() {
    problem.output.full_precision = true;
    problem.source = "title = \"as typed\"\n";
    options.folder = top / "out";
    problem.resolved = "title = \"resolved\"\n";
  }

  ResultsFolder results() const { return ResultsFolder::open(options.folder); }
  std::vector<double> frame_times() const {
    std::vector<double> times;
    for (const PvdEntry& entry : results().particle_frames()) times.push_back(entry.time);
    return times;
  }
  ExpectInput expect_column(const std::string& column, double value, double tolerance) const {
    ExpectInput e;
    e.name = "figure";
    e.column = column;
    e.value = value;
    e.tolerance = tolerance;
    return e;
  }
  CheckRow check(const ExpectInput& expect) {
    problem.expects = {expect};
    return check_results(results(), problem).at(0);
  }

  const ScratchFolder scratch;
  const fs::path top = scratch.path();
  Problem problem;
  RunOptions options;
};

TEST_F(RunTest, FramesStandAtListedAndRegularTimesToTheLastBit) {
  problem.output.every = 0.7;
  problem.output.times = {0, 1.1, 0.25, 2.1};  // out of order; the last one is also a multiple of the interval
  FakeSimulation simulation(0.3, 2.5);
  const RunOutcome outcome = run_problem(problem, simulation, options);
  EXPECT_EQ(outcome.end, RunOutcome::End::finished);
  const std::vector<double> expected{0, 0.25, 1 * 0.7, 1.1, 2 * 0.7, 2.1, 2.5};
  const std::vector<double> times = frame_times();
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    // 3 * 0.7 and 2.1 differ by one unit in the last place and are one frame; everything else is exact.
    EXPECT_NEAR(times[i], expected[i], i == 5 ? 1e-15 : 0) << i;
    EXPECT_EQ(results().read_particles(results().particle_frames()[i]).positions[3], 10 - times[i]);
  }
}

TEST_F(RunTest, AFixedStepIsNotCutWhereOutputFallsOnIt) {
  problem.output.every = 0.5;
  FakeSimulation simulation(0.1, 10);  // 0.1 summed is off the multiples of 0.5 by round-off
  run_problem(problem, simulation, options);
  EXPECT_EQ(simulation.steps_done(), 100);
  EXPECT_EQ(frame_times().size(), 21U);
}

TEST_F(RunTest, OlderResultsSurviveARunThatCannotStart) {
  FakeSimulation first(0.1, 1);
  run_problem(problem, first, options);
  options.overwrite = Overwrite::replace;
  BrokenSimulation broken(0.1, 1);
  EXPECT_THROW(run_problem(problem, broken, options), std::runtime_error);
  EXPECT_EQ(read_run_record(results().run_record()).status, "finished");
  EXPECT_EQ(frame_times(), (std::vector<double>{0, 1}));
  FakeSimulation second(0.1, 2);
  run_problem(problem, second, options);
  EXPECT_EQ(frame_times(), (std::vector<double>{0, 2}));
  EXPECT_FALSE(fs::exists(options.folder / "replaced.partial"));
}

TEST_F(RunTest, FramesByStepsAndOneFirstAndOneLastFrame) {
  problem.output.every_steps = 4;
  FakeSimulation simulation(0.1, 1);
  run_problem(problem, simulation, options);
  std::vector<std::int64_t> steps;
  for (const PvdEntry& entry : results().particle_frames()) steps.push_back(results().read_particles(entry).step);
  EXPECT_EQ(steps, (std::vector<std::int64_t>{0, 4, 8, 10}));
}

TEST_F(RunTest, WithoutWishesFirstAndLastFrameAndNoStepCut) {
  FakeSimulation simulation(0.25, 1);
  run_problem(problem, simulation, options);
  EXPECT_EQ(frame_times(), (std::vector<double>{0, 1}));
  EXPECT_EQ(simulation.ends_of_steps, (std::vector<double>{0.25, 0.5, 0.75, 1}));
}

TEST_F(RunTest, HistoryHasAtMostAThousandRowsByDefault) {
  FakeSimulation simulation(1. / 8192, 1);
  run_problem(problem, simulation, options);
  const History history = read_history(results().history());
  EXPECT_LE(history.rows(), 1000U);
  EXPECT_GE(history.rows(), 900U);  // and not far fewer: 8192 steps reach each of the 998 times
  EXPECT_EQ(history.column("time").front(), 0);
  EXPECT_EQ(history.column("time").back(), 1);
}

TEST_F(RunTest, HistoryByStepsAndByTime) {
  problem.output.history_steps = 5;
  FakeSimulation by_steps(0.125, 2);
  run_problem(problem, by_steps, options);
  EXPECT_EQ(read_history(results().history()).column("time"), (std::vector<double>{0, 0.625, 1.25, 1.875, 2}));

  problem.output.history_steps.reset();
  problem.output.history_every = 0.5;
  options.overwrite = Overwrite::replace;
  FakeSimulation by_time(0.375, 2);  // the first step at or after each time; steps stay as they are
  run_problem(problem, by_time, options);
  EXPECT_EQ(read_history(results().history()).column("time"), (std::vector<double>{0, 0.75, 1.125, 1.5, 2}));
}

TEST_F(RunTest, TheRecordTellsTheRun) {
  options.threads = 2;
  options.input = "some.toml";
  FakeSimulation simulation(0.25, 1);
  run_problem(problem, simulation, options);
  const RunRecord record = read_run_record(results().run_record());
  EXPECT_EQ(record.status, "finished");
  EXPECT_EQ(record.steps, 4);
  EXPECT_EQ(record.end_time, 1);
  EXPECT_EQ(record.threads, 2);
  EXPECT_EQ(record.input, "some.toml");
  EXPECT_EQ(record.state_hash, simulation.state_hash());
  EXPECT_EQ(record.notes, (std::vector<std::string>{"an early note", "a note"}));
  ASSERT_EQ(record.phases.size(), 2U);
  EXPECT_EQ(record.phases[0].name, "everything");
  EXPECT_EQ(read_file(options.folder / "input.original.toml"), problem.source);
  EXPECT_EQ(read_file(results().resolved_input()), problem.resolved);
}

TEST_F(RunTest, AStoppedRunLeavesGoodFramesAndTheStateForInspection) {
  problem.output.every_steps = 1;
  FakeSimulation simulation(0.25, 2);
  simulation.fail_in_step = 4;
  const RunOutcome outcome = run_problem(problem, simulation, options);
  EXPECT_EQ(outcome.end, RunOutcome::End::stopped);
  EXPECT_EQ(outcome.message, "step 4, particle 1: NaN; take a smaller time step");
  const auto frames = results().particle_frames();
  ASSERT_EQ(frames.size(), 5U);  // start, three steps, and what the fourth left
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(results().read_particles(frames[i]).positions[3], 10 - 0.25 * static_cast<double>(i));
  EXPECT_TRUE(std::isnan(results().read_particles(frames[4]).positions[0]));
  EXPECT_EQ(read_run_record(results().run_record()).status, "stopped: " + outcome.message);
  EXPECT_TRUE(std::isfinite(read_history(results().history()).column("square").back()));
}

TEST_F(RunTest, ATrialEndsAfterTheWantedSteps) {
  options.most_steps = 3;
  FakeSimulation simulation(0.25, 2);
  EXPECT_EQ(run_problem(problem, simulation, options).end, RunOutcome::End::shortened);
  EXPECT_EQ(frame_times(), (std::vector<double>{0, 0.75}));
  EXPECT_EQ(read_run_record(results().run_record()).status, "shortened");
}

TEST_F(RunTest, AnInterruptEndsInOrder) {
  std::atomic<bool> interrupt{false};
  options.interrupt = &interrupt;
  options.progress = [&interrupt](const Progress& p) { interrupt = p.step == 3; };
  FakeSimulation simulation(0.25, 2);
  const RunOutcome outcome = run_problem(problem, simulation, options);
  EXPECT_EQ(outcome.end, RunOutcome::End::interrupted);
  EXPECT_EQ(frame_times(), (std::vector<double>{0, 0.75}));
  EXPECT_EQ(read_history(results().history()).column("time").back(), 0.75);
  EXPECT_EQ(read_run_record(results().run_record()).status, "interrupted");
}

TEST_F(RunTest, OldResultsAreKeptUnlessReplaced) {
  FakeSimulation first(0.5, 1);
  run_problem(problem, first, options);
  const std::string before = read_file(results().run_record());
  FakeSimulation second(0.1, 1);
  EXPECT_THROW(run_problem(problem, second, options), ResultsExist);
  EXPECT_EQ(read_file(results().run_record()), before);
  EXPECT_EQ(second.steps_done(), 0);
  options.overwrite = Overwrite::replace;
  run_problem(problem, second, options);
  EXPECT_EQ(read_run_record(results().run_record()).steps, 10);
}

TEST_F(RunTest, UnknownNamesAreInputErrorsBeforeAnythingIsWritten) {
  ExpectInput expect = expect_column("rampp", 0, 0);
  expect.keys["column"] = {"in.toml", 7, 3, "expect[0].column"};
  problem.expects = {expect};
  problem.output.quantities = {"sped"};
  problem.output.keys["quantities"] = {"in.toml", 2, 1, "output.quantities"};
  FakeSimulation simulation(0.5, 1);
  try {
    run_problem(problem, simulation, options);
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("in.toml:7:3: expect[0].column"), std::string::npos) << text;
    EXPECT_NE(text.find("\"ramp\""), std::string::npos) << text;
    EXPECT_NE(text.find("\"speed\""), std::string::npos) << text;
  }
  EXPECT_FALSE(fs::exists(options.folder));
}

TEST_F(RunTest, AnUnwritableFolderIsAnErrorThatNamesIt) {
  std::ofstream(top / "file") << "in the way";
  options.folder = top / "file" / "out";
  FakeSimulation simulation(0.5, 1);
  try {
    run_problem(problem, simulation, options);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find((top / "file").string()), std::string::npos) << error.what();
  }
}

class CheckTest : public RunTest {
 protected:
  CheckTest() {
    problem.output.history_steps = 1;
    problem.output.every_steps = 2;
    FakeSimulation simulation(0.25, 2);
    run_problem(problem, simulation, options);
  }
};

TEST_F(CheckTest, ValueAtTheEndAndBetweenRows) {
  EXPECT_EQ(check(expect_column("square", 4, 0)).verdict, Verdict::met);
  ExpectInput between = expect_column("square", 0.3125, 1e-15);  // halfway between 0.25 and 0.375: (0.5^2 + 0.75^2) / 2 is 0.40625
  between.time = 0.625;
  EXPECT_EQ(check(between).verdict, Verdict::missed);
  EXPECT_DOUBLE_EQ(check(between).measured, 0.40625);
}

TEST_F(CheckTest, StatisticsOverARange) {
  using Statistic = ExpectInput::Statistic;
  ExpectInput e = expect_column("square", 0, 0);
  e.range = {0.5, 1.5};
  const auto figure = [&](Statistic s) {
    e.statistic = s;
    return check(e).measured;
  };
  EXPECT_DOUBLE_EQ(figure(Statistic::minimum), 0.25);
  EXPECT_DOUBLE_EQ(figure(Statistic::maximum), 2.25);
  EXPECT_DOUBLE_EQ(figure(Statistic::spread), 2);
  // Integral of t^2 over [0.5, 1.5] is 13/12; the trapezoids of width h add h^2/12 (f'(b) - f'(a)) = h^2/6.
  EXPECT_DOUBLE_EQ(figure(Statistic::mean), 13. / 12 + 0.25 * 0.25 / 6);
  e.range.clear();
  EXPECT_DOUBLE_EQ(figure(Statistic::spread), 4);
}

TEST_F(CheckTest, ParticleNearestToAPointInTheFrameNearestInTime) {
  ExpectInput e;
  e.name = "speed";
  e.quantity = "speed";
  e.point = {1, 0};
  e.time = 1.1;  // frames at 1 and 1.5: the particle at x = 1 has the speed 2
  e.value = 2;
  EXPECT_EQ(check(e).verdict, Verdict::met);
  e.point = {9, 0};  // the other one
  EXPECT_EQ(check(e).measured, 1);
  e.time.reset();  // at the end: t = 2
  e.point = {4, 0};
  EXPECT_EQ(check(e).measured, 4);
}

TEST_F(CheckTest, RelativeToleranceAndUnit) {
  ExpectInput e = expect_column("ramp", 6.05, 0);
  e.relative = 0.01;
  e.unit = "mm";
  const CheckRow row = check(e);
  EXPECT_EQ(row.verdict, Verdict::met);
  EXPECT_DOUBLE_EQ(row.measured, 6000);
  EXPECT_DOUBLE_EQ(row.tolerance, 60.5);
  e.relative = 0.008;
  EXPECT_EQ(check(e).verdict, Verdict::missed);
}

TEST_F(CheckTest, BeyondTheEndIsNotReached) {
  ExpectInput e = expect_column("ramp", 6, 1e9);
  e.time = 2.5;
  EXPECT_EQ(check(e).verdict, Verdict::not_reached);
  e.time.reset();
  e.statistic = ExpectInput::Statistic::mean;
  e.range = {1, 2.5};
  EXPECT_EQ(check(e).verdict, Verdict::not_reached);
}

TEST_F(CheckTest, ARunCutShortHasNoValueAtTheEnd) {
  RunRecord record = read_run_record(results().run_record());
  record.status = "interrupted";
  write_run_record(results().run_record(), record);
  ExpectInput e = expect_column("ramp", 6, 0);
  EXPECT_EQ(check(e).verdict, Verdict::not_reached);
  e.time = 2;
  EXPECT_EQ(check(e).verdict, Verdict::met);
}

TEST_F(CheckTest, NanIsAMiss) {
  std::ofstream(options.folder / "history.csv", std::ios::app) << "2.25,nan,nan\n";
  EXPECT_EQ(check(expect_column("ramp", 6, 1e9)).verdict, Verdict::missed);
}

TEST_F(CheckTest, TheTableHoldsNamesNumbersAndVerdicts) {
  ExpectInput met = expect_column("ramp", 6, 0.5), missed = expect_column("square", 7, 0.5);
  met.source = "row 3";
  missed.name = "the other";
  problem.expects = {met, missed};
  const std::string table = check_table(check_results(results(), problem));
  for (const char* word : {"met", "MISSED", "figure", "the other", "row 3", "ramp", "square"})
    EXPECT_NE(table.find(word), std::string::npos) << word << "\n" << table;
}

TEST_F(RunTest, FramesFarCloserThanTimeStepsAreAnInputError) {
  problem.output.every = 1e-30;
  FakeSimulation simulation(0.25, 2);
  EXPECT_THROW(run_problem(problem, simulation, options), InputError);
  EXPECT_FALSE(fs::exists(options.folder));
}

TEST(Schedule, SeveralIntervalsInOneStepAreOneFrame) {
  OutputInput output;
  output.every = 0.25;
  FrameSchedule schedule(output);
  EXPECT_TRUE(schedule.take(1.1, 1, 0));
  EXPECT_EQ(schedule.next_time(), 1.25);
  EXPECT_FALSE(schedule.take(1.2, 2, 0));
}

TEST(Estimate, ExtrapolatesAMeasuredRateAndReportsAStop) {
  FakeSimulation simulation(0.001, 1);
  const RunEstimate estimate = estimate_run(simulation, 0.5);
  EXPECT_GT(estimate.steps_measured, 1);
  EXPECT_DOUBLE_EQ(estimate.seconds, 1000 * estimate.seconds_per_step);
  FakeSimulation failing(0.001, 1);
  failing.fail_in_step = 2;
  EXPECT_NE(estimate_run(failing).stopped.find("NaN"), std::string::npos);
}

}  // namespace
}  // namespace crampon
