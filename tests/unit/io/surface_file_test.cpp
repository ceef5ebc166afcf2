// Surfaces in the formats of others: the same triangles come back; what is damaged is refused.
#include "endowire/io/surface_file.hpp"

#include <gtest/gtest.h>

#include "endowire/base/error.hpp"
#include "endowire/io/mesh_output.hpp"
#include "endowire/vessel/repair.hpp"
#include "support/generated_meshes.hpp"
#include "support/surface_files.hpp"
#include "support/temporary_folder.hpp"

namespace endowire::io {
namespace {

using test::message_of;
using test::TemporaryFolder;
using test::tube;

void expect_tube(const std::string& bytes, const std::filesystem::path& path) {
  const vessel::RepairedMesh read = vessel::repair(parse_surface(bytes, path), "read");
  const vessel::RepairedMesh expected = vessel::repair(tube(), "made");
  EXPECT_EQ(read.report.triangles, expected.report.triangles) << path;
  EXPECT_NEAR(read.report.volume_mm3, expected.report.volume_mm3, 1e-3) << path;
  EXPECT_NEAR(vessel::signed_volume_mm3(read.mesh), expected.report.volume_mm3, 1e-3) << path;
}

TEST(SurfaceFile, WhatIsWrittenIsReadAgain) {
  const TemporaryFolder folder;
#ifdef ENDOWIRE_WITH_VTK
  const std::vector<const char*> names{"t.stl", "t.vtp"};
#else
  const std::vector<const char*> names{"t.stl"};
#endif
  for (const char* name : names) {
    write_mesh(folder / name, tube());
    expect_tube(test::read_text(folder / name), folder / name);
  }
  EXPECT_NE(message_of<base::InputError>([&] {
              check_mesh_output("t.obj");
            }).find("--out is \"t.obj\"; must be a path that ends in"),
            std::string::npos);
}

TEST(SurfaceFile, TheBeginningTellsTheFormatWhateverTheName) {
  const vessel::TriangleMesh mesh = tube();
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.vertices_mm.size()) +
                          "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                          std::to_string(mesh.triangles.size()) +
                          "\nproperty list uchar int vertex_index\nend_header\n" + test::points_text(mesh) +
                          test::triangles_text(mesh, "3 ");
  expect_tube(ply, "t.ply");
  expect_tube(ply, "t.dat");
  EXPECT_NE(
      message_of<base::InputError>([&] {
        static_cast<void>(parse_surface("hello\n", "t.dat"));
      }).find("t.dat: is of no format that is known by its name or its beginning; must be STL, PLY, OBJ"),
      std::string::npos);
}

TEST(SurfaceFile, FilesOfVtk) {
#ifdef ENDOWIRE_WITH_VTK
  expect_tube(test::legacy_vtk_file(), "t.vtk");
  expect_tube(test::vtu_file(), "t.vtu");
#else
  for (const char* name : {"t.vtk", "t.vtu", "t.vtp"})
    EXPECT_NE(message_of<base::InputError>([&] {
                static_cast<void>(parse_surface(
                    std::string(name) == "t.vtk" ? test::legacy_vtk_file() : test::vtu_file(), name));
              }).find("this build has no VTK"),
              std::string::npos);
#endif
}

#ifdef ENDOWIRE_WITH_VTK

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(SurfaceFile, WhatVtkWouldBelieveIsHeldAgainstTheFile) {
  const auto said = [](const std::string& bytes, const char* name) {
    return message_of<base::InputError>([&] { static_cast<void>(parse_surface(bytes, name)); });
  };
  EXPECT_NE(said(replaced(test::legacy_vtk_file(), "POINTS 86", "POINTS 4000000000"), "t.vtk")
                .find("t.vtk: POINTS is 4000000000"),
            std::string::npos);
  EXPECT_NE(said(replaced(test::legacy_vtk_file(), "3 0 1 12", "3 0 1 99"), "t.vtk")
                .find("has corner 99; must be 0 … 85"),
            std::string::npos)
      << said(replaced(test::legacy_vtk_file(), "3 0 1 12", "3 0 1 99"), "t.vtk");
  EXPECT_NE(
      said(replaced(test::vtu_file(), "NumberOfPoints=\"86\"", "NumberOfPoints=\"99999999999999\""), "t.vtu")
          .find("NumberOfPoints is"),
      std::string::npos);
  std::string deep = test::vtu_file();
  for (int k = 0; k < 100; ++k) deep.insert(deep.find("<UnstructuredGrid>"), "<a>");
  EXPECT_NE(said(deep, "t.vtu").find("more than 64 deep"), std::string::npos);
  EXPECT_NE(said(test::legacy_vtk_file().substr(0, 600), "t.vtk").rfind("t.vtk: ", 0), std::string::npos);
  EXPECT_NE(said("<VTKFile type=\"ImageData\"></VTKFile>", "t.vtp").find("must be a surface"),
            std::string::npos);
}

#endif

}  // namespace
}  // namespace endowire::io
