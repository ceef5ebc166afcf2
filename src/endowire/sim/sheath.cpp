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

Sheath::Sheath(const rod::MaterialLine& line, const Access& access, std::vector<double> joint_arcs_mm,
               double gravity_m_per_s2, double fluid_density_g_per_mm3)
    : line_(&line),
      access_(access),
      arcs_mm_(std::move(joint_arcs_mm)),
      gravity_m_per_s2_(gravity_m_per_s2),
      fluid_density_g_per_mm3_(fluid_density_g_per_mm3) {}

void Sheath::fill(int first, ChainProblem& problem) const {
  rod::ChainMaterial& material = problem.material;
  const double inserted = problem.feed.inserted_mm;
  material.arc_mm[at(material.rods() - 1)] = inserted;
  material.arc_mm[at(material.rods())] = inserted + kSheathRod_mm;
  rod::fill_material_from(*line_, first, gravity_m_per_s2_, fluid_density_g_per_mm3_, material);
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
  fill(0, problem);
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
  while (shape.rods() < most_rods() && least - arcs_mm_[at(shape.rods() - 1)] >= kEntry_mm) {
    first = std::min(first, last_free());
    rod::divide_rod(material, shape, last_free(), arcs_mm_[at(shape.rods() - 1)]);
  }
  if (first < shape.rods()) fill(std::max(0, first - 1), problem);
}

}  // namespace endowire::sim
