#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "triangle_tree.hpp"

namespace crossings {

/// A hole in the surface as it is in the file.
struct Hole {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  double diameter_mm = 0.0;      ///< of the circle of equal area
  double lumen_radius_mm = 0.0;  ///< of the vessel behind it
  bool opening = false;          ///< wide enough to be an end of the vessel: a wire may leave here
};

/// The lumen that a surface bounds.
///
/// The triangles are taken as in the file and only turned to agree with their neighbours. Every hole is
/// closed by a fan of triangles: an *opening*, at least 0.5 mm wide and 0.4 of the lumen radius behind it, by
/// a gate that a wire may pass; a *pin hole* by a piece of wall. The surface is then closed, so the winding
/// number is ±1 in the lumen and 0 outside, whichever way the normals point.
///
/// Domain   the surface of a lumen. A vessel modelled with a thickness, outer surface included, is not one.
class Lumen {
 public:
  explicit Lumen(const std::vector<Triangle>& surface);
  /// @throws InputError when the file holds no usable triangles.
  [[nodiscard]] static Lumen read(const std::string& path, double mm_per_unit);

  [[nodiscard]] const TriangleTree& wall() const { return wall_; }
  [[nodiscard]] const TriangleTree& gates() const { return gates_; }
  [[nodiscard]] const std::vector<Hole>& holes() const { return holes_; }
  [[nodiscard]] int triangles() const { return triangles_; }

  [[nodiscard]] bool inside(const Eigen::Vector3d& point_mm) const;
  /// True when an outside point sees the middle of an opening less than two of its diameters away: the
  /// virtual continuation of the vessel, from where a wire may enter.
  [[nodiscard]] bool before_opening(const Eigen::Vector3d& point_mm) const;

 private:
  TriangleTree wall_;   // the file's triangles and the covers of pin holes
  TriangleTree gates_;  // the covers of openings
  std::vector<Hole> holes_;
  int triangles_ = 0;
};

}  // namespace crossings
