#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "endowire/vessel/bvh_kernels.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// A triangle whose double area squared is no larger a part than this of what it is computed from, seen from a point, is a needle there.
inline constexpr double needle = 1e-10;

/// The point of a triangle nearest to a query, and on which of its features it lies.
struct NearestPoint {
  double distance_mm = std::numeric_limits<double>::infinity();
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  std::int32_t triangle = -1;  ///< -1: none within the search radius
  std::uint8_t feature = 0;    ///< 0 face; 1, 2, 3 edge from corner 0, 1, 2; 4, 5, 6 corner 0, 1, 2
};

/// Nearest point of the triangle a b c.
///
/// Source  C. Ericson, Real-Time Collision Detection, 2005, §5.1.5: areas tell the region of the triangle's plane. Those of a triangle of
///         height h seen from a distance D are differences of numbers (D/h)² as large. Where that leaves nothing of them, the nearest
///         point of the sides is taken, no more than h²/8D further: for h < 2·10⁻⁵ D, 10⁻¹⁰ D.
/// @return squared distance [mm²]; `nearest` and `feature` as in NearestPoint
[[nodiscard]] double nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                         Eigen::Vector3d& nearest, std::uint8_t& feature);

/// A bounding volume tree over the triangles of a mesh, which it keeps a reference to. Its bounds are in single precision, widened;
/// every answer is exact in double precision.
class TriangleBvh {
 public:
  struct Hit {
    double distance_mm = std::numeric_limits<double>::infinity();
    std::int32_t triangle = -1;
  };
  explicit TriangleBvh(const TriangleMesh& mesh);

  /// Nearest point of the surface no further than `within_mm`; of equals the triangle with the lowest index.
  /// Whoever only asks whether something is nearer than `enough_mm` gets any such point as soon as one is
  /// found.
  [[nodiscard]] NearestPoint nearest(const Eigen::Vector3d& point_mm,
                                     double within_mm = std::numeric_limits<double>::infinity(),
                                     double enough_mm = 0.0) const;

  /// All triangles whose own boxes touch a box, in no order, if they are no more than `most`.
  /// @return false when they are more; `out` is then of no use
  bool touching(const Eigen::AlignedBox3d& box_mm, std::vector<std::int32_t>& out,
                std::size_t most = std::numeric_limits<std::size_t>::max()) const;

  /// First triangle along a ray between `from_mm` and `to_mm` of its length; `direction` has length one.
  [[nodiscard]] Hit cast(const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction, double from_mm,
                         double to_mm) const;

 private:
  /// Eight parts of the mesh; a part with a number below zero is a leaf, -1 - number.
  struct Node {
    EightBoxes boxes;
    std::array<std::int32_t, bvh_width> part;
    unsigned used;  ///< a bit for each part there is
  };
  struct Leaf {
    EightDiscs discs;
    std::array<std::int32_t, bvh_width> triangle;
    unsigned used;
  };
  struct Range {
    std::int32_t begin, end;  ///< of the triangles in order of the tree
  };
  class Builder;

  /// Goes through the parts of the tree, of a node's those with the smallest bound first.
  /// @param enter  EightBoxes and room for bounds to the bits of the parts that are worth it
  /// @param visit  a leaf; false ends the walk
  /// @param lost   whether a part of this bound is no longer worth it
  template <class Enter, class Visit, class Lost>
  void walk(const Enter& enter, const Visit& visit, const Lost& lost) const;
  [[nodiscard]] std::array<float, 3> near_origin(const Eigen::Vector3d& point_mm) const;

  const TriangleMesh& mesh_;
  const BvhKernels& kernels_;
  Eigen::Vector3d origin_mm_ = Eigen::Vector3d::Zero();  ///< of coordinates in single precision
  double extent_mm_ = 0.0;                               ///< the largest of them
  std::vector<Node> nodes_;                              ///< the first is the root; none without triangles
  std::vector<Leaf> leaves_;
};

}  // namespace endowire::vessel
