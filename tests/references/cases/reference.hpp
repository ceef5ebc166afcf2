#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace endowire::test {

/// A scene whose shapes and forces are kept.
struct ReferenceScene {
  std::string name;
  std::filesystem::path file;
  bool real_vessel = false;  ///< lies in ../shared
};
[[nodiscard]] std::vector<ReferenceScene> reference_scenes();

/// The wire at one moment of a procedure.
struct Moment {
  int step = 0;  ///< counted from 1
  int rods = 0;
  double inserted_mm = 0.0;
  double push_n = 0.0;
  std::vector<Eigen::Vector3d>
      shape_mm;            ///< kShapePoints points at equal arcs, the tip first, the sheath last
  bool converged = false;  ///< all steps until here
};
inline constexpr int kShapePoints = 20;
inline constexpr int kMoments = 12;

/// How a run differs from the one that is kept.
struct Variation {
  double tolerance_scale = 1.0;  ///< of the solver's tolerances
  std::uint64_t jitter_seed =
      0;  ///< 0: none; else the hand errs in every step by up to a tolerance of the solver
  double shape_tolerance_scale = 1.0;  ///< of the rods
};

/// Plays a scene; the moments are spread evenly over its steps, the last one at the end.
[[nodiscard]] std::vector<Moment> play(const ReferenceScene& scene, const Variation& variation = {});

/// Largest distance between the same points of two shapes.
[[nodiscard]] double apart_mm(const Moment& a, const Moment& b);

/// How far a sound solver may lie from what is kept.
struct Bounds {
  double shape_mm = 0.0;
  double push_n = 0.0;
};

/// A moment that is kept, with its bounds.
///
/// Bounds      three times the largest difference among runs that are as right as the one kept, and not less than the solver's own tolerances.
///             Those runs: tolerances ten times tighter; a hand that errs in every step by up to a tolerance (1e-3 mm, 0.01°), three seeds. So
///             the bounds hold what the history of contact and friction makes of an error as large as the solver allows itself.
/// other_rods  the same, with finer and coarser rods among the runs: where the rods are others than those kept, their chords and
///             the places at which they lie change too.
/// Unstable    where these runs differ by more than kStable_mm or kStablePush a bifurcation lies before: a catheter tip slides off a
///             ridge or it does not. Nothing can be compared there, and the moment says so.
struct KeptMoment {
  Moment moment;
  std::optional<Bounds> same_rods, other_rods;  ///< none: unstable
};
inline constexpr double kStable_mm = 0.5;    ///< half a wire's width
inline constexpr double kStablePush = 0.15;  ///< of the largest push of the run

/// Plays a scene in all variations.
[[nodiscard]] std::vector<KeptMoment> keep(const ReferenceScene& scene);

[[nodiscard]] std::filesystem::path recorded_file(const ReferenceScene& scene);
[[nodiscard]] nlohmann::ordered_json to_json(const ReferenceScene& scene,
                                             const std::vector<KeptMoment>& kept);
[[nodiscard]] std::vector<KeptMoment> read_kept(const ReferenceScene& scene);

}  // namespace endowire::test
