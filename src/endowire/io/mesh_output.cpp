#include "endowire/io/mesh_output.hpp"

#include <fmt/format.h>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/vessel/stl.hpp"

#ifdef ENDOWIRE_WITH_VTK
#include "endowire/io/vtk_poly_data.hpp"
#endif

namespace endowire::io {

void check_mesh_output(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".stl") return;
#ifdef ENDOWIRE_WITH_VTK
  if (ending == ".vtp") return;
  constexpr const char* allowed = "a path that ends in .vtp or .stl";
#else
  constexpr const char* allowed =
      "a path that ends in .stl: this build has no VTK (ENDOWIRE_WITH_VTK is off)";
#endif
  throw base::InputError(fmt::format("--out is \"{}\"; must be {}", one_line(path.string()), allowed));
}

void write_mesh(const std::filesystem::path& path, const vessel::TriangleMesh& mesh) {
  check_mesh_output(path);
#ifdef ENDOWIRE_WITH_VTK
  if (path.extension() == ".vtp") return write_vtp(path, *to_vtk(mesh));
#endif
  const std::vector<std::byte> stl = vessel::write_binary_stl(mesh);
  write_file_atomically(path, {reinterpret_cast<const char*>(stl.data()), stl.size()});
}

}  // namespace endowire::io
