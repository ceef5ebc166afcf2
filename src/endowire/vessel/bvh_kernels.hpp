#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace endowire::vessel {

// What a tree of triangles asks of eight boxes or eight triangles at a time, in single precision. It only saves work: bounds are
// widened by more than rounding can move anything, so that every answer, found in double precision, is the same on every machine.

constexpr std::size_t bvh_width = 8;
using EightFloats = std::array<float, bvh_width>;

struct alignas(32) EightBoxes {
  std::array<EightFloats, 3> low, high;  ///< by axis
};

/// A disc around each of eight triangles, by middle, normal and radius. A normal of zero stands for a ball.
struct alignas(32) EightDiscs {
  std::array<EightFloats, 3> middle, normal;  ///< by axis
  EightFloats radius;
};

struct BvhRay {
  std::array<float, 3> from, direction, inverse;
  float begin, end;  ///< along it
};

/// Each function gives one bit a box or disc, the first one lowest.
struct BvhKernels {
  /// Boxes whose squared distance to a point, understated, is no more than `within2`.
  unsigned (*near_boxes)(const EightBoxes& boxes, const std::array<float, 3>& point, float within2,
                         EightFloats& distance2);
  /// Discs that may come within `reach` of a point.
  unsigned (*near_discs)(const EightDiscs& discs, const std::array<float, 3>& point, float reach);
  /// Boxes that a ray meets, and where it enters them.
  unsigned (*hit_boxes)(const EightBoxes& boxes, const BvhRay& ray, EightFloats& enters);
  /// Discs whose balls, widened by `margin`, a line meets.
  unsigned (*hit_discs)(const EightDiscs& discs, const BvhRay& ray, float margin);
};
[[nodiscard]] const BvhKernels& bvh_kernels();

}  // namespace endowire::vessel
