#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "endowire/vessel/anatomy/plan.hpp"

namespace endowire::vessel::anatomy {

/// A narrowing or widening of one vessel, concentric and spindle-shaped.
struct LesionRequest {
  enum class Kind : std::uint8_t { stenosis, aneurysm };
  Kind kind = Kind::stenosis;
  std::string branch;      ///< name of the vessel
  double arc_mm = 0.0;     ///< of its middle, along the vessel from where it leaves its parent
  double length_mm = 0.0;  ///< of the whole, shoulders included
  double percent = 0.0;    ///< by which the diameter in the middle is less, or more
};

// Ranges. A stenosis by diameter as NASCET counts it; above 95 % no wire passes. An aneurysm begins at half as wide
// again as the vessel; four times is the widest reported for an aorta of 20 mm. Estimates for the lengths.
inline constexpr double stenosis_least_percent = 10.0;
inline constexpr double stenosis_most_percent = 95.0;
inline constexpr double aneurysm_least_percent = 20.0;
inline constexpr double aneurysm_most_percent = 300.0;
inline constexpr double lesion_least_mm = 4.0;
inline constexpr double lesion_most_mm = 150.0;
/// Of the shoulders, change of the radius along the axis: 45°. Steeper ones are no distance to an axis any more, and ask
/// for triangles without number.
inline constexpr double lesion_steepest = 1.0;
/// What a stenosis leaves of the radius at least: half a wire of 0.014 inch, and room for it.
inline constexpr double least_radius_mm = 0.3;

/// Puts lesions on the vessels of a plan. A vessel that shares the beginning of its axis with another shares its
/// lesions there.
/// @param stenosis_field, aneurysm_field  begin messages, followed by the number among their kind and the field:
///        `scene.toml: vessel.stenosis` gives `scene.toml: vessel.stenosis[0].arc_mm is 300; must be …`
/// @throws base::InputError for an unknown branch and a number outside its range
void apply_lesions(Plan& plan, const std::vector<LesionRequest>& lesions, const std::string& stenosis_field,
                   const std::string& aneurysm_field);

}  // namespace endowire::vessel::anatomy
