#include "endowire/vessel/stl.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "endowire/base/error.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::vessel {
namespace {

using base::InputError;

std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

std::string message_of(const std::vector<std::byte>& bytes) {
  try {
    static_cast<void>(parse_stl(bytes, "bad.stl"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b, double tolerance_mm) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE((a.corner(t, k) - b.corner(t, k)).norm(), tolerance_mm);
}

void set_float(std::vector<std::byte>& bytes, std::size_t at, float value) {
  std::memcpy(&bytes[at], &value, 4);
}

TEST(Stl, BinaryRoundTripIsExactInSinglePrecision) {
  const TriangleMesh mesh = test::closed_tube(5.0, 20.0, 12, 4);
  expect_same(parse_stl(write_binary_stl(mesh), "a.stl"), mesh, 20.0 * 0x1p-23);
}

TEST(Stl, AsciiRoundTrip) {
  const TriangleMesh mesh = test::closed_tube(5.0, 20.0, 12, 4);
  expect_same(parse_stl(bytes_of(write_ascii_stl(mesh)), "a.stl"), mesh, 1e-7);
}

TEST(Stl, UnitsScale) {
  const TriangleMesh mesh = test::closed_tube(5.0, 20.0, 12, 4);
  const auto bytes = write_binary_stl(mesh);
  EXPECT_NEAR(parse_stl(bytes, "a", LengthUnit::metre).corner(3, 1).x(), 1000.0 * mesh.corner(3, 1).x(),
              1e-3);
  EXPECT_NEAR(parse_stl(bytes, "a", LengthUnit::centimetre).corner(3, 1).x(), 10.0 * mesh.corner(3, 1).x(),
              1e-5);
  EXPECT_EQ(parse_length_unit("cm", "s: unit"), LengthUnit::centimetre);
  EXPECT_THROW(static_cast<void>(parse_length_unit("inch", "s: unit")), InputError);
}

TEST(Stl, BinaryThatBeginsWithSolidIsBinary) {
  auto bytes = write_binary_stl(test::closed_tube(5.0, 20.0, 12, 4));
  std::memcpy(bytes.data(), "solid facet outer loop vertex", 29);
  EXPECT_EQ(parse_stl(bytes, "a.stl").triangles.size(), 12U * 4U * 2U + 24U);
}

TEST(Stl, RefusesWhatIsNoStl) {
  EXPECT_EQ(message_of({}), "bad.stl: length is 0 bytes; must be an STL file with triangles");
  EXPECT_NE(message_of(bytes_of("PK")).find("length is 2 bytes"), std::string::npos);
  EXPECT_NE(message_of(bytes_of(std::string(500, 'x'))).find("triangle count is"), std::string::npos);
}

TEST(Stl, RefusesTruncatedAndLyingCounts) {
  const auto good = write_binary_stl(test::closed_tube(5.0, 20.0, 12, 4));
  for (std::size_t length : {std::size_t{83}, std::size_t{84}, std::size_t{100}, good.size() - 1}) {
    const std::string said = message_of({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)});
    EXPECT_EQ(said.rfind("bad.stl: ", 0), 0U) << said;
  }
  auto huge = good;
  std::memset(&huge[80], 0xff, 4);  // 4 294 967 295 triangles: nothing may be allocated for them
  EXPECT_NE(message_of(huge).find("triangle count is 4294967295 but the"), std::string::npos);
  auto fewer = good;
  std::memset(&fewer[80], 0, 4);
  EXPECT_NE(message_of(fewer).find("triangle count is 0 but the"), std::string::npos);
}

TEST(Stl, RefusesNoTriangles) {
  std::vector<std::byte> empty(84, std::byte{0});
  EXPECT_EQ(message_of(empty), "bad.stl: triangle count is 0; must be > 0");
  EXPECT_EQ(message_of(bytes_of("solid x\nendsolid x\n")), "bad.stl: triangle count is 0; must be > 0");
}

TEST(Stl, RefusesVerticesThatAreNotFinite) {
  auto bytes = write_binary_stl(test::closed_tube(5.0, 20.0, 12, 4));
  set_float(bytes, 84 + 50 * 2 + 12 + 12, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(message_of(bytes), "bad.stl: triangle 3, vertex 2 is nan; must be a finite number");
  set_float(bytes, 84 + 50 * 2 + 12 + 12, std::numeric_limits<float>::infinity());
  EXPECT_EQ(message_of(bytes), "bad.stl: triangle 3, vertex 2 is infinite; must be a finite number");
}

TEST(Stl, RefusesBadText) {
  const std::string good = write_ascii_stl(test::closed_tube(5.0, 20.0, 12, 4));
  for (double part : {0.1, 0.5, 0.9}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(good.size()));
    const std::string said = message_of(bytes_of(good.substr(0, length)));
    EXPECT_EQ(said.rfind("bad.stl: ", 0), 0U) << said;
  }
  std::string nan = good;
  nan.replace(nan.find("vertex "), 8, "vertex nan ");
  EXPECT_NE(message_of(bytes_of(nan)).find("must be a finite number"), std::string::npos);
  std::string four = good;
  four.replace(four.find("  endloop"), 9, "vertex 1 2 3\nendloop");
  EXPECT_NE(message_of(bytes_of(four)).find("has 'vertex'; must be 'endloop'"), std::string::npos);
}

TEST(Stl, NumbersOfText) {
  const auto x_of = [](const std::string& number) {
    return parse_stl(bytes_of("solid\nfacet normal 0 0 1\nouter loop\nvertex " + number +
                              " 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n"),
                     "n")
        .corner(0, 0)
        .x();
  };
  EXPECT_DOUBLE_EQ(x_of("-1.5e2"), -150.0);
  EXPECT_DOUBLE_EQ(x_of("+.25E-1"), 0.025);
  EXPECT_DOUBLE_EQ(x_of("123456789.123456789"), 123456789.123456789);
  EXPECT_THROW(static_cast<void>(x_of("1,5")), InputError);
  EXPECT_THROW(static_cast<void>(x_of("1e999")), InputError);
}

}  // namespace
}  // namespace endowire::vessel
