#include "endowire/io/lumen_shading.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace endowire::io {

namespace {

constexpr double opacity_face_on = 0.09;
constexpr double opacity_grazing = 0.62;

std::vector<double> layer_opacities(const vessel::TriangleMesh& mesh, const Eigen::Vector3d& towards_viewer) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices_mm.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d normal = mesh.area_normal(t);
    for (const std::int32_t vertex : mesh.triangles[t]) normals[static_cast<std::size_t>(vertex)] += normal;
  }
  std::vector<double> facing(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const double length = normals[v].norm();
    facing[v] = length > 0.0 ? normals[v].dot(towards_viewer) / length : 0.0;
  }
  return facing;
}

/// Adds −log(1 − a) of one triangle to the pixels whose centres it covers.
class Rasteriser {
 public:
  Rasteriser(int width, int height)
      : width_(width),
        height_(height),
        depth_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F) {}

  void add(const std::array<Eigen::Vector2d, 3>& corner, const std::array<double, 3>& facing) {
    const double area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    if (!(std::abs(area) > 1e-12)) return;
    const auto [low_x, high_x] = std::minmax({corner[0].x(), corner[1].x(), corner[2].x()});
    const auto [low_y, high_y] = std::minmax({corner[0].y(), corner[1].y(), corner[2].y()});
    const int first_x = static_cast<int>(std::max(0.0, std::ceil(low_x - 0.5)));
    const int last_x = static_cast<int>(std::min(width_ - 1.0, std::floor(high_x - 0.5)));
    const int first_y = static_cast<int>(std::max(0.0, std::ceil(low_y - 0.5)));
    const int last_y = static_cast<int>(std::min(height_ - 1.0, std::floor(high_y - 0.5)));
    for (int y = first_y; y <= last_y; ++y) {
      for (int x = first_x; x <= last_x; ++x) {
        const Eigen::Vector2d centre(x + 0.5, y + 0.5);
        const double a = cross(corner[1] - centre, corner[2] - centre) / area;
        const double b = cross(corner[2] - centre, corner[0] - centre) / area;
        const double c = 1.0 - a - b;
        if (a < 0.0 || b < 0.0 || c < 0.0) continue;
        const double grazing = 1.0 - std::min(1.0, std::abs(a * facing[0] + b * facing[1] + c * facing[2]));
        const double opacity =
            opacity_face_on + (opacity_grazing - opacity_face_on) * grazing * grazing * grazing;
        depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x)] -= static_cast<float>(std::log1p(-opacity));
      }
    }
  }

  [[nodiscard]] const std::vector<float>& depth() const { return depth_; }

 private:
  static double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u.x() * v.y() - u.y() * v.x();
  }
  int width_;
  int height_;
  std::vector<float> depth_;
};

}  // namespace

IndexedImage shade_lumen(const vessel::TriangleMesh& mesh, const View& view, int width, int height) {
  const std::vector<double> facing = layer_opacities(mesh, view.right.cross(view.up));
  Rasteriser rasteriser(width, height);
  const Eigen::Vector2d scale(width / view.extent_mm.x(), height / view.extent_mm.y());
  for (const std::array<std::int32_t, 3>& triangle : mesh.triangles) {
    std::array<Eigen::Vector2d, 3> corner;
    std::array<double, 3> corner_facing{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(triangle[k]);
      const Eigen::Vector2d flat = view.project_mm(mesh.vertices_mm[vertex]) - view.corner_mm;
      corner[k] = {flat.x() * scale.x(), height - flat.y() * scale.y()};
      corner_facing[k] = facing[vertex];
    }
    rasteriser.add(corner, corner_facing);
  }
  IndexedImage image;
  image.width = width;
  image.height = height;
  image.pixels.reserve(rasteriser.depth().size());
  for (const float depth : rasteriser.depth())
    image.pixels.push_back(
        static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::exp(-static_cast<double>(depth))))));
  for (std::size_t i = 0; i < 256; ++i) {  // light blue grey where thin, deeper where thick
    const double f = static_cast<double>(i) / 255.0;
    const auto mix = [f](double thin, double thick) {
      return static_cast<std::uint8_t>(std::lround(thin + f * (thick - thin)));
    };
    image.palette[i] = {mix(122, 38), mix(158, 70), mix(186, 98), static_cast<std::uint8_t>(i)};
  }
  return image;
}

}  // namespace endowire::io
