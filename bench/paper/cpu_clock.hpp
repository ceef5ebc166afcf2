#pragma once

#include <ctime>

namespace endowire::paper {

/// Time that this thread has worked, whatever else the machine does.
[[nodiscard]] inline double cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace endowire::paper
