#include "endowire/rod/remesh.hpp"

#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/math/transport.hpp"

namespace endowire::rod {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double rod_length(const ChainMaterial& material, int rod) {
  return material.arc_mm[at(rod + 1)] - material.arc_mm[at(rod)];
}

/// Twist per length at a joint. The last rod lies in the sheath and does not twist.
double twist_rate(const ChainMaterial& material, const ChainShape& shape, int joint) {
  const int rods = shape.rods();
  if (joint <= 0 || joint >= rods) return 0.0;
  const double hand_side = joint == rods - 1 ? 0.0 : rod_length(material, joint);
  return shape.twist_rad[at(joint)] / (0.5 * (rod_length(material, joint - 1) + hand_side));
}

/// Tangent of the curve at a joint, from the circle through it and its neighbours; at the sheath that of the sheath. Zero at the tip.
Eigen::Vector3d tangent_at(const ChainMaterial& material, const ChainShape& shape, int joint) {
  if (joint == 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d& hand_side = shape.frames[at(joint)].col(2);
  if (joint == shape.rods() - 1) return hand_side;
  const Eigen::Vector3d& tip_side = shape.frames[at(joint - 1)].col(2);
  return (rod_length(material, joint) * tip_side + rod_length(material, joint - 1) * hand_side).normalized();
}

Frame transported(const Frame& frame, const Eigen::Vector3d& tangent, double spin_rad) {
  Frame out;
  const Eigen::Vector3d m1 = math::parallel_transport(frame.col(0), frame.col(2), tangent);
  out.col(0) = math::normal_part(math::spin_about(m1, tangent, spin_rad), tangent);
  out.col(1) = tangent.cross(out.col(0));
  out.col(2) = tangent;
  return out;
}

void shift_tip(ChainShape& shape, int last_joint, const Eigen::Vector3d& by) {
  for (int j = 0; j <= last_joint; ++j) shape.joints_mm[at(j)] += by;
}

template <typename T>
void insert_at(std::vector<T>& list, int place, T value) {
  list.insert(list.begin() + place, value);
}

template <typename T>
void erase_at(std::vector<T>& list, int place) {
  list.erase(list.begin() + place);
}

void renew_twist(ChainShape& shape, int joint, double near_rad) {
  if (joint <= 0 || joint >= shape.rods()) return;
  shape.twist_rad[at(joint)] = twist_between(shape.frames[at(joint)], shape.frames[at(joint - 1)], near_rad);
}

}  // namespace

void divide_rod(ChainMaterial& material, ChainShape& shape, int rod, double arc_mm) {
  const double tip_part = arc_mm - material.arc_mm[at(rod)];
  const double hand_part = material.arc_mm[at(rod + 1)] - arc_mm;
  ENDOWIRE_EXPECTS(tip_part > 0.0 && hand_part > 0.0, "a rod is divided between its ends");
  const double length = tip_part + hand_part;
  const Eigen::Vector3d& hand = shape.joints_mm[at(rod + 1)];
  const Eigen::Vector3d chord = shape.joints_mm[at(rod)] - hand;
  const double strained = chord.norm() / length;
  const Eigen::Vector3d e = chord.normalized();
  const Eigen::Vector3d at_hand = tangent_at(material, shape, rod + 1);
  Eigen::Vector3d at_tip = tangent_at(material, shape, rod);
  if (rod == 0) at_tip = 2.0 * e.dot(at_hand) * e - at_hand;  // the curve is a circle up to the free end
  // Cubic from the hand's end, f = 0, to the tip's, less the chord.
  const double f = hand_part / length;
  const double slope_hand = f * (1.0 - f) * (1.0 - f);
  const double slope_tip = -f * f * (1.0 - f);
  const Eigen::Vector3d off_chord = chord.norm() * (slope_hand * (at_hand - e) + slope_tip * (at_tip - e));
  const Eigen::Vector3d middle = f * chord + off_chord;
  const Eigen::Vector3d hand_e = middle.normalized();
  const Eigen::Vector3d tip_e = (chord - middle).normalized();

  const double spin_tip = 0.5 * hand_part * twist_rate(material, shape, rod);
  const double spin_hand = -0.5 * tip_part * twist_rate(material, shape, rod + 1);
  const double tip_twist = shape.twist_rad[at(rod)];
  const double hand_twist = shape.twist_rad[at(rod + 1)];
  const Frame frame = shape.frames[at(rod)];
  const Eigen::Vector3d joint = hand + strained * hand_part * hand_e;
  shift_tip(shape, rod, joint + strained * tip_part * tip_e - shape.joints_mm[at(rod)]);

  insert_at(shape.joints_mm, rod + 1, joint);
  insert_at(shape.frames, rod + 1, transported(frame, hand_e, spin_hand));
  shape.frames[at(rod)] = transported(frame, tip_e, spin_tip);
  insert_at(shape.spin_rad, rod + 1, shape.spin_rad[at(rod)] + spin_hand);
  shape.spin_rad[at(rod)] += spin_tip;
  insert_at(shape.twist_rad, rod + 1, 0.0);
  renew_twist(shape, rod, tip_twist - spin_tip);
  renew_twist(shape, rod + 1, spin_tip - spin_hand);
  renew_twist(shape, rod + 2, hand_twist + spin_hand);
  insert_at(material.arc_mm, rod + 1, arc_mm);
  insert_at(material.joints, rod + 1, material.joints[at(rod + 1)]);
  insert_at(material.weight_n, rod + 1, 0.0);
  insert_at(material.length_mm, rod + 1, hand_part);
  insert_at(material.stretch_n_per_mm, rod + 1, material.stretch_n_per_mm[at(rod)]);
}

void join_rods(ChainMaterial& material, ChainShape& shape, int joint) {
  ENDOWIRE_EXPECTS(joint >= 1 && joint <= shape.rods() - 2, "two rods in the lumen are joined");
  const double tip_part = rod_length(material, joint - 1);
  const double hand_part = rod_length(material, joint);
  const double length = tip_part + hand_part;
  const double strained = ((shape.joints_mm[at(joint - 1)] - shape.joints_mm[at(joint)]).norm() +
                           (shape.joints_mm[at(joint)] - shape.joints_mm[at(joint + 1)]).norm());
  const Eigen::Vector3d& hand = shape.joints_mm[at(joint + 1)];
  const Eigen::Vector3d e = (shape.joints_mm[at(joint - 1)] - hand).normalized();
  const double twist = shape.twist_rad[at(joint)];
  const double spin_tip = -twist * hand_part / length;
  const double spin_hand = twist * tip_part / length;
  const double tip_twist = shape.twist_rad[at(joint - 1)];
  const double hand_twist = shape.twist_rad[at(joint + 1)];
  const Frame frame = shape.frames[at(joint - 1)];
  shift_tip(shape, joint - 1, hand + strained * e - shape.joints_mm[at(joint - 1)]);

  erase_at(shape.joints_mm, joint);
  erase_at(shape.frames, joint);
  shape.frames[at(joint - 1)] = transported(frame, e, spin_tip);
  erase_at(shape.spin_rad, joint);
  shape.spin_rad[at(joint - 1)] += spin_tip;
  erase_at(shape.twist_rad, joint);
  renew_twist(shape, joint - 1, tip_twist - spin_tip);
  renew_twist(shape, joint, hand_twist + spin_hand);
  erase_at(material.arc_mm, joint);
  erase_at(material.joints, joint);
  erase_at(material.weight_n, joint);
  erase_at(material.length_mm, joint);
  erase_at(material.stretch_n_per_mm, joint);
}

}  // namespace endowire::rod
