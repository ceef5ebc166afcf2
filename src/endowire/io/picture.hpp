#pragma once

#include <string>
#include <utility>
#include <vector>

#include "endowire/sim/scene.hpp"
#include "endowire/sim/snapshot.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::io {

/// One number of the headline beside the picture.
struct HeadlineNumber {
  std::string label;
  std::string value;  ///< with its unit
};

/// One point of the curve of force over insertion.
struct ForcePoint {
  double inserted_mm = 0.0;
  double push_force_n = 0.0;
};

/// What a picture shows.
struct PictureContent {
  std::string title;
  std::string subtitle;
  std::vector<HeadlineNumber> numbers;
  std::vector<ForcePoint> forces;  ///< may be empty
  Eigen::Vector3d gravity_m_per_s2 =
      Eigen::Vector3d::Zero();  ///< of the patient on the back: the front is seen along it
};

/// The wire in the vessel as one SVG: front and side view at one scale, both magnified about the tip, the
/// wire coloured by wall force per length, the tip, the access and scale bars marked, the headline numbers,
/// and the push force over insertion. Up is the long axis of the vessel, away from the access.
/// Self-contained, below 3 MB for any mesh. The wire is drawn at its width where that is above two pixels.
[[nodiscard]] std::string wire_picture_svg(const vessel::TriangleMesh& mesh, const sim::Snapshot& snapshot,
                                           const sim::Access& access, const PictureContent& content);

}  // namespace endowire::io
