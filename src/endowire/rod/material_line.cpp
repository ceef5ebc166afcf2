#include "endowire/rod/material_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace endowire::rod {

namespace {

/// Value of a taper at the fraction 0 … 1 of its section.
double at(const Taper& taper, double fraction) {
  return taper.at_tip_side + (taper.at_hand_side - taper.at_tip_side) * fraction;
}

/// ∫ ds / (a + b s) over a stretch with end values `first` and `last`.
double integrated_compliance(double length_mm, double first, double last) {
  const double ratio = last / first - 1.0;
  if (std::abs(ratio) < 1e-6) return length_mm / (0.5 * (first + last));
  return length_mm * std::log1p(ratio) / (last - first);
}

}  // namespace

MaterialLine::MaterialLine(Instrument instrument) : instrument_(std::move(instrument)) {
  instrument_.validate(instrument_.model.empty() ? "instrument" : instrument_.model);
  for (const Section& section : instrument_.sections) {
    start_mm_.push_back(length_mm_);
    length_mm_ += section.length_mm;
    rest_per_mm_.push_back(section.rest_curvature_per_mm * Eigen::Vector2d(std::cos(section.rest_plane_rad),
                                                                           std::sin(section.rest_plane_rad)));
  }
  ramps_.resize(start_mm_.size());
  for (std::size_t k = 1; k < ramps_.size(); ++k) {
    const double shorter_mm =
        std::min(instrument_.sections[k - 1].length_mm, instrument_.sections[k].length_mm);
    ramps_[k] = {0.5 * std::min(kRestRamp_mm, shorter_mm), rest_per_mm_[k] - rest_per_mm_[k - 1]};
  }
  for (std::size_t k = 0; k < start_mm_.size(); ++k) {
    if (rest_per_mm_[k].isZero(0.0)) continue;
    curved_to_mm_ = k + 1 < start_mm_.size() ? start_mm_[k + 1] + ramps_[k + 1].half_mm
                                             : std::numeric_limits<double>::infinity();
  }
}

std::size_t MaterialLine::section_at(double arc_mm) const {
  const auto after = std::upper_bound(start_mm_.begin() + 1, start_mm_.end(), arc_mm);
  return static_cast<std::size_t>(after - start_mm_.begin()) - 1;
}

/// Sums integrand(number of the section, length, first fraction, last fraction) over the sections between two arcs.
template <typename Integrand>
double MaterialLine::over_sections(double from_mm, double to_mm, Integrand integrand) const {
  double sum = 0.0;
  for (std::size_t k = section_at(from_mm); k < start_mm_.size(); ++k) {
    const Section& section = instrument_.sections[k];
    const double border = start_mm_[k] + section.length_mm;
    const double begin = std::max(from_mm, start_mm_[k]);
    const double end = std::min(to_mm, border);
    const auto fraction = [&](double arc) {
      return std::clamp((arc - start_mm_[k]) / section.length_mm, 0.0, 1.0);
    };
    if (end > begin) sum += integrand(k, end - begin, fraction(begin), fraction(end));
    if (to_mm <= border) break;
    const bool last = k + 1 == start_mm_.size();
    const double behind = to_mm - std::max(from_mm, border);  // behind the wire its last values hold
    if (last && behind > 0.0) sum += integrand(k, behind, 1.0, 1.0);
  }
  return sum;
}

double MaterialLine::flexural_rigidity_n_mm2(double from_mm, double to_mm) const {
  return (to_mm - from_mm) /
         over_sections(from_mm, to_mm, [this](std::size_t k, double length, double a, double b) {
           const Section& s = instrument_.sections[k];
           return integrated_compliance(length, at(s.flexural_rigidity_n_mm2, a),
                                        at(s.flexural_rigidity_n_mm2, b));
         });
}

double MaterialLine::torsional_rigidity_n_mm2(double from_mm, double to_mm) const {
  return (to_mm - from_mm) /
         over_sections(from_mm, to_mm, [this](std::size_t k, double length, double a, double b) {
           const Section& s = instrument_.sections[k];
           return integrated_compliance(length, at(s.torsional_rigidity_n_mm2, a),
                                        at(s.torsional_rigidity_n_mm2, b));
         });
}

