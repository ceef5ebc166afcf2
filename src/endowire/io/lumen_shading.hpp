#pragma once

#include <Eigen/Core>

#include "endowire/io/png.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// A parallel projection onto a rectangle of the drawing.
struct View {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();     ///< unit
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();        ///< unit, normal to `right`
  Eigen::Vector2d corner_mm = Eigen::Vector2d::Zero();  ///< (right, up) of the left lower corner
  Eigen::Vector2d extent_mm = Eigen::Vector2d::Ones();  ///< > 0

  [[nodiscard]] Eigen::Vector2d project_mm(const Eigen::Vector3d& point_mm) const {
    return {right.dot(point_mm), up.dot(point_mm)};
  }
};

/// The vessel as tinted glass: every layer of wall takes away light, a grazing layer more than one face on.
///
///   opacity = 1 − Π (1 − a),   a = a₀ + (a₁ − a₀)(1 − |n·v|)³
///
/// Symbols  n  vertex normals, interpolated; v  direction of view; a₀, a₁  face on, grazing.
/// The product does not depend on the order of the triangles, so nothing is sorted and the size of the image
/// does not depend on how many there are.
/// @param width, height  pixels, > 0
[[nodiscard]] IndexedImage shade_lumen(const vessel::TriangleMesh& mesh, const View& view, int width,
                                       int height);

}  // namespace endowire::io
