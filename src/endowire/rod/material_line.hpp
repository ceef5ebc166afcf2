#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/rod/instrument.hpp"

namespace endowire::rod {

/// The instrument as functions of the material arc s [mm] from the tip, and their exact integrals.
///
/// Rigidities over a stretch are those of springs in series: length over the integral of the compliance, in
/// closed form for linear tapers. Behind the last section the last values hold.
class MaterialLine {
 public:
  /// @throws base::InputError as Instrument::validate.
  explicit MaterialLine(Instrument instrument);

  [[nodiscard]] const Instrument& instrument() const { return instrument_; }
  [[nodiscard]] double length_mm() const { return length_mm_; }

  [[nodiscard]] double flexural_rigidity_n_mm2(double from_mm, double to_mm) const;
  [[nodiscard]] double torsional_rigidity_n_mm2(double from_mm, double to_mm) const;
  [[nodiscard]] double axial_rigidity_n(double from_mm, double to_mm) const;
  /// Turn of the unloaded wire from one arc to the other, in the material frame [rad].
  [[nodiscard]] Eigen::Vector2d rest_bend_rad(double from_mm, double to_mm) const;
  [[nodiscard]] double mass_g(double from_mm, double to_mm) const;
  [[nodiscard]] double volume_mm3(double from_mm, double to_mm) const;
  /// Smallest kink curvature of the stretch.
  [[nodiscard]] double kink_per_mm(double from_mm, double to_mm) const;

  // At one arc.
  [[nodiscard]] double flexural_rigidity_n_mm2(double arc_mm) const;
  [[nodiscard]] double torsional_rigidity_n_mm2(double arc_mm) const;
  [[nodiscard]] double radius_mm(double arc_mm) const;
  [[nodiscard]] double friction(double arc_mm) const;
  /// κ0 as a vector in the material frame.
  [[nodiscard]] Eigen::Vector2d rest_curvature_per_mm(double arc_mm) const;

 private:
  [[nodiscard]] std::size_t section_at(double arc_mm) const;
  [[nodiscard]] double taper_at(const Taper Section::*taper, double arc_mm) const;
  template <typename Integrand>
  double over_sections(double from_mm, double to_mm, Integrand integrand) const;

  Instrument instrument_;
  std::vector<double> start_mm_;  ///< arc at which each section begins
  double length_mm_ = 0.0;
};

}  // namespace endowire::rod
