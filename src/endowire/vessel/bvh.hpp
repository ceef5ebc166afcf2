#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// The point of a triangle nearest to a query, and on which of its features it lies.
struct NearestPoint {
  double distance_mm = std::numeric_limits<double>::infinity();
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  std::int32_t triangle = -1;  ///< -1: none within the search radius
  std::uint8_t feature = 0;    ///< 0 face; 1, 2, 3 edge from corner 0, 1, 2; 4, 5, 6 corner 0, 1, 2
};

/// Nearest point of the triangle a b c, exact for degenerate triangles too.
///
/// Source  C. Ericson, Real-Time Collision Detection, 2005, §5.1.5.
/// @return squared distance [mm²]; `nearest` and `feature` as in NearestPoint
[[nodiscard]] double nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                         Eigen::Vector3d& nearest, std::uint8_t& feature);

/// A bounding volume tree over the triangles of a mesh, which it keeps a reference to.
class TriangleBvh {
 public:
  struct Hit {
    double distance_mm = std::numeric_limits<double>::infinity();
    std::int32_t triangle = -1;
  };
  /// One triangle near a ball, with its exact distance to the centre.
  struct Candidate {
    double distance_mm;
    std::int32_t triangle;
  };

  explicit TriangleBvh(const TriangleMesh& mesh);

  /// Nearest point of the surface no further than `within_mm`; of equals the triangle with the lowest index.
  /// Whoever only asks whether something is nearer than `enough_mm` gets any such point as soon as one is
  /// found.
  [[nodiscard]] NearestPoint nearest(const Eigen::Vector3d& point_mm,
                                     double within_mm = std::numeric_limits<double>::infinity(),
                                     double enough_mm = 0.0) const;

  /// All triangles no further than `radius_mm` from `centre_mm`, nearest first.
  void collect(const Eigen::Vector3d& centre_mm, double radius_mm, std::vector<Candidate>& out) const;

  /// All triangles whose own boxes touch a box, in no order.
  void touching(const Eigen::AlignedBox3d& box_mm, std::vector<std::int32_t>& out) const;

  /// First triangle along a ray between `from_mm` and `to_mm` of its length; `direction` has length one.
  [[nodiscard]] Hit cast(const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction, double from_mm,
                         double to_mm) const;

 private:
  struct Node {
    Eigen::Vector3d low, high;
    std::int32_t first;  ///< of the triangles in order_, or the right child (the left one follows its parent)
    std::int32_t count;  ///< of triangles; 0 for an inner node
  };
  /// Visits the triangles of all leaves whose boxes, and those of all nodes above them, are entered.
  template <class Enters, class Visit>
  void walk(const Enters& enters, const Visit& visit) const;
  std::int32_t build(std::int32_t begin, std::int32_t end, const std::vector<Eigen::Vector3d>& centres);

  const TriangleMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
};

}  // namespace endowire::vessel