double MaterialLine::axial_rigidity_n(double from_mm, double to_mm) const {
  return (to_mm - from_mm) /
         over_sections(from_mm, to_mm, [this](std::size_t k, double length, double a, double b) {
           const Section& s = instrument_.sections[k];
           return integrated_compliance(length, at(s.axial_rigidity_n, a), at(s.axial_rigidity_n, b));
         });
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

Eigen::Vector2d MaterialLine::rest_bend_rad(double from_mm, double to_mm) const {
  if (from_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  Eigen::Vector2d bend = ramp_bend_rad(to_mm) - ramp_bend_rad(from_mm);
  for (int c = 0; c < 2; ++c) {
    bend[c] += over_sections(from_mm, to_mm, [&](std::size_t k, double length, double, double) {
      return rest_per_mm_[k][c] * length;
    });
  }
  return bend;
}

double MaterialLine::mass_g(double from_mm, double to_mm) const {
  return over_sections(from_mm, to_mm, [this](std::size_t k, double length, double, double) {
    return instrument_.sections[k].linear_density_g_per_mm * length;
  });
}

double MaterialLine::volume_mm3(double from_mm, double to_mm) const {
  // A truncated cone: π L (a² + a b + b²)/3.
  return over_sections(from_mm, to_mm, [this](std::size_t k, double length, double a, double b) {
    const Section& s = instrument_.sections[k];
    const double first = at(s.radius_mm, a);
    const double last = at(s.radius_mm, b);
    return std::numbers::pi * length * (first * first + first * last + last * last) / 3.0;
  });
}

double MaterialLine::kink_per_mm(double from_mm, double to_mm) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = section_at(from_mm); k < start_mm_.size() && start_mm_[k] < to_mm; ++k) {
    smallest = std::min(smallest, instrument_.sections[k].kink_curvature_per_mm);
  }
  return smallest;
}

double MaterialLine::taper_at(const Taper Section::*taper, double arc_mm) const {
  const std::size_t k = section_at(arc_mm);
  const Section& section = instrument_.sections[k];
  return at(section.*taper, std::clamp((arc_mm - start_mm_[k]) / section.length_mm, 0.0, 1.0));
}

double MaterialLine::flexural_rigidity_n_mm2(double arc_mm) const {
  return taper_at(&Section::flexural_rigidity_n_mm2, arc_mm);
}

double MaterialLine::torsional_rigidity_n_mm2(double arc_mm) const {
  return taper_at(&Section::torsional_rigidity_n_mm2, arc_mm);
}

double MaterialLine::radius_mm(double arc_mm) const {
  return taper_at(&Section::radius_mm, arc_mm);
}

double MaterialLine::friction(double arc_mm) const {
  return instrument_.sections[section_at(arc_mm)].friction;
}

/// A ramp of 2h adds Δκ (x ± h)/2h, − behind its middle and + before it.
Eigen::Vector2d MaterialLine::rest_curvature_per_mm(double arc_mm) const {
  if (arc_mm >= curved_to_mm_) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d& own = rest_per_mm_[section_at(arc_mm)];
  const OnRamp on = ramp_at(arc_mm);
  if (on.ramp == nullptr) return own;
  const double h = on.ramp->half_mm;
  return own + on.ramp->jump_per_mm * ((on.behind_mm - std::copysign(h, on.behind_mm)) / (2.0 * h));
}

Eigen::Vector2d MaterialLine::rest_curvature_slope_per_mm2(double arc_mm) const {
  const OnRamp on = arc_mm < curved_to_mm_ ? ramp_at(arc_mm) : OnRamp{};
  if (on.ramp == nullptr) return Eigen::Vector2d::Zero();
  return on.ramp->jump_per_mm / (2.0 * on.ramp->half_mm);
}

}  // namespace endowire::rod
