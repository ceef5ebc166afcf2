#pragma once

#include <vector>

#include "endowire/vessel/anatomy/lumen_shape.hpp"
#include "endowire/vessel/anatomy/rim.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel::anatomy {

/// How long edges are.
///
///   l = √(8 R s),  s = max(0.01 R, min(0.05 mm, 0.02 R)),  R the smallest radius of curvature of the wall there
///
/// An edge of length l between two points of a circle of radius R leaves it by s. Edges come to lie between
/// 4/5 and 4/3 of l, so that no facet leaves the wall by more than 16/9 s.
struct EdgeSizes {
  double sagitta_mm = 0.05;         ///< below the error of the distance field; finer costs triangles
  double least_over_radius = 0.01;  ///< of large vessels: 0.12 mm in an aorta of 24 mm
  double most_over_radius = 0.02;   ///< of small ones: a tube of 18 sides at least
  double growth = 0.25;             ///< change of l per distance; more makes slivers, less makes triangles
};

/// Makes the triangles of a mesh near-equilateral and of the wanted size, every vertex on F = 0.
///
/// Rounds of: edges longer than 4/3 l are split, edges shorter than 4/5 l collapsed, edges whose opposite angles
/// exceed π together are flipped, vertices are moved to the mean of their triangles and back onto the surface.
/// Vertices of a border stay on its rim. An operation that would turn a triangle over is left out.
///
/// Source    M. Botsch & L. Kobbelt, A remeshing approach to multiresolution modeling, SGP 2004
///           [BotschKobbelt2004]; departure: flips follow Delaunay's criterion instead of valences, since angles
///           are what is wanted.
/// @param mesh  manifold, outward facing, borders only along `rims`
[[nodiscard]] TriangleMesh remesh(const TriangleMesh& mesh, const LumenShape& shape,
                                  const std::vector<Rim>& rims, const EdgeSizes& sizes);

}  // namespace endowire::vessel::anatomy
