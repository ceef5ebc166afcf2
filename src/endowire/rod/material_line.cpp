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
    rest_per_mm_.push_back(section.rest_curvature_per_mm * Eigen::Vector2d(std::cos(section.rest_plane_rad),
                                                                           std::sin(section.rest_plane_rad)));
    round_ = round_ && section.flexural_ratio == 1.0;
  }
  ramps_.resize(sections.size());
  for (std::size_t k = 1; k < ramps_.size(); ++k) {
    const double shorter_mm = std::min(sections[k - 1].length_mm, sections[k].length_mm);
    ramps_[k] = {0.5 * std::min(kRestRamp_mm, shorter_mm),
                 rest_per_mm_[k] - section_rest_per_mm(k - 1, start_mm_[k])};
  }
  for (std::size_t k = 0; k < sections.size(); ++k) {
    if (rest_per_mm_[k].isZero(0.0)) continue;
    curved_to_mm_ = k + 1 < sections.size() ? start_mm_[k + 1] + ramps_[k + 1].half_mm
                                            : std::numeric_limits<double>::infinity();
  }
}

std::size_t MaterialLine::section_at(double arc_mm) const {
  const auto after = std::upper_bound(start_mm_.begin() + 1, start_mm_.end(), arc_mm);
  return static_cast<std::size_t>(after - start_mm_.begin()) - 1;
}

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
double MaterialLine::in_series(Profile Profiles::*profile, double from_mm, double to_mm) const {
  double compliance = 0.0;
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    compliance += (profiles_[k].*profile).compliance(length, a, b);
  });
  return (to_mm - from_mm) / compliance;
}

double MaterialLine::flexural_rigidity_n_mm2(double from_mm, double to_mm) const {
  return in_series(&Profiles::bending, from_mm, to_mm);
}

Eigen::Vector2d MaterialLine::flexural_rigidities_n_mm2(double from_mm, double to_mm) const {
  if (round_) return Eigen::Vector2d::Constant(flexural_rigidity_n_mm2(from_mm, to_mm));
  Eigen::Vector2d compliance = Eigen::Vector2d::Zero();
  over_sections(from_mm, to_mm, [&](std::size_t k, double length, double a, double b) {
    const double first = profiles_[k].bending.compliance(length, a, b);
    compliance += Eigen::Vector2d(first, first / instrument_.sections[k].flexural_ratio);
  });
  return (to_mm - from_mm) * compliance.cwiseInverse();
}

double MaterialLine::torsional_rigidity_n_mm2(double from_mm, double to_mm) const {
  return in_series(&Profiles::twisting, from_mm, to_mm);
}

double MaterialLine::axial_rigidity_n(double from_mm, double to_mm) const {
  return in_series(&Profiles::stretching, from_mm, to_mm);
}

MaterialLine::OnRamp MaterialLine::ramp_at(double arc_mm) const {
  const std::size_t k = section_at(arc_mm);
  const double behind = arc_mm - start_mm_[k];
  if (behind < ramps_[k].half_mm) return {&ramps_[k], behind};
  if (k + 1 == start_mm_.size()) return {};
  const double before = arc_mm - start_mm_[k + 1];
  if (-before < ramps_[k + 1].half_mm) return {&ramps_[k + 1], before};
  return {};
}

/// What ramps add to the turn from the tip to this arc: Δκ (h − |x|)²/4h at x behind the middle of a ramp of 2h.
Eigen::Vector2d MaterialLine::ramp_bend_rad(double arc_mm) const {
  const OnRamp on = ramp_at(arc_mm);
  if (on.ramp == nullptr) return Eigen::Vector2d::Zero();
  const double h = on.ramp->half_mm;
  const double inner = h - std::abs(on.behind_mm);
  return on.ramp->jump_per_mm * (inner * inner / (4.0 * h));
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

double MaterialLine::flexural_rigidity_n_mm2(double arc_mm) const {
  return value_at(&Profiles::bending, arc_mm);
}

Eigen::Vector2d MaterialLine::flexural_rigidities_n_mm2(double arc_mm) const {
  const double first = flexural_rigidity_n_mm2(arc_mm);
  return {first, round_ ? first : first * instrument_.sections[section_at(arc_mm)].flexural_ratio};
}

double MaterialLine::torsional_rigidity_n_mm2(double arc_mm) const {
  return value_at(&Profiles::twisting, arc_mm);
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

/// A ramp of 2h adds Δκ (x ± h)/2h, − behind its middle and + before it.
Eigen::Vector2d MaterialLine::rest_curvature_per_mm(double arc_mm) const {
  if (arc_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d own = section_rest_per_mm(section_at(arc_mm), arc_mm);
  const OnRamp on = ramp_at(arc_mm);
  if (on.ramp == nullptr) return own;
  const double h = on.ramp->half_mm;
  return own + on.ramp->jump_per_mm * ((on.behind_mm - std::copysign(h, on.behind_mm)) / (2.0 * h));
}

Eigen::Vector2d MaterialLine::rest_curvature_slope_per_mm2(double arc_mm) const {
  if (arc_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  const std::size_t k = section_at(arc_mm);
  const Eigen::Vector2d own = section_rest_per_mm(k, arc_mm);
  Eigen::Vector2d slope = instrument_.sections[k].rest_torsion_per_mm * Eigen::Vector2d(-own.y(), own.x());
  const OnRamp on = ramp_at(arc_mm);
  if (on.ramp != nullptr) slope += on.ramp->jump_per_mm / (2.0 * on.ramp->half_mm);
  return slope;
}

}  // namespace endowire::rod
