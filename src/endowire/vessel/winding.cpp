#include "endowire/vessel/winding.hpp"

#include <cmath>
#include <numbers>

namespace endowire::vessel {

double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point_mm) {
  double half_angles = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0) - point_mm;
    const Eigen::Vector3d b = mesh.corner(t, 1) - point_mm;
    const Eigen::Vector3d c = mesh.corner(t, 2) - point_mm;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

}  // namespace endowire::vessel
