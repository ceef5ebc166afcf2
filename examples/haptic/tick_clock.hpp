#pragma once

#include <cerrno>
#include <cstdint>
#include <ctime>

namespace endowire::haptic {

/// Ticks of a fixed length on the monotonic clock. Sleeping to absolute times adds no drift: a late tick does not make the
/// next ones late.
class TickClock {
 public:
  explicit TickClock(std::int64_t tick_ns) : tick_ns_(tick_ns), start_ns_(now_ns()) {}

  [[nodiscard]] static std::int64_t now_ns() {
    timespec t{};
    ::clock_gettime(CLOCK_MONOTONIC, &t);
    return std::int64_t{1'000'000'000} * t.tv_sec + t.tv_nsec;
  }
  [[nodiscard]] std::int64_t begin_ns(std::int64_t tick) const { return start_ns_ + tick * tick_ns_; }
  /// The tick that a time lies in.
  [[nodiscard]] std::int64_t tick_at(std::int64_t time_ns) const { return (time_ns - start_ns_) / tick_ns_; }

  /// Sleeps until a tick begins.
  /// @return  how late this thread woke up [ns]
  std::int64_t wait(std::int64_t tick) const {
    const std::int64_t until_ns = begin_ns(tick);
    const timespec until{static_cast<std::time_t>(until_ns / 1'000'000'000), until_ns % 1'000'000'000};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
    return now_ns() - until_ns;
  }

 private:
  std::int64_t tick_ns_;
  std::int64_t start_ns_;
};

}  // namespace endowire::haptic
