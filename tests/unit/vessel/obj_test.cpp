#include "endowire/vessel/obj.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"

namespace endowire::vessel {
namespace {

using Faces = std::vector<std::array<std::int32_t, 3>>;

TEST(Obj, ReadsAllFormsOfACornerAndFansPolygons) {
  const TriangleMesh mesh = parse_obj(
      "# a comment\nmtllib m.mtl\no thing\r\nv 0 0 0 1.0\nv 1.5 0 0\nv 1e0 -2 3\nv 0 1 0\nvn 0 0 1\nvt 0 0\n"
      "s off\nf 1 2 3\nf 1/1 2/1 3/1 4/1\nf 1//1 3//1 -1//1\nf 1/1/1 \\\n 2/1/1 4/1/1 # four\nl 1 2\n",
      "a.obj");
  EXPECT_EQ(mesh.vertices_mm.size(), 4U);
  EXPECT_EQ(mesh.vertices_mm[2], Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(mesh.triangles, (Faces{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 2, 3}, {0, 1, 3}}));
}

std::string refusal(std::string_view text) {
  try {
    static_cast<void>(parse_obj(text, "a.obj"));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Obj, RefusesWhatIsNotThere) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(refusal(three + "f 1 2 4\n"),
            "a.obj: line 4: a corner is '4'; must be 1 … 3, a vertex before it");
  EXPECT_EQ(refusal(three + "f 1 2 -4\n"),
            "a.obj: line 4: a corner is '-4'; must be 1 … 3, a vertex before it");
  EXPECT_EQ(refusal(three + "f 1 2 0\n"),
            "a.obj: line 4: a corner is '0'; must be 1 … 3, a vertex before it");
  EXPECT_NE(refusal(three + "f 1 2 nonsense\n").find("a corner is 'nonsense'"), std::string::npos);
  EXPECT_NE(refusal(three + "f 1 2\n").find("a face has 2 corners; must be >= 3"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 nan\n").find("line 1: a coordinate is 'nan'; must be a finite number"),
            std::string::npos);
  EXPECT_NE(refusal("v 0 0\n").find("a coordinate is ''"), std::string::npos);
  EXPECT_NE(refusal(three).find("there are no faces"), std::string::npos);
  EXPECT_NE(refusal("").find("there are no faces"), std::string::npos);
}

}  // namespace
}  // namespace endowire::vessel
