#include "endowire/io/surface_file.hpp"

#include <span>
#include <string_view>

#include "endowire/base/error.hpp"
#include "endowire/io/file.hpp"
#include "endowire/io/vtk_surface.hpp"
#include "endowire/vessel/obj.hpp"
#include "endowire/vessel/ply.hpp"
#include "endowire/vessel/stl.hpp"

namespace endowire::io {

vessel::TriangleMesh parse_surface(const std::string& bytes, const std::filesystem::path& path) {
  const std::string label = one_line(path.string());
  const std::string_view text = bytes;
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (text.starts_with("ply\n") || text.starts_with("ply\r") || ending == ".ply")
    return vessel::parse_ply(std::as_bytes(std::span(bytes)), label);
  if (ending == ".obj") return vessel::parse_obj(text, label);
  const std::string_view begin = text.substr(0, 4096);
  if (text.starts_with("# vtk DataFile") || ending == ".vtk") return parse_legacy_vtk(bytes, label);
  if (ending == ".vtp" || ending == ".vtu" || begin.find("<VTKFile") != std::string_view::npos)
    return parse_vtk_xml(bytes, label);
  if (ending == ".stl" || ending.empty() || text.starts_with("solid"))
    return vessel::parse_stl(std::as_bytes(std::span(bytes)), label);
  throw base::InputError(
      label +
      ": is of no format that is known by its name or its beginning; must be STL, PLY, OBJ, VTP, VTU or "
      "VTK, or an image volume: .nii, .nii.gz, .mha, .mhd, .nrrd or a folder of DICOM files");
}

}  // namespace endowire::io
