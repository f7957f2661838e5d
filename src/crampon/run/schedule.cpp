#include "crampon/run/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace crampon {

namespace {

std::int64_t next_multiple(std::int64_t every, std::int64_t after) {
  return every > 0 ? (after / every + 1) * every : std::numeric_limits<std::int64_t>::max();
}

}  // namespace

FrameSchedule::FrameSchedule(const OutputInput& output)
    : every_(output.every.value_or(0)), every_steps_(output.every_steps.value_or(0)), times_(output.times) {
  std::sort(times_.begin(), times_.end());
}

double FrameSchedule::next_time() const {
  const double listed = next_listed_ < times_.size() ? times_[next_listed_] : std::numeric_limits<double>::infinity();
  return std::min(listed, next_regular());
}

std::int64_t FrameSchedule::next_step(std::int64_t steps) const { return next_multiple(every_steps_, steps); }

bool FrameSchedule::take(double time, std::int64_t steps, double slack) {
  const bool by_steps = every_steps_ > 0 && steps > 0 && steps % every_steps_ == 0;
  const bool by_time = next_time() <= time + slack;
  while (next_listed_ < times_.size() && times_[next_listed_] <= time + slack) ++next_listed_;
  // Multiples are counted, not summed, so that the hundredth frame stands at 100 intervals to the last bit.
  if (every_ > 0 && next_regular() <= time + slack) count_ = std::max(count_ + 1, std::floor((time + slack) / every_));
  return by_steps || by_time;
}

HistorySchedule::HistorySchedule(const OutputInput& output, const TimeInput& time, double end_time)
    : every_(output.history_every.value_or(0)), every_steps_(output.history_steps.value_or(0)) {
  if (every_ == 0 && every_steps_ == 0) {
    if (time.steps)
      every_steps_ = (*time.steps + default_rows - 1) / default_rows;
    else
      every_ = end_time / static_cast<double>(default_rows);
  }
  next_ = every_;
}

double HistorySchedule::next_time() const { return every_ > 0 ? next_ : std::numeric_limits<double>::infinity(); }

std::int64_t HistorySchedule::next_step(std::int64_t steps) const { return next_multiple(every_steps_, steps); }

bool HistorySchedule::take(double time, std::int64_t steps, double slack) {
  const bool by_steps = every_steps_ > 0 && steps % every_steps_ == 0;
  const bool by_time = every_ > 0 && next_ <= time + slack;
  if (by_time) next_ = std::max(next_ + every_, (std::floor((time + slack) / every_) + 1) * every_);
  return by_steps || by_time;
}

}  // namespace crampon
