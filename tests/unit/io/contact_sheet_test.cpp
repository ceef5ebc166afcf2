#include "endowire/io/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <set>

#include "endowire/io/canvas.hpp"
#include "endowire/vessel/centreline.hpp"
#include "support/generated_meshes.hpp"

namespace endowire::io {
namespace {

TEST(Canvas, DrawsWithinItsBorders) {
  Canvas canvas(20, 10, 0);
  canvas.line({-5.0, 5.0}, {30.0, 5.0}, 2.0, 7);
  canvas.disc({19.0, 9.0}, 3.0, 9);
  canvas.text(1, 1, "1", 1, 4);
  const auto at = [&](int x, int y) { return canvas.image().pixels[static_cast<std::size_t>(y * 20 + x)]; };
  EXPECT_EQ(at(0, 5), 7);
  EXPECT_EQ(at(10, 4), 7);
  EXPECT_EQ(at(10, 7), 0);
  EXPECT_EQ(at(19, 9), 9);
  EXPECT_EQ(at(3, 1), 4);  // the middle column of a 1
  EXPECT_EQ(at(1, 1), 0);
}

TEST(ContactSheet, ShowsWallCentrelineAndEnds) {
  const vessel::RepairedMesh tube = vessel::repair(test::open_tube(4.0, 60.0, 24, 30), "tube");
  const vessel::CentrelineTree tree = vessel::extract_centrelines(tube);
  const std::string sheet = contact_sheet_png(tube.mesh, tree, vessel::vessel_ends(tube, tree));
  const std::string bare = contact_sheet_png(tube.mesh, tree, {});
  const std::string wall = contact_sheet_png(tube.mesh, {}, {});
  const std::set<std::string> all{sheet, bare, wall};
  EXPECT_EQ(all.size(), 3U);
  for (const std::string& png : all) {
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_LT(png.size(), 1'000'000U);
    const auto word = [&](std::size_t at) {
      return static_cast<unsigned char>(png[at]) * 256 + static_cast<unsigned char>(png[at + 1]);
    };
    EXPECT_GT(word(18), 300);  // width and height
    EXPECT_LE(word(18), 1700);
    EXPECT_LE(word(22), 1100);
  }
}

}  // namespace
}  // namespace endowire::io
