#include "endowire/contact/contact_model.hpp"

namespace endowire::contact {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

constexpr double kSameWay = 0.9;  // cosine

Eigen::Vector3d joint_motion(const std::vector<double>& step, int joint, const GuidedJoint& guided) {
  const double* v = step.data() + 4 * joint;
  if (joint == guided.joint) return v[0] * guided.direction;
  return {v[0], v[1], v[2]};
}

/// Derivatives by the position of a sample and the spin of its rod.
struct AtSample {
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
};

/// By how much each wall is pressed, after the motion.
using Pressed = std::array<double, kMaxWalls>;

/// @return  whether a wall counts as closed
bool press_walls(LinearContact& c, const Eigen::Vector3d& u, bool assumed, Pressed& pressed_mm,
                 ModelPart& part) {
  bool closed = false;
  for (int k = 0; k < c.walls; ++k) {
    LinearContact::Wall& wall = c.wall[at(k)];
    const double pressed = wall.depth_mm - wall.zero_mm - wall.normal.dot(u);
    pressed_mm[at(k)] = pressed;
    part.changed = part.changed || (pressed > 0.0) != wall.closed;
    if (!assumed) wall.closed = pressed > 0.0;
    if (pressed > 0.0) part.energy_mj += 0.5 * wall.stiffness_n_per_mm * pressed * pressed;
    closed = closed || wall.closed;
  }
  return closed;
}

void add_walls(const LinearContact& c, const Pressed& pressed_mm, AtSample& out) {
  for (int k = 0; k < c.walls; ++k) {
    const LinearContact::Wall& wall = c.wall[at(k)];
    if (!wall.closed) continue;
    out.gradient.head<3>() -= wall.stiffness_n_per_mm * pressed_mm[at(k)] * wall.normal;
    out.hessian.topLeftCorner<3, 3>() += wall.stiffness_n_per_mm * wall.normal * wall.normal.transpose();
  }
}

Eigen::Matrix<double, 2, 4> slip_by_motion(const LinearContact& c) {
  Eigen::Matrix<double, 2, 4> by;
  by << c.axial.transpose(), 0.0, c.around.transpose(), c.radius_mm;
  return by;
}

void add_friction(LinearContact& c, const Eigen::Vector4d& motion, bool majorant, AtSample& out,
                  ModelPart& part) {
  const Eigen::Matrix<double, 2, 4> by = slip_by_motion(c);
  const Eigen::Vector2d slip = c.slip_mm + by * motion;
  FrictionResponse f = friction_response(c.friction, slip);
  const bool stuck = c.friction.stiffness_n_per_mm * slip.norm() <= c.friction.limit_n;
  // What slides back, or far to the side of where it slid, is as far from the parabola last used as what sticks.
  const bool turned = !stuck && slip.dot(c.slid_mm) < kSameWay * slip.norm() * c.slid_mm.norm();
  part.changed = part.changed || stuck != c.stuck || turned;
  c.stuck = stuck;
  c.slid_mm = slip;
  if (majorant && !stuck)
    f.stiffness_n_per_mm = c.friction.limit_n / slip.norm() * Eigen::Matrix2d::Identity();
  part.energy_mj += f.energy_mj;
  out.gradient.noalias() += by.transpose() * f.force_n;
  const Eigen::Matrix<double, 2, 4> stiff = f.stiffness_n_per_mm.lazyProduct(by);
  out.hessian.noalias() += by.transpose().lazyProduct(stiff);
}

void scatter_hessian(const LinearContact& c, const Eigen::Matrix4d& h, const GuidedJoint& guided,
                     math::BandMatrix& hessian) {
  const int own = 4 * c.rod;
  const int next = own + 4;
  const double a = 1.0 - c.fraction;
  const double b = c.fraction;
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k <= r; ++k) hessian.lower(own + r, own + k) += a * a * h(r, k);
    hessian.lower(own + 3, own + r) += a * h(3, r);
  }
  hessian.lower(own + 3, own + 3) += h(3, 3);
  if (b == 0.0) return;
  if (c.rod + 1 == guided.joint) {
    const Eigen::Vector3d along = h.topLeftCorner<3, 3>() * guided.direction;
    hessian.lower(next, next) += b * b * guided.direction.dot(along);
    for (int k = 0; k < 3; ++k) hessian.lower(next, own + k) += a * b * along[k];
    hessian.lower(next, own + 3) += b * guided.direction.dot(h.col(3).head<3>());
    return;
  }
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k <= r; ++k) hessian.lower(next + r, next + k) += b * b * h(r, k);
    for (int k = 0; k < 3; ++k) hessian.lower(next + r, own + k) += a * b * h(r, k);
    hessian.lower(next + r, own + 3) += b * h(r, 3);
  }
}

}  // namespace

Eigen::Vector3d motion_of(const LinearContact& c, const std::vector<double>& step,
                          const GuidedJoint& guided) {
  const Eigen::Vector3d u = joint_motion(step, c.rod, guided);
  if (c.fraction == 0.0) return u;
  return (1.0 - c.fraction) * u + c.fraction * joint_motion(step, c.rod + 1, guided);
}

void scatter_gradient(int rod, double fraction, const Eigen::Vector4d& g, const GuidedJoint& guided,
                      std::vector<double>& gradient) {
  double* own = gradient.data() + 4 * rod;
  for (int r = 0; r < 3; ++r) own[r] += (1.0 - fraction) * g[r];
  own[3] += g[3];
  if (fraction == 0.0) return;
  if (rod + 1 == guided.joint) {
    own[4] += fraction * guided.direction.dot(g.head<3>());
  } else {
    for (int r = 0; r < 3; ++r) own[4 + r] += fraction * g[r];
  }
}

ModelPart ContactModel::add_derivatives(const std::vector<double>& step, solve::ContactHessian kind,
                                        const GuidedJoint& guided, math::BandMatrix& hessian,
                                        std::vector<double>& gradient) {
  ModelPart part;
  Pressed pressed_mm{};
  for (LinearContact& c : contacts_) {
    const Eigen::Vector3d u = motion_of(c, step, guided);
    const bool touches = press_walls(c, u, kind == solve::ContactHessian::assumed, pressed_mm, part);
    const bool rubs = c.friction.limit_n > 0.0;
    if (!touches && !rubs) continue;
    AtSample s;
    if (touches) add_walls(c, pressed_mm, s);
    if (rubs)
      add_friction(c, {u[0], u[1], u[2], step[at(4 * c.rod + 3)]}, kind == solve::ContactHessian::majorant, s,
                   part);
    scatter_gradient(c.rod, c.fraction, s.gradient, guided, gradient);
    scatter_hessian(c, s.hessian, guided, hessian);
  }
  return part;
}

}  // namespace endowire::contact
