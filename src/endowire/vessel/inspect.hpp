#pragma once

#include <string>
#include <vector>

#include "endowire/vessel/mesh_field.hpp"
#include "endowire/vessel/repair.hpp"

namespace endowire::vessel {

/// An opening as `inspect` lists it.
struct OpeningReport {
  int number = 0;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_out = Eigen::Vector3d::Zero();
  double diameter_mm = 0.0;
  double virtual_tube_mm = 0.0;  ///< length of the tube behind it; short when another lumen is in the way
};

/// A hole that was closed.
struct PinHoleReport {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  double diameter_mm = 0.0;
};

/// All that `endowire inspect` says of a vessel.
struct VesselReport {
  std::string file;
  MeshReport mesh;
  std::vector<OpeningReport> openings;
  std::vector<PinHoleReport> pin_holes;
  FieldFacts field;
  std::vector<std::string> remarks;  ///< what a reader should know, one calm sentence each
};

/// What was found and done, one calm sentence each, with places; empty for a sound mesh.
[[nodiscard]] std::vector<std::string> repair_remarks(const RepairedMesh& repaired);

[[nodiscard]] VesselReport inspect(const std::string& file_label, const RepairedMesh& repaired,
                                   const MeshField& field);

}  // namespace endowire::vessel
