#include "endowire/vessel/ply.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "endowire/base/error.hpp"

namespace endowire::vessel {
namespace {

using Faces = std::vector<std::array<std::int32_t, 3>>;

TriangleMesh parsed(const std::string& text) {
  return parse_ply(std::as_bytes(std::span(text)), "a.ply");
}

std::string header(const char* format) {
  return std::string("ply\nformat ") + format +
         " 1.0\ncomment by a test\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty float "
         "y\nproperty "
         "double z\nelement face 2\nproperty list uchar int vertex_indices\nproperty short flags\nelement "
         "edge 1\nproperty "
         "int vertex1\nend_header\n";
}

/// The same vertices and faces in binary.
std::string body(bool big_endian) {
  std::string bytes;
  const auto add = [&](auto number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    for (std::size_t k = 0; k < sizeof number; ++k) bytes += raw[big_endian ? sizeof number - 1 - k : k];
  };
  const float places[4][2] = {{0, 0}, {1.5F, 0}, {1, -2}, {0, 1}};
  for (const auto& place : places) {
    add(place[0]);
    add(std::uint8_t{200});
    add(place[1]);
    add(3.25);
  }
  for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 2}, {0, 1, 2, 3}}) {
    add(static_cast<std::uint8_t>(face.size()));
    for (const std::int32_t corner : face) add(corner);
    add(std::int16_t{-7});
  }
  add(std::int32_t{3});
  return bytes;
}

TEST(Ply, TextAndBothByteOrdersAreTheSame) {
  const std::string text =
      header("ascii") +
      "0 200 0 3.25\n1.5 200 0 3.25\n1 200 -2 3.25\n0 200 1 3.25\n3 0 1 2 -7\n4 0 1 2 3 -7\n3\n";
  for (const std::string& file :
       {text, header("binary_little_endian") + body(false), header("binary_big_endian") + body(true)}) {
    const TriangleMesh mesh = parsed(file);
    ASSERT_EQ(mesh.vertices_mm.size(), 4U);
    EXPECT_EQ(mesh.vertices_mm[2], Eigen::Vector3d(1, -2, 3.25));
    EXPECT_EQ(mesh.triangles, (Faces{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  }
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parsed(text));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Ply, CutOffAnywhereIsRefused) {
  const std::string whole = header("binary_little_endian") + body(false);
  for (std::size_t length = 0; length + 1 < whole.size(); ++length)
    EXPECT_EQ(refusal(whole.substr(0, length)).rfind("a.ply: ", 0), 0U) << length;
}

TEST(Ply, CountsThatLieAreNotBelieved) {
  std::string file = header("binary_little_endian") + body(false);
  file.replace(file.find("vertex 4"), 8, "vertex 4000000000");
  EXPECT_NE(refusal(file).find("element vertex has count 4000000000"), std::string::npos) << refusal(file);
  file = header("binary_little_endian") + body(false);
  file.replace(file.find("list uchar int"), 14, "list uint int");
  EXPECT_EQ(refusal(file).rfind("a.ply: ", 0), 0U) << refusal(file);
  EXPECT_NE(
      refusal("ply\nformat ascii 1.0\nelement vertex -3\nend_header\n").find("must be a whole number >= 0"),
      std::string::npos);
  // A count of nothing at all is passed over, not counted through.
  EXPECT_NE(refusal("ply\nformat ascii 1.0\nelement nothing 1e18\nend_header\n").find("there are no faces"),
            std::string::npos);
}

TEST(Ply, RefusesCornersAndNumbersThatAreNone) {
  const std::string text = header("ascii");
  EXPECT_NE(
      refusal(text + "0 0 0 0\n1 0 0 0\n1 0 nan 0\n0 0 1 0\n").find("vertex 3 has no finite x, y and z"),
      std::string::npos);
  EXPECT_NE(refusal(text + "0 0 0 0\n1 0 0 0\n1 0 1 0\n0 0 1 0\n3 0 1 4 0\n")
                .find("a corner that is none of the 4 vertices"),
            std::string::npos);
  EXPECT_NE(refusal("ply\nformat morse 1.0\nend_header\n").find("format is 'morse'"), std::string::npos);
  EXPECT_NE(refusal("ply\nend_header\n").find("has no format line"), std::string::npos);
}

}  // namespace
}  // namespace endowire::vessel
