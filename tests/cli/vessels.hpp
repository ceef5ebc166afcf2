#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "endowire/vessel/stl.hpp"

namespace endowire::test {

/// A straight tube along z from 0, closed by flat caps, as the bytes of a binary STL file.
inline std::string tube_stl(double radius_mm, double length_mm, int around = 32, int along = 12) {
  vessel::TriangleMesh mesh;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.vertices_mm.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle),
                                    length_mm * j / along);
    }
  }
  const int bottom = around * (along + 1);
  mesh.vertices_mm.emplace_back(0, 0, 0);
  mesh.vertices_mm.emplace_back(0, 0, length_mm);
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    for (int j = 0; j < along; ++j) {
      const int low = j * around;
      mesh.triangles.push_back({low + i, low + next, low + around + i});
      mesh.triangles.push_back({low + next, low + around + next, low + around + i});
    }
    mesh.triangles.push_back({bottom, next, i});
    mesh.triangles.push_back({bottom + 1, along * around + i, along * around + next});
  }
  const std::vector<std::byte> bytes = vessel::write_binary_stl(mesh);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A scene in the folder of `v.stl`: 20 mm into a tube along z.
inline const char* const tube_scene = R"(schema = 1
[vessel]
file = "v.stl"
[access]
position_mm = [0.0, 0.0, 5.0]
direction = [0.0, 0.0, 1.0]
[[instrument]]
model = "hydrophilic_035_straight"
[simulation]
max_advance_mm = 1.0
[[motion]]
duration_s = 2.0
hands = [{ advance_mm = 20.0, torque_deg = 30.0 }]
)";

/// Prepared fields of the tests' vessels, shared by all of them: content decides what is found there.
inline std::string test_cache() {
  return (std::filesystem::temp_directory_path() / "endowire-test-cache").string();
}

}  // namespace endowire::test
