#pragma once

#include <chrono>
#include <string>

namespace endowire::cli {

/// One calm line on stderr about work that takes a while: on a terminal it overwrites itself and disappears
/// when done; elsewhere a line now and then, so that a log stays short.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Work of unknown length: shown on a terminal only.
  void stage(const std::string& what);
  /// @param fraction  0 … 1 of the work done
  void update(double fraction, const std::string& what);
  void clear();

 private:
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace endowire::cli
