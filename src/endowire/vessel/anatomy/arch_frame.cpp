#include "endowire/vessel/anatomy/arch_frame.hpp"

#include <numbers>

#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;

// The descending aorta begins left of the spine and behind the bifurcation of the aorta, which lies before it:
// 20 mm to the left of the middle in the chest [Sevastik1996]; the 22 mm back are an estimate.
const Vector3d descending_begin(24.0, 22.0, 0.0);

// What the lumen at the trunk's ostium has of the ascending aorta's calibre, which narrows to the arch's there.
constexpr double ascending_share = 0.35;

/// Height of a branch's ostium: where its axis passes the wall of the arch, a ring of radius `lumen_mm`.
double ostium_height_mm(const ArchFrame& arch, double phi, const Vector3d& direction, double lumen_mm) {
  const Vector3d from = arch.radius_mm * arch.outward(phi);  // from the arch's centre
  const Vector3d aside = cross(arch.along, Vector3d::UnitZ());
  double low = 0.0;
  double high = 4.0 * lumen_mm;
  for (int i = 0; i < 40; ++i) {
    const Vector3d p = from + 0.5 * (low + high) * direction;
    const double out_of_plane = dot(p, aside);
    const double rho = length(p - out_of_plane * aside) - arch.radius_mm;
    (rho * rho + out_of_plane * out_of_plane < lumen_mm * lumen_mm ? low : high) = 0.5 * (low + high);
  }
  return from.z() + 0.5 * (low + high) * direction.z();
}

/// φ at which the trunk's ostium lies `drop_mm` below the top of the arch.
double phi_below_top(const ArchFrame& arch, const Values& values, double drop_mm) {
  const double take_off = radians(values["brachiocephalic_take_off_deg"]);
  const double at_top = 0.5 * values["arch_diameter_mm"];
  const double at_trunk = at_top + ascending_share * (0.5 * values["ascending_diameter_mm"] - at_top);
  double low = 0.0;
  double high = radians(80.0);
  for (int i = 0; i < 60; ++i) {
    const double phi = -0.5 * (low + high);
    const Vector3d out = arch.leaving(phi, take_off, radians(trunk_clock_deg));
    const double drop = arch.radius_mm + at_top - ostium_height_mm(arch, phi, out, at_trunk);
    (drop < drop_mm ? low : high) = -phi;
  }
  return -0.5 * (low + high);
}

}  // namespace

Vector3d ArchFrame::at_mm(double phi) const {
  return centre_mm + radius_mm * outward(phi);
}

Vector3d ArchFrame::flow(double phi) const {
  return cosine(phi) * along - sine(phi) * Vector3d::UnitZ();
}

Vector3d ArchFrame::outward(double phi) const {
  return sine(phi) * along + cosine(phi) * Vector3d::UnitZ();
}

Vector3d ArchFrame::leaving(double phi, double angle_rad, double clock_rad) const {
  return cosine(angle_rad) * flow(phi) + sine(angle_rad) * turned(outward(phi), flow(phi), clock_rad);
}

ArchFrame arch_frame(const Values& values) {
  ArchFrame arch;
  arch.radius_mm = values["arch_radius_mm"];
  const double plane = radians(values["arch_plane_deg"]);
  arch.along = Vector3d(cosine(plane), sine(plane), 0.0);
  const double drop = (values["arch_type"] - 0.5) * values["common_carotid_diameter_mm"];
  arch.trunk_phi = phi_below_top(arch, values, drop);
  arch.carotid_phi = arch.trunk_phi + values["brachiocephalic_to_carotid_mm"] / arch.radius_mm;
  arch.subclavian_phi = arch.carotid_phi + values["carotid_to_subclavian_mm"] / arch.radius_mm;
  // The descending thoracic aorta counts from the subclavian ostium; what the arch still has of it is no drop.
  const double in_arch = arch.radius_mm * (0.5 * std::numbers::pi - arch.subclavian_phi);
  const double height = values["abdominal_length_mm"] + values["descending_thoracic_length_mm"] - in_arch;
  arch.centre_mm = descending_begin + height * Vector3d::UnitZ() - arch.radius_mm * arch.along;
  return arch;
}

}  // namespace endowire::vessel::anatomy
