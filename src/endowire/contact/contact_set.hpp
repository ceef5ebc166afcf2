#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "endowire/contact/friction.hpp"
#include "endowire/contact/local_wall.hpp"
#include "endowire/contact/wall.hpp"
#include "endowire/math/band_ldlt.hpp"
#include "endowire/rod/chain.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::contact {

/// A point of the wire's axis that may touch the wall. It belongs to the material, not to the vessel.
struct Sample {
  // Where on the wire.
  int rod = 0;
  double fraction = 0.0;  ///< 0 at joint `rod` … 1 at joint `rod + 1`
  double arc_mm = 0.0;
  double share_mm = 0.0;  ///< length of wire this sample stands for
  double radius_mm = 0.0;
  double friction = 0.0;

  // The wall as the last detection saw it.
  static constexpr int kMaxWalls = 3;
  int walls = 0;
  std::array<LocalWall, kMaxWalls> wall;
  Eigen::Vector3d detected_at_mm = Eigen::Vector3d::Zero();
  double clearance_mm = 0.0;  ///< at detection, from the field
  double lumen_radius_mm = 0.0;
  double foundation_n_per_mm2 = 0.0;
  double tip_cap_n_per_mm = 0.0;
  double stick_ratio = 1.0;
  double stiffness_n_per_mm = 0.0;
  double cap_mm = 0.0;
  double stick_stiffness_n_per_mm = 0.0;

  // Friction: where the step began, and what it remembers.
  Eigen::Vector3d start_mm = Eigen::Vector3d::Zero();  ///< position in the last converged state
  double start_spin_rad = 0.0;
  Eigen::Vector3d axial = Eigen::Vector3d::UnitX();
  Eigen::Vector3d around = Eigen::Vector3d::UnitY();
  Eigen::Vector2d anchor_mm = Eigen::Vector2d::Zero();
  double lagged_normal_n = 0.0;

  // At the state evaluated last.
  double normal_n = 0.0;
  double deflection_mm = 0.0;
  bool wrong = false;  ///< found by the last verification
  /// What the present quadratic model has of each wall: as its derivatives say, anticipated, or anticipated and dropped
  /// again, which is final: no wall comes and goes within one model.
  enum class InModel : char { derived, anticipated, dropped };
  std::array<InModel, kMaxWalls> in_model{};

  [[nodiscard]] Eigen::Vector3d position_mm(const rod::ChainShape& shape) const {
    const auto i = static_cast<std::size_t>(rod);
    return (1.0 - fraction) * shape.joints_mm[i] + fraction * shape.joints_mm[i + 1];
  }
};

/// Friction along the wire as remembered between steps, by material arc.
struct FrictionMemory {
  std::vector<double> arc_mm;
  std::vector<Eigen::Vector2d> anchor_mm;
  std::vector<double> normal_n_per_mm;

  void clear();
  void reserve(std::size_t samples);
  bool operator==(const FrictionMemory&) const = default;
};

struct ContactSpec {
  WallSpec wall;
  double stick_stiffness_ratio = 1.0;  ///< tangential over normal wall stiffness, Mindlin: 2/3 … 1
  double reach_mm = 1.0;  ///< walls nearer than this to the surface of the wire are made constraints
  double gap_error_mm =
      0.02;  ///< largest error of a gap against the field that a final state may have; within
             ///< 0.1 mm of the place of detection the field's own error, if that is larger
  double max_share_mm = 2.0;  ///< samples are at most half a lumen radius, and this, apart
};

/// Largest disagreement between the local walls and the field, where it matters for contact.
struct Verification {
  double gap_error_mm = 0.0;
  int wrong_samples = 0;
};

/// All samples of a wire: one detection, then energies and forces without further detection.
class ContactSet {
 public:
  void reserve(int rods, std::size_t samples);
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
  [[nodiscard]] bool empty() const { return samples_.empty(); }

