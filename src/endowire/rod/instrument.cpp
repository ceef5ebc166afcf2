#include "endowire/rod/instrument.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "endowire/base/error.hpp"

namespace endowire::rod {

namespace {

[[noreturn]] void refuse(const std::string& place, double value, const char* allowed) {
  std::ostringstream text;
  text << place << " is " << value << "; must be " << allowed;
  throw base::InputError(text.str());
}

void check(const std::string& place, double value, double low, double high, const char* allowed) {
  if (!(value >= low && value <= high)) refuse(place, value, allowed);
}

void check_taper(const std::string& place, const Taper& taper, double low, double high, const char* allowed) {
  check(place + ".at_tip_side", taper.at_tip_side, low, high, allowed);
  check(place + ".at_hand_side", taper.at_hand_side, low, high, allowed);
  if (taper.power != 1 && taper.power != 2 && taper.power != 4 && taper.power != -1)
    refuse(place + ".power", taper.power, "1, 2, 4 or -1");
  const auto [lower, upper] = std::minmax({taper.at_tip_side, taper.at_hand_side});
  if (taper.power != 1 && !(taper.base <= lower || taper.base >= upper))
    refuse(place + ".base", taper.base, "below or above the values at both ends");
}

/// Of a quantity that is integrated along the wire.
void check_integrable(const std::string& place, const Taper& taper, double low, double high,
                      const char* allowed) {
  check_taper(place, taper, low, high, allowed);
  if (taper.power == -1) refuse(place + ".power", taper.power, "1, 2 or 4");
}

void check_linear(const std::string& place, const Taper& taper, double low, double high,
                  const char* allowed) {
  check_taper(place, taper, low, high, allowed);
  if (taper.power != 1) refuse(place + ".power", taper.power, "1");
}

void check_kink(const std::string& place, const Section& s) {
  const Taper& kink = s.kink_curvature_per_mm;
  check_taper(place, kink, 0.0, std::numeric_limits<double>::infinity(), "> 0");
  const double smallest = std::min(kink.at_tip_side, kink.at_hand_side);
  if (!(smallest > 0.0)) refuse(place, smallest, "> 0");
  if (smallest < 1.2 * std::abs(s.rest_curvature_per_mm))
    refuse(place, smallest, "> 1.2 times rest_curvature_per_mm");
}

}  // namespace

double Instrument::length_mm() const {
  double sum = 0.0;
  for (const Section& section : sections) sum += section.length_mm;
  return sum;
}

void Instrument::validate(const std::string& where) const {
  if (sections.empty()) throw base::InputError(where + ": section has no entry; must have at least one");
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const Section& s = sections[k];
    const std::string place = where + ": section[" + std::to_string(k) + "].";
    check(place + "length_mm", s.length_mm, 0.1, 5000.0, "0.1 … 5000");
    check_integrable(place + "flexural_rigidity_n_mm2", s.flexural_rigidity_n_mm2, 1e-3, 1e5,
                     "0.001 … 100000");
    check(place + "flexural_ratio", s.flexural_ratio, 0.01, 100.0, "0.01 … 100");
    check_integrable(place + "torsional_rigidity_n_mm2", s.torsional_rigidity_n_mm2, 1e-3, 1e5,
                     "0.001 … 100000");
    check_integrable(place + "axial_rigidity_n", s.axial_rigidity_n, 1.0, 1e7, "1 … 10000000");
    check_linear(place + "radius_mm", s.radius_mm, 0.05, 5.0, "0.05 … 5");
    check_integrable(place + "linear_density_g_per_mm", s.linear_density_g_per_mm, 0.0, 1.0, "0 … 1");
    check(place + "friction", s.friction, 0.0, 2.0, "0 … 2");
    check(place + "rest_curvature_per_mm", s.rest_curvature_per_mm, -2.0, 2.0, "-2 … 2");
    check(place + "rest_plane_rad", s.rest_plane_rad, -10.0, 10.0, "-10 … 10");
    check(place + "rest_torsion_per_mm", s.rest_torsion_per_mm, -2.0, 2.0, "-2 … 2");
    check_kink(place + "kink_curvature_per_mm", s);
    check_taper(place + "radiopacity", s.radiopacity, 0.0, 1000.0, "0 … 1000");
  }
  check(where + ": length", length_mm(), 10.0, 5000.0, "10 … 5000 mm over all sections");
  check(where + ": grip_force_n", grip_force_n, 1e-3, 1e3, "0.001 … 1000");
  check(where + ": grip_torque_n_mm", grip_torque_n_mm, 1e-3, 1e4, "0.001 … 10000");
  check(where + ": shapeable_mm", shapeable_mm, 0.0, length_mm(), "0 … the length of the instrument");
}

}  // namespace endowire::rod
