#include "endowire/sim/sheath.hpp"

#include <algorithm>

#include "endowire/math/transport.hpp"
#include "endowire/rod/remesh.hpp"

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

Sheath::Sheath(const rod::ImmersedWire& wire, const Access& access, const Resolution& resolution)
    : wire_(wire), access_(access), resolution_(&resolution) {}

void Sheath::fill_from(int first, ChainProblem& problem) const {
  rod::ChainMaterial& material = problem.material;
  const double inserted = problem.feed.inserted_mm;
  material.arc_mm[at(material.rods() - 1)] = inserted;
  material.arc_mm[at(material.rods())] = inserted + kSheathRod_mm;
  wire_.fill(first, material.rods(), material);
  problem.fit_entering(inserted);
}

void Sheath::enter(double inserted_mm, double turn_rad, ChainProblem& problem) const {
  rod::ChainShape& shape = problem.shape;
  shape.resize(2);
  shape.joints_mm[0] = access_.position_mm + inserted_mm * access_.direction;
  shape.joints_mm[1] = access_.position_mm;
  shape.joints_mm[2] = access_.position_mm - kSheathRod_mm * access_.direction;
  const Eigen::Vector3d m1 =
      math::spin_about(math::any_normal(access_.direction), access_.direction, turn_rad);
  for (int i = 0; i < 2; ++i) {
    shape.frames[at(i)].col(0) = m1;
    shape.frames[at(i)].col(1) = access_.direction.cross(m1);
    shape.frames[at(i)].col(2) = access_.direction;
    shape.spin_rad[at(i)] = turn_rad;
  }
  std::fill(shape.twist_rad.begin(), shape.twist_rad.end(), 0.0);
  problem.contact.clear();
  problem.feed.inserted_mm = inserted_mm;
  problem.material.resize(2);
  problem.material.arc_mm[0] = 0.0;
  fill_from(0, problem);
}

void Sheath::leave(ChainProblem& problem) {
  problem.shape.joints_mm.clear();
  problem.shape.frames.clear();
  problem.shape.spin_rad.clear();
  problem.shape.twist_rad.clear();
  problem.contact.clear();
}

void Sheath::adapt(double inserted_mm, ChainProblem& problem) const {
  rod::ChainShape& shape = problem.shape;
  rod::ChainMaterial& material = problem.material;
  const double least = std::min(inserted_mm, problem.feed.inserted_mm);
  int first = shape.rods();
  const auto last_free = [&] { return shape.rods() - 2; };
  while (shape.rods() > 2 && least - material.arc_mm[at(last_free())] < kLeave_mm) {
    rod::join_rods(material, shape, last_free());
    first = std::min(first, last_free());
  }
  while (shape.rods() < resolution_->most_rods()) {
    const double next_mm = resolution_->next_joint_mm(shape, material.arc_mm[at(last_free())]);
    if (least - next_mm < kEntry_mm) break;
    first = std::min(first, last_free());
    rod::divide_rod(material, shape, last_free(), next_mm);
  }
  if (first < shape.rods()) fill_from(std::max(0, first - 1), problem);
}

}  // namespace endowire::sim
