#include "harness/machine.hpp"

#include <sys/resource.h>

#include <cctype>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

namespace endowire::bench {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string machine_slug() {
  std::string slug;
  for (const char c : processor() + " " + std::to_string(std::thread::hardware_concurrency()) + " cores") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      slug += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  return slug;
}

std::string compiler() {
  return ENDOWIRE_COMPILER;
}

double cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double wall_us() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double calibration_ns() {
  constexpr int count = 10'000'000;
  volatile double factor = 0.999999;  // unknown to the compiler
  const double a = factor;
  double x = 1.0;
  const double start_us = cpu_us();
  for (int i = 0; i < count; ++i) x = x * a + 1e-6;
  const double ns = 1e3 * (cpu_us() - start_us) / count;
  volatile double sink = x;
  static_cast<void>(sink);
  return ns;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kilobytes on Linux
}

}  // namespace endowire::bench
