// Thousands of damaged files of every format that is read here: each is read or refused in one line, none crashes, and none
// takes memory after its claims. Seeded: the same files in every run. The sanitizers watch.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>

#include "endowire/base/error.hpp"
#include "endowire/io/dicom_series.hpp"
#include "endowire/io/meta_image.hpp"
#include "endowire/io/nifti.hpp"
#include "endowire/io/nrrd.hpp"
#include "endowire/io/surface_file.hpp"
#include "endowire/vessel/random.hpp"
#include "endowire/vessel/stl.hpp"
#include "support/generated_meshes.hpp"
#include "support/surface_files.hpp"
#include "support/volume_files.hpp"

namespace endowire::io {
namespace {

constexpr int damaged_files = 3000;
constexpr int damaged_files_for_vtk = 300;  // each in a process of its own

io::Volume small_volume() {
  test::Grid grid;
  grid.size = {6, 5, 4};
  return test::volume_of(grid, [](const Eigen::Vector3d& p) { return 10.0 * p.x() + p.z(); });
}

std::string obj_file() {
  return "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\nf 1 3 2\nf 1/1 2/2 4/3\nf 2//1 3//1 4//1\nf -4 -1 -2\n";
}

std::string ply_file() {
  std::string file =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float number : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
    file.append(reinterpret_cast<const char*>(&number), 4);
  file += '\3';
  for (const std::int32_t corner : {0, 1, 2}) file.append(reinterpret_cast<const char*>(&corner), 4);
  return file;
}

std::string stl_file(bool ascii) {
  const vessel::TriangleMesh mesh = test::closed_tube(4.0, 20.0, 5, 2);
  if (ascii) return vessel::write_ascii_stl(mesh);
  const std::vector<std::byte> bytes = vessel::write_binary_stl(mesh);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Reader {
  const char* name;
  std::string file;
  void (*read)(const std::string&);
};

std::vector<Reader> readers() {
  const io::Volume volume = small_volume();
  std::vector<Reader> readers{
      {"stl", stl_file(false), [](const std::string& f) { static_cast<void>(parse_surface(f, "a.stl")); }},
      {"stl_text", stl_file(true),
       [](const std::string& f) { static_cast<void>(parse_surface(f, "a.stl")); }},
      {"obj", obj_file(), [](const std::string& f) { static_cast<void>(parse_surface(f, "a.obj")); }},
      {"ply", ply_file(), [](const std::string& f) { static_cast<void>(parse_surface(f, "a.ply")); }},
      {"nifti", test::nifti_file(volume),
       [](const std::string& f) { static_cast<void>(parse_nifti(f, "a.nii")); }},
      {"nifti_packed", test::packed(test::nifti_file(volume)),
       [](const std::string& f) { static_cast<void>(parse_nifti(f, "a.nii.gz")); }},
      {"meta_image", test::meta_image_file(volume, true),
       [](const std::string& f) { static_cast<void>(parse_meta_image(f, "a.mha", "/nowhere")); }},
      {"nrrd", test::nrrd_file(volume, true),
       [](const std::string& f) { static_cast<void>(parse_nrrd(f, "a.nrrd", "/nowhere")); }},
      {"dicom", test::dicom_file(volume, 1),
       [](const std::string& f) { static_cast<void>(parse_dicom(f, "a.dcm")); }}};
#ifdef ENDOWIRE_WITH_VTK
  readers.push_back({"vtk_legacy", test::legacy_vtk_file(),
                     [](const std::string& f) { static_cast<void>(parse_surface(f, "a.vtk")); }});
  readers.push_back({"vtk_xml", test::vtu_file(),
                     [](const std::string& f) { static_cast<void>(parse_surface(f, "a.vtu")); }});
#endif
  return readers;
}

/// Bits turned, bytes set to what counts like to be, pieces cut out, doubled and swapped.
std::string damaged(std::string file, vessel::SplitMix& random) {
  const auto somewhere = [&](std::size_t size) {
    return static_cast<std::size_t>(random.next() % (size + 1));
  };
  const int times = 1 + static_cast<int>(random.next() % 6);
  for (int n = 0; n < times && !file.empty(); ++n) {
    const std::size_t at = random.next() % file.size();
    switch (random.next() % 7) {
      case 0:
        file[at] = static_cast<char>(file[at] ^ (1 << random.next() % 8));
        break;
      case 1:
        file[at] = "\x00\xff\x7f\x80 \n9-"[random.next() % 8];
        break;
      case 2:
        file.erase(at, somewhere(40));
        break;
      case 3:
        file.resize(at);
        break;
      case 4:
        file.insert(at, file.substr(random.next() % file.size(), somewhere(60)));
        break;
      case 5:
        for (std::size_t k = 0; k < 4 && at + k < file.size(); ++k)
          file[at + k] = static_cast<char>(random.next());
        break;
      default:
        file.insert(at, random.next() % 2 == 0 ? "99999999999" : "nan");
    }
  }
  return file;
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

class DamagedFile : public testing::TestWithParam<Reader> {
 public:
  friend void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }
};

TEST_P(DamagedFile, IsReadOrRefusedInOneLine) {
  const Reader& reader = GetParam();
  ASSERT_NO_THROW(reader.read(reader.file));
  vessel::SplitMix random(20260101);
  const double before_mb = peak_mb();
  int refused = 0;
  const bool by_vtk = std::string(reader.name).rfind("vtk", 0) == 0;
  const int files = by_vtk ? damaged_files_for_vtk : damaged_files;
  for (int n = 0; n < files; ++n) {
    const std::string file = damaged(reader.file, random);
    try {
      reader.read(file);
    } catch (const base::InputError& error) {
      ++refused;
      const std::string text = error.what();
      ASSERT_EQ(text.find('\n'), std::string::npos) << n << ": " << text;
      ASSERT_TRUE(text.rfind("a.", 0) == 0 || text.rfind("/nowhere", 0) == 0) << n << ": " << text;
    }
  }
  EXPECT_GT(refused, files / 20);
  EXPECT_LT(peak_mb() - before_mb, 200.0);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFile, testing::ValuesIn(readers()),
                         [](const auto& p) { return std::string(p.param.name); });

}  // namespace
}  // namespace endowire::io
