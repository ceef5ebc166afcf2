#include "endowire/contact/put_sample.hpp"

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

}  // namespace endowire::contact
