#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace endowire::tests {

struct LayeringReport {
  int files = 0;
  int includes = 0;
  std::vector<std::string> violations;  ///< "path:line: what is wrong"
};

/// Reads the #include lines of src/endowire, apps and tools/check_crossings under `root`.
///
///   base ← math ← { vessel, rod, solve } ← contact ← sim ← { batch, imaging ← io } ← apps
///
/// A layer includes itself and what stands to its left, siblings never each other. Below io only the standard
/// library, Eigen and endowire are included; by batch oneTBB too. The judge includes nothing of endowire.
[[nodiscard]] LayeringReport read_includes(const std::filesystem::path& root);

}  // namespace endowire::tests
