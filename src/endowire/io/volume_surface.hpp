#pragma once

#include <string>

#include "endowire/io/lumen_image.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// The surface of the lumen in an image volume, closed, in millimetres in the frame LPS.
///
/// Flying edges between the voxels, then passes of a windowed-sinc filter that takes out the steps of the grid and leaves
/// the diameter. Bias of the diameter on tubes of 4 to 12 voxels across, straight and oblique to the grid: below 0.2 voxels
/// for label maps, below 0.15 for grey levels; on tubes of 3 voxels below 0.4 and 0.25, all of it too narrow
/// (tests/unit/io/volume_surface_test.cpp).
/// A surface of more than 300,000 triangles is made as small as that.
/// @param report  what was decided is told here
/// @throws base::InputError when lumen_of does, or this build has no VTK
[[nodiscard]] vessel::TriangleMesh lumen_surface(Volume volume, const VolumeOptions& options,
                                                 const std::string& file_label, VolumeReport& report);

}  // namespace endowire::io
