#include "endowire/io/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace endowire::io {
namespace {

vessel::TriangleMesh tube(int around, int along, double radius_mm, double length_mm) {
  vessel::TriangleMesh mesh;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.vertices_mm.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle),
                                    length_mm * j / along);
    }
  }
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i;
      const int b = j * around + (i + 1) % around;
      mesh.triangles.push_back({a, b, a + around});
      mesh.triangles.push_back({b, b + around, a + around});
    }
  }
  return mesh;
}

sim::Snapshot straight_wire(double length_mm) {
  sim::Snapshot snapshot;
  for (int i = 0; i <= 20; ++i) {
    sim::SnapshotPoint point;
    point.arc_mm = length_mm * i / 20.0;
    point.position_mm = {0.0, 0.0, length_mm - point.arc_mm};
    point.radius_mm = 0.4;
    point.wall_force_n_per_mm = 0.003 * i;
    snapshot.points.push_back(point);
  }
  return snapshot;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t number = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++number;
  return number;
}

TEST(Picture, ShowsWireMarksScaleAndNumbers) {
  PictureContent content{
      "a <title> & more", "below", {{"Inserted", "200 mm"}, {"Crossings", "0"}}, {}, {0, 9.81, 0}};
  for (int i = 0; i < 5000; ++i) content.forces.push_back({0.04 * i, 0.001 * i});
  const std::string svg = wire_picture_svg(tube(24, 40, 8.0, 300.0), straight_wire(200.0), {}, content);
  EXPECT_NE(svg.find("a &lt;title&gt; &amp; more"), std::string::npos);
  EXPECT_EQ(count(svg, ">access<"), 2U);
  EXPECT_EQ(count(svg, ">tip<"), 4U);
  EXPECT_EQ(count(svg, "data:image/png;base64,"), 4U);
  EXPECT_NE(svg.find(">200 mm<"), std::string::npos);
  EXPECT_NE(svg.find(">0.1<"), std::string::npos) << "the colour scale ends at the next round number";
  EXPECT_NE(svg.find("Push force over inserted length"), std::string::npos);
  EXPECT_LT(svg.size(), 3'000'000U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
}

TEST(Picture, SizeDoesNotGrowWithTheMesh) {
  const sim::Snapshot wire = straight_wire(200.0);
  const std::string coarse = wire_picture_svg(tube(24, 40, 8.0, 300.0), wire, {}, {});
  const std::string fine = wire_picture_svg(tube(400, 400, 8.0, 300.0), wire, {}, {});
  EXPECT_LT(fine.size(), 3'000'000U);
  EXPECT_LT(static_cast<double>(fine.size()), 1.5 * static_cast<double>(coarse.size()));
}

TEST(Picture, AWireStillInTheSheathAndNoWeightAreDrawnToo) {
  const std::string svg = wire_picture_svg(tube(12, 4, 2.0, 20.0), {}, {}, {});
  EXPECT_EQ(count(svg, ">access<"), 2U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace endowire::io
