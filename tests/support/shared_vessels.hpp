#pragma once

#include <array>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace endowire::test {

inline constexpr std::array<const char*, 6> shared_vessel_names{
    "femoral_to_neuro", "femoral_to_neuro_fine", "abdominal_aorta_phantom",
    "aortoiliac",       "carotid_bifurcation",   "branching_phantom"};

/// Bytes of a file, empty when it is not there.
inline std::vector<std::byte> read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::byte> bytes(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) bytes[i] = static_cast<std::byte>(text[i]);
  return bytes;
}

inline std::string shared_vessel_path(const std::string& name) {
  return std::string(ENDOWIRE_SHARED_DIR) + "/vessels/" + name + "/lumen_mm.stl";
}

}  // namespace endowire::test
