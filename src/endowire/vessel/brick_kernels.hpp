#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace endowire::vessel {

/// Points and the nearest point of a surface to each, as far as it has been searched.
/// Lengths in mm, a place for each point.
struct alignas(32) PointBlock {
  static constexpr std::size_t size = 128;
  using Numbers = std::array<double, size>;
  using Integers = std::array<std::int64_t, size>;

  std::size_t count = 0;
  Numbers x, y, z;
  Numbers distance2_mm2;
  Numbers nearest_x, nearest_y, nearest_z;
  Integers triangle;
  Integers feature;     ///< as in NearestPoint
  Integers needle;      ///< not 0: a triangle was a needle from here; the answer is open
  Numbers height_mm;    ///< over the plane of the triangle's face
  Numbers distance_mm;  ///< positive inside
};

/// A triangle as the kernels want it: places in the mesh, and bounds that save work.
struct KernelTriangle {
  // coordinates [mm], three each
  const double* a;
  const double* b;
  const double* c;
  const double* normal;  ///< length one, or zero
  std::int64_t triangle;
  /// Bounds: no point of the triangle lies further than 10⁻⁹ mm off the plane through a with normal × `flat`, or beyond the sides
  /// through a, b, c; unit vectors, square to each other and to their sides, or zero where rounding lets none be told.
  double flat;
  std::array<std::array<double, 3>, 3> side;
};

// Each gives the same bits on every processor (docs/decisions/0015).

/// Fills a block up to the next multiple of four with copies of its last point, and forgets what was found.
void begin_search(PointBlock& block);

/// Tries a triangle for every point of a block: exactly what nearest_on_triangle does, but for needles, which it only marks; of
/// equals the lowest triangle.
void try_triangle(const KernelTriangle& triangle, PointBlock& block);

/// Distances, with the sign of the face's plane; where the feature is another, that is still to be put right.
void end_search(PointBlock& block);

/// Gradients of the distance at points; each has length one.
struct Slopes {
  PointBlock::Numbers x, y, z;
};

/// What the tangent planes at a cell's eight corners say of its middle, at least and at most.
struct TangentRange {
  static constexpr std::size_t cells = 64;  ///< of a brick, the last index fastest
  std::array<double, cells> low_mm, high_mm;
};
/// @param nodes    5 × 5 × 5 nodes, the last index fastest
/// @param slopes   at these
/// @param half_mm  of an edge of a cell
void tangent_range(const PointBlock& nodes, const Slopes& slopes, double half_mm, TangentRange& range);

/// (point − nearest) / distance; of no use where the distance is next to nothing.
void slopes_of(const PointBlock& nodes, Slopes& slopes);

}  // namespace endowire::vessel
