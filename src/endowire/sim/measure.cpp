#include "endowire/sim/measure.hpp"

#include <algorithm>
#include <cmath>

namespace endowire::sim {

namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

constexpr double kWindow_mm = 5.0;

double bend_at(const rod::ChainShape& shape, int joint) {
  const Eigen::Vector3d& e = shape.frames[at(joint)].col(2);
  const Eigen::Vector3d& f = shape.frames[at(joint - 1)].col(2);
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

}  // namespace

WallForces measure_wall(const ChainProblem& problem) {
  WallForces out;
  const auto& samples = problem.contact.samples();
  out.narrowest_clearance_mm = HUGE_VAL;
  std::size_t first = 0;
  double window = 0.0;
  for (const contact::Sample& s : samples) {
    window += s.normal_n;
    while (samples[first].arc_mm < s.arc_mm - kWindow_mm) window -= samples[first++].normal_n;
    out.max_window_n = std::max(out.max_window_n, window);
    if (s.arc_mm <= kWindow_mm) out.tip_window_n += s.normal_n;
    out.max_deflection_mm = std::max(out.max_deflection_mm, s.deflection_mm);
    const double clearance = s.lumen_radius_mm - s.radius_mm;
    if (s.walls > 0 && clearance < out.narrowest_clearance_mm) {
      out.narrowest_clearance_mm = clearance;
      out.narrowest_at_mm = s.position_mm(problem.shape);
    }
  }
  return out;
}

KinkReserve measure_kink(const ChainProblem& problem) {
  KinkReserve out;
  for (int j = 1; j < problem.shape.rods(); ++j) {
    const rod::JointMaterial& joint = problem.material.joints[at(j)];
    const double curvature = bend_at(problem.shape, j) / joint.span_mm;
    if (curvature / joint.kink_per_mm <= out.ratio) continue;
    out = {curvature / joint.kink_per_mm, curvature, problem.shape.joints_mm[at(j)]};
  }
  return out;
}

void fill_snapshot(const ChainProblem& problem, const rod::MaterialLine& line, Snapshot& out) {
  const rod::ChainShape& shape = problem.shape;
  const int n = shape.rods();
  out.points.assign(n == 0 ? 0 : at(n + 1), SnapshotPoint{});
  for (int j = 0; n > 0 && j <= n; ++j) {
    SnapshotPoint& p = out.points[at(j)];
    p.position_mm = shape.joints_mm[at(j)];
    p.arc_mm = problem.material.arc_mm[at(j)];
    p.radius_mm = line.radius_mm(p.arc_mm);
    p.twist_rad = shape.spin_rad[at(std::min(j, n - 1))];
    if (j > 0 && j < n) p.curvature_per_mm = bend_at(shape, j) / problem.material.joints[at(j)].span_mm;
  }
  // Each sample's force goes to the joints of its rod by its place, then is divided by the length the joint stands for.
  const auto& samples = problem.contact.samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const contact::Sample& s = samples[i];
    if (s.walls == 0 || s.normal_n <= 0.0) continue;
    const Eigen::Vector3d normal = problem.contact.normal_force_n(shape, i);
    const double friction = problem.contact.friction_force_n(shape, i).norm();
    for (const auto& [joint, weight] :
         {std::pair{s.rod, 1.0 - s.fraction}, std::pair{s.rod + 1, s.fraction}}) {
      SnapshotPoint& p = out.points[at(joint)];
      const double share = weight / problem.material.joints[at(joint)].span_mm;
      p.wall_force_n_per_mm += share * s.normal_n;
      p.friction_n_per_mm += share * friction;
      p.wall_force_direction += share * normal;
    }
  }
  for (SnapshotPoint& p : out.points) {
    const double norm = p.wall_force_direction.norm();
    if (norm > 0.0) p.wall_force_direction /= norm;
  }
}

}  // namespace endowire::sim
