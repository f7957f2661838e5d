#pragma once
/// When frames and history rows fall due.

#include <cstdint>
#include <limits>
#include <vector>

#include "crampon/input/problem.hpp"

namespace crampon {

/// Frames after the first: at listed times, every given time, every so many steps; all of them when several are asked for.
class FrameSchedule {
 public:
  explicit FrameSchedule(const OutputInput& output);

  /// Time of the next frame, s; infinity when none is due at a time. A step must not reach beyond it.
  double next_time() const;
  /// The next number of steps, after so many, at which a frame is due; the largest number when none is due by steps.
  std::int64_t next_step(std::int64_t steps) const;

  /// Is a frame due now? Every time up to now then counts as done.
  /// slack, s: a time this close ahead counts as reached, as sums of time steps carry round-off.
  bool take(double time, std::int64_t steps, double slack);

 private:
  double next_regular() const { return every_ > 0 ? (count_ + 1) * every_ : std::numeric_limits<double>::infinity(); }

  double every_ = 0;              // s; 0: not by time
  double count_ = 0;              // intervals done, a whole number
  std::int64_t every_steps_ = 0;  // 0: not by steps
  std::vector<double> times_;     // ascending
  std::size_t next_listed_ = 0;
};

/// History rows never change a time step: a row is due at the first step that reaches its time.
class HistorySchedule {
 public:
  /// end_time, s: of the run; without any wish in the input it is divided into `default_rows`.
  HistorySchedule(const OutputInput& output, const TimeInput& time, double end_time);
  bool take(double time, std::int64_t steps, double slack);
  /// As FrameSchedule tells them.
  double next_time() const;
  std::int64_t next_step(std::int64_t steps) const;

  static constexpr std::int64_t default_rows = 998;  ///< with the first and the last row at most 1000

 private:
  double every_ = 0;
  double next_ = 0;
  std::int64_t every_steps_ = 0;
};

}  // namespace crampon
