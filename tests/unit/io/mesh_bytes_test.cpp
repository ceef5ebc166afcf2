// What another process says of a mesh is not believed.
#include "endowire/io/mesh_bytes.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "endowire/base/error.hpp"
#include "support/generated_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

std::string refusal(const std::string& bytes) {
  return test::message_of<base::InputError>([&] { static_cast<void>(unpack_mesh(bytes, "f")); });
}

template <class Number>
std::string with(std::string bytes, std::size_t at, Number number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
  return bytes;
}

TEST(MeshBytes, GiveBackTheMesh) {
  const vessel::TriangleMesh mesh = test::closed_tube(3.0, 10.0, 7, 4);
  const vessel::TriangleMesh back = unpack_mesh(pack_mesh(mesh), "f");
  EXPECT_EQ(back.vertices_mm, mesh.vertices_mm);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST(MeshBytes, WhatDoesNotFitIsRefused) {
  const vessel::TriangleMesh mesh = test::closed_tube(3.0, 10.0, 7, 4);
  const std::string whole = pack_mesh(mesh);
  const std::size_t corners = 8 + mesh.vertices_mm.size() * sizeof(Eigen::Vector3d);
  EXPECT_NE(refusal("").find("gave 0 bytes for 0 points"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, 7)).find("gave 7 bytes"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 1)).find("bytes for"), std::string::npos);
  EXPECT_NE(refusal(with(whole, 0, std::uint64_t{1} << 62)).find("bytes for 4611686018427387904 points"),
            std::string::npos);
  EXPECT_NE(
      refusal(with(whole, 8 + 24, std::numeric_limits<double>::quiet_NaN())).find("point 1 is not finite"),
      std::string::npos);
  EXPECT_NE(refusal(with(whole, corners + 12, std::int32_t{-1})).find("triangle 1 has corner -1"),
            std::string::npos);
  const auto beyond = static_cast<std::int32_t>(mesh.vertices_mm.size());
  EXPECT_NE(refusal(with(whole, corners, beyond)).find("triangle 0 has corner"), std::string::npos);
}

}  // namespace
}  // namespace endowire::io
