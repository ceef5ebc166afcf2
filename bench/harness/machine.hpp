#pragma once

#include <string>

namespace endowire::bench {

/// The processor's name, as Linux tells it.
[[nodiscard]] std::string processor();

/// The same as part of a path: small letters, digits and hyphens, with the number of cores.
[[nodiscard]] std::string machine_slug();

/// Compiler and build type of this program.
[[nodiscard]] std::string compiler();

/// Time of one of ten million multiply-adds, each waiting for the one before: how fast this machine is right now. [ns]
[[nodiscard]] double calibration_ns();

/// Most memory that this process has had. [MB]
[[nodiscard]] double peak_memory_mb();

/// Time that this thread has worked, whatever else the machine does. [µs]
[[nodiscard]] double cpu_us();

/// Time on the wall. [µs]
[[nodiscard]] double wall_us();

}  // namespace endowire::bench
