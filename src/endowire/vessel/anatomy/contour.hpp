#pragma once

#include "endowire/vessel/anatomy/lumen_shape.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel::anatomy {

/// The surface F = 0 of a shape as a closed mesh, outward facing: a first mesh, to be made even by `remesh`.
///
/// Dual contouring on a grid of cubes. Cells that the surface passes are found from one to the next, beginning
/// at each tube, so that only they cost anything. Each sheet of the surface within a cell gets a vertex, the
/// mean of its crossings with the edges of the cell; each grid edge that the surface crosses becomes a
/// quadrilateral, cut along its shorter diagonal. Where a face has four crossings its inside corners are kept
/// apart in both of its cells, unless one sheet would pass the face twice in both: then they are joined.
///
/// Source  G. M. Nielson, Dual marching cubes, IEEE Visualization 2004 [Nielson2004]; manifold by
///         R. Wenger, Isosurfaces, CRC Press 2013 [Wenger2013].
/// Domain  tubes wider than 1.2 spacings. Everything depends on the shape and the spacing alone.
[[nodiscard]] TriangleMesh contour(const LumenShape& shape, double spacing_mm);

}  // namespace endowire::vessel::anatomy
