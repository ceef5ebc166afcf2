#pragma once

#include <Eigen/Core>
#include <vector>

#include "endowire/rod/instrument.hpp"

namespace endowire::rod {

/// Length over which rest curvature and compliance change from one section to the next.
///
/// A tip is shaped over a mandrel, tubes are fused and cores ground over some length, and a wire of about 1 mm cannot change within less than about its
/// own diameter on either side. Without it the energy has a kink in the length of wire inserted, where a border of sections lies at the end
/// of the sheath, and Newton's method goes to and fro. Much longer, and tips of a few millimetres are no longer arcs.
inline constexpr double kRamp_mm = 2.0;

/// The instrument as functions of the material arc s [mm] from the tip, and their exact integrals.
///
/// Rigidities over a stretch are those of springs in series: length over the integral of the compliance. Behind the last section the last values hold.
///
/// Neither rest curvature nor compliance jump where sections meet: they change linearly over kRamp_mm, half of it on either side, and over
/// less where a section is shorter than that. The turn of the unloaded wire and the compliance over both sections stay what the sections
/// say. Where two sections meet with one value nothing is added.
class MaterialLine {
 public:
  /// @throws base::InputError as Instrument::validate.
  explicit MaterialLine(Instrument instrument);

  [[nodiscard]] const Instrument& instrument() const { return instrument_; }
  [[nodiscard]] double length_mm() const { return length_mm_; }
  /// From here on the unloaded wire is straight; infinite when it never is.
  [[nodiscard]] double curved_to_mm() const { return curved_to_mm_; }

  /// EI₁; the same in both directions but where a section is not round.
  [[nodiscard]] double flexural_rigidity_n_mm2(double from_mm, double to_mm) const;
  /// EI₁, EI₂.
  [[nodiscard]] Eigen::Vector2d flexural_rigidities_n_mm2(double from_mm, double to_mm) const;
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
  [[nodiscard]] Eigen::Vector2d flexural_rigidities_n_mm2(double arc_mm) const;
  [[nodiscard]] double torsional_rigidity_n_mm2(double arc_mm) const;
  [[nodiscard]] double radius_mm(double arc_mm) const;
  [[nodiscard]] double friction(double arc_mm) const;
  [[nodiscard]] double linear_density_g_per_mm(double arc_mm) const;
  [[nodiscard]] double kink_per_mm(double arc_mm) const;
  [[nodiscard]] double radiopacity(double arc_mm) const;
  /// κ0 as a vector in the material frame.
  [[nodiscard]] Eigen::Vector2d rest_curvature_per_mm(double arc_mm) const;
  /// dκ0/ds.
  [[nodiscard]] Eigen::Vector2d rest_curvature_slope_per_mm2(double arc_mm) const;

 private:
  /// Where two sections meet, by how much what lies on the hand's side is more: spread over ± a half width.
  struct Ramp {
    double half_mm = 0.0;
    Eigen::Vector2d rest_per_mm = Eigen::Vector2d::Zero();  ///< κ0
    double compliance_half_mm = 0.0;  ///< less than half_mm where compliance would fall below 0
    Eigen::Vector4d compliance = Eigen::Vector4d::Zero();  ///< 1/EI₁, 1/EI₂, 1/GJ, 1/EA
  };
  /// The border next to an arc, and how far behind it the arc lies; none at the ends.
  struct NearBorder {
    const Ramp* ramp = nullptr;
    double behind_mm = 0.0;
  };

  /// The tapers of a section, ready to be evaluated.
  struct Profiles {
    Profile bending, twisting, stretching, radius, density, kink, radiopacity;
    explicit Profiles(const Section& section);
  };

  [[nodiscard]] std::size_t section_at(double arc_mm) const;
  [[nodiscard]] NearBorder border_near(double arc_mm) const;
  [[nodiscard]] Eigen::Vector2d ramp_bend_rad(double arc_mm) const;
  [[nodiscard]] Eigen::Vector2d section_rest_per_mm(std::size_t k, double arc_mm) const;
  [[nodiscard]] Eigen::Vector4d section_compliance(std::size_t k, double arc_mm) const;
  void lay_ramp(std::size_t k);
  [[nodiscard]] double ramp_compliance_mm(int which, double arc_mm) const;
  [[nodiscard]] double value_at(Profile Profiles::*profile, double arc_mm) const;
  [[nodiscard]] double rigidity_at(Profile Profiles::*profile, int which, double arc_mm) const;
  [[nodiscard]] double in_series(Profile Profiles::*profile, int which, double from_mm, double to_mm) const;
  template <typename Integrand>
  void over_sections(double from_mm, double to_mm, Integrand integrand) const;

  Instrument instrument_;
  std::vector<double> start_mm_;  ///< arc at which each section begins
  std::vector<Profiles> profiles_;
  std::vector<Ramp> ramps_;                   ///< at the start of each section
  std::vector<Eigen::Vector2d> rest_per_mm_;  ///< κ0 of each section, at its tip side
  double curved_to_mm_ = 0.0;                 ///< from here on the unloaded wire is straight
  bool round_ = true;                         ///< all sections bend alike in both directions
  bool even_ = true;  ///< compliance jumps nowhere, so that ramps need not be looked up
  double length_mm_ = 0.0;
};

}  // namespace endowire::rod
