#include "endowire/sim/feed.hpp"

#include "endowire/base/contract.hpp"

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Stretch of wire that a joint stands for, and how fast its ends move along the wire as more of it enters.
struct Span {
  double from_mm, to_mm;
  double from_rate, to_rate;
};

/// Of the joint at the end of the sheath.
Span sheath_span(const rod::ChainMaterial& material) {
  const int n = material.rods();
  const double inserted = material.arc_mm[at(n - 1)];
  return {0.5 * (material.arc_mm[at(n - 2)] + inserted), inserted, 0.5, 1.0};
}

/// Of the joint at the other end of the entering rod.
Span next_span(const rod::ChainMaterial& material) {
  const int n = material.rods();
  const double arc = material.arc_mm[at(n - 2)];
  return {0.5 * (material.arc_mm[at(n - 3)] + arc), 0.5 * (arc + material.arc_mm[at(n - 1)]), 0.0, 0.5};
}

/// Adds what a joint contributes to the derivatives by the inserted length.
void add_joint(const rod::MaterialLine& line, const rod::ChainMaterial& material,
               const rod::ChainShape& shape, int j, const Span& span, math::BandMatrix& hessian,
               std::vector<double>& gradient) {
  const rod::JointMaterial& joint = material.joints[at(j)];
  rod::JointDerivatives d;
  rod::joint_derivatives(joint, shape.frames[at(j)], shape.frames[at(j - 1)], shape.twist_rad[at(j)], d);
  const auto rate = [&](auto property) {
    return Eigen::Vector2d(span.to_rate * property(span.to_mm) - span.from_rate * property(span.from_mm));
  };
  const Eigen::Vector2d rest = rate([&](double arc) { return line.rest_curvature_per_mm(arc); });
  // d²κ̄/dL²: where rest curvature changes along the wire.
  const Eigen::Vector2d rest_slope =
      span.to_rate * span.to_rate * line.rest_curvature_slope_per_mm2(span.to_mm) -
      span.from_rate * span.from_rate * line.rest_curvature_slope_per_mm2(span.from_mm);
  const Eigen::Vector2d bend =  // C'/C in both directions
      rate([&](double arc) {
        return Eigen::Vector2d(line.flexural_rigidities_n_mm2(arc).cwiseInverse());
      }).cwiseProduct(joint.bend_n_mm2) /
      joint.span_mm;
  const double twist = (span.to_rate / line.torsional_rigidity_n_mm2(span.to_mm) -
                        span.from_rate / line.torsional_rigidity_n_mm2(span.from_mm)) *
                       joint.twist_n_mm2 / joint.span_mm;  // D'/D
  const Eigen::Vector2d by_rest = d.rest_gradient.cwiseProduct(rest);

  const int u = 4 * (shape.rods() - 1);
  gradient[at(u)] += by_rest.sum() - d.bend_mj.dot(bend) - d.twist_mj * twist +
                     d.kink_by_span_mj_per_mm * (span.to_rate - span.from_rate);
  hessian.lower(u, u) += 2.0 * d.bend_mj.dot(bend.cwiseProduct(bend)) + 2.0 * d.twist_mj * twist * twist -
                         2.0 * by_rest.dot(bend) +
                         rest.dot(joint.bend_n_mm2.cwiseProduct(rest)) / joint.span_mm +
                         d.rest_gradient.dot(rest_slope);
  // Bending, in both directions, and twist soften at nearly the same rate along real wires.
  const rod::Turns mixed = d.rest_turn.transpose() * rest - bend.mean() * d.gradient;
  const auto lever = [&](int rod) {
    const double length = (shape.joints_mm[at(rod)] - shape.joints_mm[at(rod + 1)]).norm();
    return Eigen::Matrix<double, 3, 2>(shape.frames[at(rod)].leftCols<2>() / length);
  };
  const Eigen::Vector3d hand_side = lever(j) * mixed.segment<2>(0);
  const Eigen::Vector3d tip_side = lever(j - 1) * mixed.segment<2>(3);
  const auto add = [&](int joint_number, const Eigen::Vector3d& force) {
    if (4 * joint_number >= u) return;  // held in the sheath
    for (int c = 0; c < 3; ++c) hessian.lower(u, 4 * joint_number + c) += force[c];
  };
  add(j + 1, -hand_side);
  add(j, hand_side - tip_side);
  add(j - 1, tip_side);
  hessian.add(u, 4 * j + 3, mixed[2]);
  hessian.add(u, 4 * j - 1, mixed[5]);
}

}  // namespace

double grip_energy_mj(const Feed& feed) {
  return contact::friction_energy_mj(feed.push, {feed.stretch_mm, 0.0}) +
         contact::friction_energy_mj(feed.torque, {feed.twist_rad, 0.0});
}

void fit_entering_rod(const rod::MaterialLine& line, double inserted_mm, rod::ChainMaterial& material) {
  const int n = material.rods();
  ENDOWIRE_EXPECTS(n >= 2, "a rod in the lumen and one in the sheath");
  const double arc = material.arc_mm[at(n - 2)];
  material.arc_mm[at(n - 1)] = inserted_mm;
  material.arc_mm[at(n)] = inserted_mm + kSheathRod_mm;
  material.length_mm[at(n - 2)] = inserted_mm - arc;
  material.stretch_n_per_mm[at(n - 2)] = line.axial_rigidity_n(arc, inserted_mm) / (inserted_mm - arc);
  material.length_mm[at(n - 1)] = kSheathRod_mm;
  material.stretch_n_per_mm[at(n - 1)] = 0.0;
  const Span sheath = sheath_span(material);
  material.joints[at(n - 1)] = rod::joint_material(line, sheath.from_mm, sheath.to_mm);
  if (n < 3) return;
  const Span next = next_span(material);
  material.joints[at(n - 2)] = rod::joint_material(line, next.from_mm, next.to_mm);
}

double add_feed_derivatives(const Feed& feed, const rod::MaterialLine& line,
                            const rod::ChainMaterial& material, const rod::ChainShape& shape,
                            math::BandMatrix& hessian, std::vector<double>& gradient) {
  const int n = shape.rods();
  const int u = 4 * (n - 1);
  const Eigen::Vector3d t = shape.joints_mm[at(n - 2)] - shape.joints_mm[at(n - 1)];
  const double strain = t.norm() / material.length_mm[at(n - 2)] - 1.0;
  const double stiffness = material.stretch_n_per_mm[at(n - 2)];
  gradient[at(u)] -= stiffness * material.length_mm[at(n - 2)] * strain * (1.0 + 0.5 * strain);
  hessian.lower(u, u) += stiffness * (1.0 + strain) * (1.0 + strain);
  const Eigen::Vector3d along = stiffness * (1.0 + strain) * t.normalized();
  for (int c = 0; c < 3; ++c) hessian.lower(u, u - 4 + c) -= along[c];

  add_joint(line, material, shape, n - 1, sheath_span(material), hessian, gradient);
  if (n >= 3) add_joint(line, material, shape, n - 2, next_span(material), hessian, gradient);

  const auto push = contact::friction_response(feed.push, {feed.stretch_mm, 0.0});
  const auto torque = contact::friction_response(feed.torque, {feed.twist_rad, 0.0});
  gradient[at(u)] -= push.force_n[0];
  hessian.lower(u, u) += push.stiffness_n_per_mm(0, 0);
  gradient[at(u + 3)] -= torque.force_n[0];
  hessian.lower(u + 3, u + 3) += torque.stiffness_n_per_mm(0, 0);
  return push.energy_mj + torque.energy_mj;
}

}  // namespace endowire::sim
