#include "endowire/rod/material_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace endowire::rod {

MaterialLine::Profiles::Profiles(const Section& section)
    : bending(section.flexural_rigidity_n_mm2),
      twisting(section.torsional_rigidity_n_mm2),
      stretching(section.axial_rigidity_n),
      radius(section.radius_mm),
      density(section.linear_density_g_per_mm),
      kink(section.kink_curvature_per_mm),
      radiopacity(section.radiopacity) {}

MaterialLine::MaterialLine(Instrument instrument) : instrument_(std::move(instrument)) {
  instrument_.validate(instrument_.model.empty() ? "instrument" : instrument_.model);
  const std::vector<Section>& sections = instrument_.sections;
  for (const Section& section : sections) {
    start_mm_.push_back(length_mm_);
    length_mm_ += section.length_mm;
    profiles_.emplace_back(section);
    const Eigen::Vector2d direction(std::cos(section.rest_plane_rad), std::sin(section.rest_plane_rad));
    rest_per_mm_.emplace_back(section.rest_curvature_per_mm * direction);
    round_ = round_ && section.flexural_ratio == 1.0;
  }
  ramps_.resize(sections.size());
  for (std::size_t k = 1; k < ramps_.size(); ++k) lay_ramp(k);
  for (std::size_t k = 0; k < sections.size(); ++k) {
    if (rest_per_mm_[k].isZero(0.0)) continue;
    curved_to_mm_ = k + 1 < sections.size() ? start_mm_[k + 1] + ramps_[k + 1].half_mm
                                            : std::numeric_limits<double>::infinity();
  }
}

namespace {

/// Ends of sections that agree so well are the same value, computed from two sides: no ramp.
constexpr double kRounding = 1e-12;

}  // namespace

/// Where a section begins.
void MaterialLine::lay_ramp(std::size_t k) {
  Ramp& ramp = ramps_[k];
  const double border = start_mm_[k];
  ramp.half_mm =
      0.5 * std::min({kRamp_mm, instrument_.sections[k - 1].length_mm, instrument_.sections[k].length_mm});
  const Eigen::Vector2d rest_before = section_rest_per_mm(k - 1, border);
  ramp.rest_per_mm = rest_per_mm_[k] - rest_before;
  if (ramp.rest_per_mm.norm() <= kRounding * rest_before.norm()) ramp.rest_per_mm.setZero();
  const Eigen::Vector4d before = section_compliance(k - 1, border);
  const Eigen::Vector4d behind = section_compliance(k, border);
  ramp.compliance = behind - before;
  ramp.compliance =
      (ramp.compliance.array().abs() <= kRounding * before.array()).select(0.0, ramp.compliance);
  even_ = even_ && ramp.compliance.isZero(0.0);
  // At the border half of the jump is added before it and taken away behind it. Where a section stiffens so steeply away from the
  // border that less is there, the ramp is shorter.
  const Eigen::Vector4d half = 0.5 * ramp.compliance;
  constexpr int kHalvings = 20;
  ramp.compliance_half_mm = ramp.half_mm;
  for (int i = 0; i < kHalvings; ++i) {
    const Eigen::Vector4d ends_before =
        before.cwiseMin(section_compliance(k - 1, border - ramp.compliance_half_mm));
    const Eigen::Vector4d ends_behind =
        behind.cwiseMin(section_compliance(k, border + ramp.compliance_half_mm));
    if (((ends_before + half).array() > 0.0).all() && ((ends_behind - half).array() > 0.0).all()) break;
    ramp.compliance_half_mm *= 0.5;
  }
}

std::size_t MaterialLine::section_at(double arc_mm) const {
  const auto after = std::upper_bound(start_mm_.begin() + 1, start_mm_.end(), arc_mm);
  return static_cast<std::size_t>(after - start_mm_.begin()) - 1;
}

/// Ramps do not reach the middle of a section.
MaterialLine::NearBorder MaterialLine::border_near(double arc_mm) const {
  const std::size_t k = section_at(arc_mm);
  const double behind = arc_mm - start_mm_[k];
  if (behind < 0.5 * instrument_.sections[k].length_mm) {
    if (k == 0) return {};
    return {&ramps_[k], behind};
  }
  if (k + 1 == start_mm_.size()) return {};
  return {&ramps_[k + 1], arc_mm - start_mm_[k + 1]};
}

namespace {

/// The ramp of a unit jump: what it adds at x behind its middle, (x ± h)/2h, − behind and + before, nothing beyond h.
double ramp_at(double x, double h) {
  return std::abs(x) < h ? (x - std::copysign(h, x)) / (2.0 * h) : 0.0;
}

/// Its integral up to there, (h − |x|)²/4h.
double ramp_integral(double x, double h) {
  const double inner = h - std::abs(x);
  return inner > 0.0 ? inner * inner / (4.0 * h) : 0.0;
}

}  // namespace

