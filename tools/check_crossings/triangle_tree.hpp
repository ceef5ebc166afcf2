#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

namespace crossings {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// What a segment meets. A hit closer than 1e-7 (in barycentric or segment parameter) to an edge or to an end
/// of the segment is `unsure`: it counts as a hit, but parity must not be built on it.
struct SegmentHits {
  int sure = 0;
  int unsure = 0;
  double first = std::numeric_limits<double>::infinity();  ///< smallest parameter of a hit, 0 … 1
  double last = -std::numeric_limits<double>::infinity();  ///< largest

  [[nodiscard]] bool any() const { return sure + unsure > 0; }
  void operator+=(const SegmentHits& other);
};

struct NearestPoint {
  double distance_mm = std::numeric_limits<double>::infinity();
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
};

[[nodiscard]] Eigen::Vector3d nearest_on_triangle(const Triangle& triangle, const Eigen::Vector3d& point_mm);
[[nodiscard]] SegmentHits hits_of(const Triangle& triangle, const Eigen::Vector3d& from_mm,
                                  const Eigen::Vector3d& to_mm);

/// A binary tree of boxes over triangles: exact nearest point, exact segment hits, generalized winding
/// number.
///
/// Winding number   w(p) = Σ Ω_t(p) / 4π, Ω of [VanOosteromStrackee1983]; clusters farther away than twice
///                  their radius count as one dipole [Barill2018]. Its error, a few hundredths, is far below
///                  the half that separates inside from outside of a closed surface.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::vector<Triangle> triangles);

  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  [[nodiscard]] const Triangle& triangle(int index) const {
    return triangles_[static_cast<std::size_t>(index)];
  }

  /// Nearest point within `cap_mm`; infinite distance when there is none. With `facing` not zero only
  /// triangles whose normal has a positive component along it are considered.
  [[nodiscard]] NearestPoint nearest(const Eigen::Vector3d& point_mm,
                                     double cap_mm = std::numeric_limits<double>::infinity(),
                                     const Eigen::Vector3d& facing = Eigen::Vector3d::Zero()) const;
  /// Indices of all triangles within `radius_mm` of the point, replacing what `out` held.
  void within(const Eigen::Vector3d& point_mm, double radius_mm, std::vector<int>& out) const;
  [[nodiscard]] SegmentHits hits(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm) const;
  [[nodiscard]] double winding(const Eigen::Vector3d& point_mm) const;

 private:
  struct Node {
    Eigen::Vector3d low, high;    // box
    Eigen::Vector3d centre;       // area-weighted
    Eigen::Vector3d area_vector;  // sum of ½ (b − a) × (c − a)
    double radius = 0.0;          // of the ball about `centre` that holds all triangles
    int first = 0;                // first triangle
    int count = 0;                // > 0 in leaves
    int right = 0;                // second child; the first follows its parent
  };
  int build(int first, int last, std::vector<int>& order, const std::vector<Triangle>& input);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace crossings
