#include "endowire/contact/crest.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::contact {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void put_at(const rod::MaterialLine& line, const rod::ChainMaterial& material, double arc_mm, Sample& s) {
  while (s.rod > 0 && arc_mm < material.arc_mm[at(s.rod)]) --s.rod;
  while (s.rod + 2 < material.rods() && arc_mm >= material.arc_mm[at(s.rod + 1)]) ++s.rod;
  s.arc_mm = arc_mm;
  s.fraction = (arc_mm - material.arc_mm[at(s.rod)]) / material.length_mm[at(s.rod)];
  s.radius_mm = line.radius_mm(arc_mm);
  s.friction = line.friction(arc_mm);
}

void seek_crest(const Wire& wire, const vessel::Field& field, const ContactSpec& spec, Sample& s) {
  constexpr double kLevel = 0.03;  // slope of the clearance along the wire, below which nothing is gained
  constexpr double kClose_mm = 0.05;
  constexpr int kSteps = 5;
  constexpr double kLeastNormal = 0.3;
  struct End {
    double arc_mm, slope;
    Eigen::Vector3d gradient;
  };
  double clearance_mm = 0.0;
  const auto look_at = [&](double arc_mm) {
    put_at(wire.line, wire.material, arc_mm, s);
    const vessel::WallDistance w = field.at(s.position_mm(wire.shape));
    clearance_mm = w.distance_mm - s.radius_mm;
    return End{arc_mm, -w.gradient.dot(wire.shape.frames[at(s.rod)].col(2)), w.gradient};
  };
  s.at_crest = false;
  if (s.nominal_mm == 0.0) return;  // the tip stays the tip
  End a = look_at(s.nominal_mm);
  if (clearance_mm > spec.reach_mm) return;
  // At a joint two rods meet: downhill is where either of them leads. A joint that is nearest to the wall itself is no crest.
  const bool on_joint = s.fraction == 0.0 && s.rod > 0;
  const double tipwards = on_joint ? a.gradient.dot(wire.shape.frames[at(s.rod - 1)].col(2)) : -a.slope;
  const double handwards = a.slope;
  if (std::min(tipwards, handwards) > -kLevel) return;
  a.slope = tipwards < handwards ? -tipwards : handwards;
  const double end_mm = tipwards < handwards ? s.from_mm : s.to_mm;
  if (std::abs(end_mm - a.arc_mm) < kClose_mm) return;
  End b = look_at(end_mm);
  s.at_crest = a.slope * b.slope < 0.0;
  if (!s.at_crest) return put_at(wire.line, wire.material, a.arc_mm, s);
  for (int k = 0; k < kSteps && std::abs(b.arc_mm - a.arc_mm) > kClose_mm; ++k) {
    const double share = std::clamp(a.slope / (a.slope - b.slope), 0.2, 0.8);
    const End c = look_at(a.arc_mm + share * (b.arc_mm - a.arc_mm));
    (a.slope * c.slope < 0.0 ? b : a) = c;
    if (std::abs(c.slope) < kLevel) break;
  }
  // Of the normals on both sides the one that is square to the wire. There is none where the wire runs into a wall head-on.
  s.crest_normal = (a.slope * b.gradient - b.slope * a.gradient) / (a.slope - b.slope);
  s.at_crest = s.crest_normal.norm() > kLeastNormal;
  if (!s.at_crest) put_at(wire.line, wire.material, s.nominal_mm, s);
}

}  // namespace endowire::contact
