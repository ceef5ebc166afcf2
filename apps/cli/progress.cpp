#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace endowire::cli {

namespace {

constexpr std::chrono::milliseconds terminal_interval{100};  // faster than that nobody reads
constexpr std::chrono::seconds log_interval{20};

}  // namespace

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), last_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  clear();
}

void Progress::stage(const std::string& what) {
  if (quiet_ || !terminal_) return;
  std::fprintf(stderr, "\r\x1b[K%s", what.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void Progress::update(double fraction, const std::string& what) {
  if (quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  if (terminal_ ? now - last_ < terminal_interval : now - last_ < log_interval) return;
  last_ = now;
  const int percent = static_cast<int>(std::floor(100.0 * fraction));
  if (!terminal_) {
    std::fprintf(stderr, "%3d %%  %s\n", percent, what.c_str());
    return;
  }
  constexpr int width = 24;
  const int filled = static_cast<int>(std::floor(width * fraction));
  std::string bar;
  for (int i = 0; i < width; ++i) bar += i < filled ? "━" : "╌";
  stage(fmt::format("{} {:3d} %  {}", bar, percent, what));
}

void Progress::clear() {
  if (!shown_) return;
  std::fprintf(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace endowire::cli
