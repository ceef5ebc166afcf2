#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "endowire/vessel/anatomy/lesion.hpp"
#include "endowire/vessel/anatomy/parameters.hpp"
#include "endowire/vessel/anatomy/plan.hpp"
#include "endowire/vessel/mesh.hpp"

namespace endowire::vessel {

/// An anatomy that can be made in code.
struct Generator {
  std::string name;
  std::string meaning;
  std::span<const anatomy::Parameter> parameters;
};

/// All of them.
[[nodiscard]] std::vector<Generator> generators();

/// One of them.
/// @param field  begins the message
/// @throws base::InputError `field` is "heart"; must be one of …
[[nodiscard]] Generator generator_named(const std::string& name, const std::string& field);

/// What to make.
struct GenerateRequest {
  std::string name;
  /// Draws every number that `settings` does not give; else the defaults hold.
  std::optional<std::uint64_t> seed;
  anatomy::Settings settings;
  std::vector<anatomy::LesionRequest> lesions;
  /// Openings at the vessels' ends, which a wire can leave by; else half balls close them.
  bool open_ends = false;

  // How messages name the fields, as `scene.toml: vessel.` and so on.
  std::string generator_field = "generate";
  std::string settings_prefix = "parameters.";
  std::string stenosis_field = "stenosis";  ///< followed by [0] and the field
  std::string aneurysm_field = "aneurysm";
};

/// A named point inside a generated vessel, on its axis.
struct Landmark {
  std::string name;
  std::string branch;
  double arc_mm = 0.0;  ///< along the branch, from where it leaves its parent
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double lumen_radius_mm = 0.0;
};

/// A vessel made in code, and all that is known about it.
struct GeneratedVessel {
  TriangleMesh mesh;  ///< manifold, facing outward; closed unless openings were asked for
  Eigen::Vector3d access_position_mm = Eigen::Vector3d::Zero();  ///< on the axis
  Eigen::Vector3d access_direction =
      Eigen::Vector3d::Zero();  ///< into the vessel, along the axis, length one
  double route_mm = 0.0;        ///< along the axis from the access to the end of the main route
  std::vector<Landmark> landmarks;
  std::deque<anatomy::Branch>
      branches;  ///< true axes and calibres: what an extracted centreline is held against
  struct Number {
    std::string name;
    double value;
  };
  std::vector<Number> parameters;  ///< all that it was made with
};

/// Makes a vessel. Equal requests give equal bits on every machine.
///
/// A seed whose draw is impossible (vessels that would touch, an ascending aorta shorter than its arch) is drawn
/// again, from numbers of its own.
/// @throws base::InputError one line that names the field, its value and what is allowed
[[nodiscard]] GeneratedVessel generate(const GenerateRequest& request);

}  // namespace endowire::vessel
