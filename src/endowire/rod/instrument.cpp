#include "endowire/rod/instrument.hpp"

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
    check_taper(place + "flexural_rigidity_n_mm2", s.flexural_rigidity_n_mm2, 1e-3, 1e5, "0.001 … 100000");
    check_taper(place + "torsional_rigidity_n_mm2", s.torsional_rigidity_n_mm2, 1e-3, 1e5, "0.001 … 100000");
    check_taper(place + "axial_rigidity_n", s.axial_rigidity_n, 1.0, 1e7, "1 … 10000000");
    check_taper(place + "radius_mm", s.radius_mm, 0.05, 5.0, "0.05 … 5");
    check(place + "linear_density_g_per_mm", s.linear_density_g_per_mm, 0.0, 1.0, "0 … 1");
    check(place + "friction", s.friction, 0.0, 2.0, "0 … 2");
    check(place + "rest_curvature_per_mm", s.rest_curvature_per_mm, -2.0, 2.0, "-2 … 2");
    check(place + "rest_plane_rad", s.rest_plane_rad, -10.0, 10.0, "-10 … 10");
    if (!(s.kink_curvature_per_mm > 0.0))
      refuse(place + "kink_curvature_per_mm", s.kink_curvature_per_mm, "> 0");
    check(place + "radiopacity", s.radiopacity, 0.0, 1000.0, "0 … 1000");
    if (s.kink_curvature_per_mm < 1.2 * std::abs(s.rest_curvature_per_mm)) {
      refuse(place + "kink_curvature_per_mm", s.kink_curvature_per_mm, "> 1.2 times rest_curvature_per_mm");
    }
  }
  check(where + ": length", length_mm(), 10.0, 5000.0, "10 … 5000 mm over all sections");
  check(where + ": grip_force_n", grip_force_n, 1e-3, 1e3, "0.001 … 1000");
  check(where + ": grip_torque_n_mm", grip_torque_n_mm, 1e-3, 1e4, "0.001 … 10000");
}

}  // namespace endowire::rod