/// Hands integrand(number of the section, length, first fraction, last fraction) every part of a section between two arcs.
template <typename Integrand>
void MaterialLine::over_sections(double from_mm, double to_mm, Integrand integrand) const {
  for (std::size_t k = section_at(from_mm); k < start_mm_.size(); ++k) {
    const double whole = instrument_.sections[k].length_mm;
    const double border = start_mm_[k] + whole;
    const double begin = std::max(from_mm, start_mm_[k]);
    const double end = std::min(to_mm, border);
    const auto fraction = [&](double arc) { return std::clamp((arc - start_mm_[k]) / whole, 0.0, 1.0); };
    if (end > begin) integrand(k, end - begin, fraction(begin), fraction(end));
    if (to_mm <= border) break;
    const bool last = k + 1 == start_mm_.size();
    const double behind = to_mm - std::max(from_mm, border);  // behind the wire its last values hold
    if (last && behind > 0.0) integrand(k, behind, 1.0, 1.0);
  }
}

/// Springs in series: length over the integral of the compliance.
double MaterialLine::in_series(Profile Profiles::*profile, int which, double from_mm, double to_mm) const {
  double compliance = even_ ? 0.0 : ramp_compliance_mm(which, to_mm) - ramp_compliance_mm(which, from_mm);
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    compliance += (profiles_[k].*profile).compliance(length, a, b);
  });
  return (to_mm - from_mm) / compliance;
}

double MaterialLine::flexural_rigidity_n_mm2(double from_mm, double to_mm) const {
  return in_series(&Profiles::bending, 0, from_mm, to_mm);
}

Eigen::Vector2d MaterialLine::flexural_rigidities_n_mm2(double from_mm, double to_mm) const {
  if (round_) return Eigen::Vector2d::Constant(flexural_rigidity_n_mm2(from_mm, to_mm));
  Eigen::Vector2d compliance(ramp_compliance_mm(0, to_mm) - ramp_compliance_mm(0, from_mm),
                             ramp_compliance_mm(1, to_mm) - ramp_compliance_mm(1, from_mm));
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    const double first = profiles_[k].bending.compliance(length, a, b);
    compliance += Eigen::Vector2d(first, first / instrument_.sections[k].flexural_ratio);
  });
  return (to_mm - from_mm) * compliance.cwiseInverse();
}

double MaterialLine::torsional_rigidity_n_mm2(double from_mm, double to_mm) const {
  return in_series(&Profiles::twisting, 2, from_mm, to_mm);
}

double MaterialLine::axial_rigidity_n(double from_mm, double to_mm) const {
  return in_series(&Profiles::stretching, 3, from_mm, to_mm);
}

/// What ramps add to the compliance from the tip to this arc.
double MaterialLine::ramp_compliance_mm(int which, double arc_mm) const {
  const NearBorder near = border_near(arc_mm);
  return near.ramp == nullptr
             ? 0.0
             : near.ramp->compliance[which] * ramp_integral(near.behind_mm, near.ramp->compliance_half_mm);
}

/// 1/EI₁, 1/EI₂, 1/GJ and 1/EA of a section as its data say, without ramps.
Eigen::Vector4d MaterialLine::section_compliance(std::size_t k, double arc_mm) const {
  const Section& section = instrument_.sections[k];
  const double fraction = std::clamp((arc_mm - start_mm_[k]) / section.length_mm, 0.0, 1.0);
  const Profiles& profiles = profiles_[k];
  const double bending = 1.0 / profiles.bending.at(fraction);
  return {bending, bending / section.flexural_ratio, 1.0 / profiles.twisting.at(fraction),
          1.0 / profiles.stretching.at(fraction)};
}

/// What ramps add to the turn from the tip to this arc.
Eigen::Vector2d MaterialLine::ramp_bend_rad(double arc_mm) const {
  const NearBorder near = border_near(arc_mm);
  if (near.ramp == nullptr) return Eigen::Vector2d::Zero();
  return near.ramp->rest_per_mm * ramp_integral(near.behind_mm, near.ramp->half_mm);
}

/// κ0 of a section as its data say, without ramps.
Eigen::Vector2d MaterialLine::section_rest_per_mm(std::size_t k, double arc_mm) const {
  const Section& section = instrument_.sections[k];
  if (section.rest_torsion_per_mm == 0.0) return rest_per_mm_[k];
  const double within = std::clamp(arc_mm - start_mm_[k], 0.0, section.length_mm);
  const double plane = section.rest_plane_rad + section.rest_torsion_per_mm * within;
  return section.rest_curvature_per_mm * Eigen::Vector2d(std::cos(plane), std::sin(plane));
}