  /// Chooses the samples of a converged shape, on joints and along rods 0 … rods_in_lumen − 1, spaced by the local
  /// lumen radius, and gives each its friction history.
  void place(const rod::MaterialLine& line, const rod::ChainMaterial& material, const rod::ChainShape& shape,
             int rods_in_lumen, const vessel::Field& field, const ContactSpec& spec,
             const FrictionMemory& memory);
  void clear() { samples_.clear(); }

  /// Detection: the walls around every sample at its place in `shape`, reached on a path that crosses no wall.
  void detect(const rod::ChainShape& shape, const vessel::Field& field, const ContactSpec& spec);
  /// Detection for the samples that the last verification found wrong, and no others: those keep the walls they have.
  /// @param share  of the way from the place of the last detection; less than 1 bisects when two detections contradict
  ///               each other, as on the two sides of a ridge
  /// @return       number of samples detected
  int redetect(const rod::ChainShape& shape, const vessel::Field& field, const ContactSpec& spec,
               double share);

  /// Adds samples where the wall reaches between two others: over a ridge, such as a carina or the edge of a facet, a
  /// straight rod dips deeper into the wall than samples on both sides of it see. They are not detected yet but marked wrong.
  /// @return  number of samples added
  int add_over_ridges(const rod::MaterialLine& line, const rod::ChainMaterial& material,
                      const rod::ChainShape& shape, const vessel::Field& field);

  /// Energy of wall and friction (with lagged normal forces); updates the samples' normal forces.
  [[nodiscard]] double energy_mj(const rod::ChainShape& shape);
  /// Adds gradient and Hessian; returns the energy.
  double add_derivatives(const rod::ChainShape& shape, math::BandMatrix& hessian,
                         std::vector<double>& gradient);

  /// Adds to a quadratic model the walls that a step would run into, takes out those that it no longer would, and, in the first model after a detection, softens those
  /// that the prediction lies deep in: their force says nothing yet. `hand_joint` is not given anything.
  /// @param step  displacement of each joint, four numbers apart
  /// @return      whether anything changed
  bool anticipate(const rod::ChainShape& shape, const std::vector<double>& step, int hand_joint,
                  math::BandMatrix& hessian, std::vector<double>& gradient);

  /// Σ|N − N_lagged| / ΣN over the samples that rub.
  [[nodiscard]] double lag_error() const;
  /// Takes the present normal forces as the lagged ones; half of the way after the first few times since a detection.
  void renew_lagged();

  /// Compares the local walls with the field at a shape and marks the samples that are off by more than spec.gap_error_mm.
  /// @param rough_field  allow the field's own stated error instead: where detections keep contradicting each other at one
  ///                     place, it is the field that is uneven
  [[nodiscard]] Verification verify(const rod::ChainShape& shape, const vessel::Field& field,
                                    const ContactSpec& spec, bool rough_field = false);

  /// Marks as wrong the samples that moved further from their place of detection than their clearance and `region_mm`.
  int mark_outside(const rod::ChainShape& shape, double region_mm);

  /// Remembers friction at a converged shape.
  void remember(const rod::ChainShape& shape, FrictionMemory& memory) const;

  /// Force of the wall on the wire at a sample, normal and friction [N].
  [[nodiscard]] Eigen::Vector3d normal_force_n(const rod::ChainShape& shape, std::size_t sample) const;
  [[nodiscard]] Eigen::Vector3d friction_force_n(const rod::ChainShape& shape, std::size_t sample) const;

 private:
  FrictionMemory memory_;        ///< of the last converged state
  rod::ChainShape start_shape_;  ///< the last converged state

  void add_between(std::size_t before, double arc_mm, const rod::MaterialLine& line,
                   const rod::ChainMaterial& material, const rod::ChainShape& shape);
  void detect_sample(const rod::ChainShape& shape, const vessel::Field& field, const ContactSpec& spec,
                     double share, Sample& sample) const;

  std::vector<Sample> samples_;
  int models_since_detection_ = 0;
  int renewals_ = 0;  ///< of lagged normal forces since the detection
};

}  // namespace endowire::contact
