#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/contact/contact_model.hpp"
#include "endowire/contact/contact_spec.hpp"
#include "endowire/contact/friction_memory.hpp"
#include "endowire/contact/sample.hpp"
#include "endowire/math/band_ldlt.hpp"
#include "endowire/rod/chain.hpp"
#include "endowire/vessel/field.hpp"

namespace endowire::contact {

/// Disagreement between the local walls and the field, where it matters for contact.
struct Verification {
  double gap_error_mm = 0.0;  ///< the largest
  int wrong_samples = 0;
  bool corrected = false;  ///< some wall that touches was off by more than rounding of the solution
};

/// All samples of a wire: one detection, then energies and forces without further detection.
class ContactSet {
 public:
  void reserve(int rods, std::size_t samples);
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
  [[nodiscard]] bool empty() const { return samples_.empty(); }

  /// The converged state that a step starts from: where friction is measured from, and what it remembers. No samples are left.
  void begin(const Wire& wire, const FrictionMemory& memory);
  /// Chooses the samples of the shape that the step is expected to end near, on joints and along rods 0 … rods_in_lumen − 1, and gives
  /// each its start and its friction history.
  ///
  /// They are half a lumen radius apart or spec.max_share_mm, and closer, down to kFinest_mm, where the wire is about to touch and its distance to
  /// the wall is not the same all along: over a ridge the force of the wall acts on a short piece of wire, and samples further apart
  /// than that piece is long would feel it or not by where they happen to lie.
  /// @param advanced_mm  by which the wire has come forward since begin(): it finds the walls that pressed on what was before it
  void place(const Wire& wire, int rods_in_lumen, const vessel::Field& field, const ContactSpec& spec,
             double advanced_mm = 0.0);
  static constexpr double kFinest_mm = 0.125;
  void clear() { samples_.clear(); }
  /// The length of a rod has changed by wire that flows through its end on the hand's side: its samples, which belong to the material, are
  /// put at their arcs again.
  /// @param rod  the last one that has samples
  void fit_rod(int rod, const rod::ChainMaterial& material);

  /// Detection: every sample finds the walls around its place in the shape, reached on a path that crosses no wall.
  void detect(const Wire& wire, const vessel::Field& field, const ContactSpec& spec);
  /// Detection for the samples that the last verification found wrong, and no others: those keep the walls they have.
  /// @return  number of samples detected
  int redetect(const Wire& wire, const vessel::Field& field, const ContactSpec& spec);
  /// Detection for all samples, each from the place of its last one.
  void detect_again(const Wire& wire, const vessel::Field& field, const ContactSpec& spec);

  /// Adds samples where the wall reaches between two others: over a ridge, such as a carina or the edge of a facet, a
  /// straight rod dips deeper into the wall than samples on both sides of it see. They are not detected yet but marked wrong.
  /// @return  number of samples added
  /// @param rough_field  as in verify()
  int add_over_ridges(const Wire& wire, const vessel::Field& field, bool rough_field = false);

  /// Energy of wall and friction (with lagged normal forces); updates the samples' normal forces.
  [[nodiscard]] double energy_mj(const rod::ChainShape& shape);
  /// The contacts around a shape: adds the gradient of their energy, fills the model, and adds to the Hessian what the
  /// curvature of the walls contributes, which the model leaves out. Updates the samples' normal forces.
  /// @return  energy, that of energy_mj()
  double linearise(const rod::ChainShape& shape, const GuidedJoint& guided, math::BandMatrix& hessian,
                   std::vector<double>& gradient, ContactModel& model);
  /// Takes over from a model which walls touch.
  void recall_closed(const ContactModel& model);
  /// Gives the walls of a model the depths that they have in another shape, as if the motion to it were linear.
  void correct(const rod::ChainShape& there, const std::vector<double>& motion, const GuidedJoint& guided,
               ContactModel& model) const;

  /// Σ|N − N_lagged| / ΣN over the samples that rub.
  [[nodiscard]] double lag_error() const;
  /// Takes the present normal forces as the lagged ones; after a few times since a detection, as far beyond or short of them as
  /// the last changes suggest.
  void renew_lagged();

  /// Compares the local walls with the field at a shape. Marks the samples that are off by more than spec.gap_error_mm; gives
  /// the others, where they touch one wall, the height and the slope of the field: an equilibrium that this leaves as it was is
  /// one of the field itself, wherever detection took place.
  /// @param rough_field  allow the field's own stated error instead: where detections keep contradicting each other at one
  ///                     place, it is the field that is uneven
  /// @param correct      whether walls may be changed
  [[nodiscard]] Verification verify(const Wire& wire, const vessel::Field& field, const ContactSpec& spec,
                                    bool rough_field = false, bool correct = true);

  /// Marks as wrong the samples that moved further from their place of detection than their clearance and `region_mm`.
  int mark_outside(const rod::ChainShape& shape, double region_mm);

  /// Remembers friction at a converged shape.
  void remember(const rod::ChainShape& shape, FrictionMemory& memory) const;

  /// Force of the wall on the wire at a sample, normal and friction [N].
  [[nodiscard]] Eigen::Vector3d normal_force_n(const rod::ChainShape& shape, std::size_t sample) const;
  [[nodiscard]] Eigen::Vector3d friction_force_n(const rod::ChainShape& shape, std::size_t sample) const;

 private:
  class Placement;
  void add_between(const Wire& wire, std::size_t before, double arc_mm);

  std::vector<Sample> samples_;
  [[nodiscard]] Eigen::Vector3d start_position_mm(const Sample& sample) const;

  FrictionMemory memory_;        ///< of the last converged state
  rod::ChainShape start_shape_;  ///< the last converged state
  std::vector<double> start_arc_mm_;
  double advanced_mm_ = 0.0;
  int renewals_ = 0;         ///< of lagged normal forces since the detection
  double relaxation_ = 1.0;  ///< of the last of them
};

}  // namespace endowire::contact