Eigen::Vector2d MaterialLine::rest_bend_rad(double from_mm, double to_mm) const {
  if (from_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  Eigen::Vector2d bend = ramp_bend_rad(to_mm) - ramp_bend_rad(from_mm);
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    const Section& section = instrument_.sections[k];
    // ∫ κ0 (cos, sin)(τs) ds: the chord sin(x)/x of the turn 2x, in the direction of its middle.
    const double half = 0.5 * section.rest_torsion_per_mm * section.length_mm * (b - a);
    const double chord = std::abs(half) > 1e-8 ? std::sin(half) / half : 1.0;
    bend += length * chord * section_rest_per_mm(k, start_mm_[k] + 0.5 * (a + b) * section.length_mm);
  });
  return bend;
}

double MaterialLine::mass_g(double from_mm, double to_mm) const {
  double mass = 0.0;
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    mass += profiles_[k].density.integral(length, a, b);
  });
  return mass;
}

double MaterialLine::volume_mm3(double from_mm, double to_mm) const {
  double volume = 0.0;
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    // A truncated cone: π L (a² + a b + b²)/3.
    const double first = profiles_[k].radius.at(a);
    const double last = profiles_[k].radius.at(b);
    volume += std::numbers::pi * length * (first * first + first * last + last * last) / 3.0;
  });
  return volume;
}

double MaterialLine::kink_per_mm(double from_mm, double to_mm) const {
  double smallest = std::numeric_limits<double>::infinity();
  over_sections(from_mm, to_mm, [&](std::size_t k, double, double a, double b) {
    smallest = std::min({smallest, profiles_[k].kink.at(a), profiles_[k].kink.at(b)});
  });
  return smallest;
}

double MaterialLine::value_at(Profile Profiles::*profile, double arc_mm) const {
  const std::size_t k = section_at(arc_mm);
  return (profiles_[k].*profile)
      .at(std::clamp((arc_mm - start_mm_[k]) / instrument_.sections[k].length_mm, 0.0, 1.0));
}

double MaterialLine::rigidity_at(Profile Profiles::*profile, int which, double arc_mm) const {
  const double own = value_at(profile, arc_mm);
  if (even_) return own;
  const NearBorder near = border_near(arc_mm);
  if (near.ramp == nullptr || near.ramp->compliance[which] == 0.0) return own;
  return 1.0 /
         (1.0 / own + near.ramp->compliance[which] * ramp_at(near.behind_mm, near.ramp->compliance_half_mm));
}

double MaterialLine::flexural_rigidity_n_mm2(double arc_mm) const {
  return rigidity_at(&Profiles::bending, 0, arc_mm);
}

Eigen::Vector2d MaterialLine::flexural_rigidities_n_mm2(double arc_mm) const {
  if (round_) return Eigen::Vector2d::Constant(flexural_rigidity_n_mm2(arc_mm));
  Eigen::Vector2d compliance = section_compliance(section_at(arc_mm), arc_mm).head<2>();
  if (const NearBorder near = border_near(arc_mm); near.ramp != nullptr)
    compliance += near.ramp->compliance.head<2>() * ramp_at(near.behind_mm, near.ramp->compliance_half_mm);
  return compliance.cwiseInverse();
}

double MaterialLine::torsional_rigidity_n_mm2(double arc_mm) const {
  return rigidity_at(&Profiles::twisting, 2, arc_mm);
}

double MaterialLine::radius_mm(double arc_mm) const {
  return value_at(&Profiles::radius, arc_mm);
}

double MaterialLine::friction(double arc_mm) const {
  return instrument_.sections[section_at(arc_mm)].friction;
}

double MaterialLine::linear_density_g_per_mm(double arc_mm) const {
  return value_at(&Profiles::density, arc_mm);
}

double MaterialLine::kink_per_mm(double arc_mm) const {
  return value_at(&Profiles::kink, arc_mm);
}

double MaterialLine::radiopacity(double arc_mm) const {
  return value_at(&Profiles::radiopacity, arc_mm);
}

Eigen::Vector2d MaterialLine::rest_curvature_per_mm(double arc_mm) const {
  if (arc_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  Eigen::Vector2d rest = section_rest_per_mm(section_at(arc_mm), arc_mm);
  if (const NearBorder near = border_near(arc_mm); near.ramp != nullptr)
    rest += near.ramp->rest_per_mm * ramp_at(near.behind_mm, near.ramp->half_mm);
  return rest;
}

Eigen::Vector2d MaterialLine::rest_curvature_slope_per_mm2(double arc_mm) const {
  if (arc_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  const std::size_t k = section_at(arc_mm);
  const Eigen::Vector2d own = section_rest_per_mm(k, arc_mm);
  Eigen::Vector2d slope = instrument_.sections[k].rest_torsion_per_mm * Eigen::Vector2d(-own.y(), own.x());
  const NearBorder near = border_near(arc_mm);
  if (near.ramp != nullptr && std::abs(near.behind_mm) < near.ramp->half_mm)
    slope += near.ramp->rest_per_mm / (2.0 * near.ramp->half_mm);
  return slope;
}

}  // namespace endowire::rod
