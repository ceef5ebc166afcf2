#include "judge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace crossings {

using Eigen::Vector3d;

namespace {

/// Any unit vector normal to a unit vector.
Vector3d normal_to(const Vector3d& unit) {
  int axis = 0;
  unit.cwiseAbs().minCoeff(&axis);
  return unit.cross(Vector3d::Unit(axis)).normalized();
}

}  // namespace

const char* name_of(CrossingKind kind) {
  switch (kind) {
    case CrossingKind::depth:
      return "depth";
    case CrossingKind::axis:
      return "axis";
    case CrossingKind::path:
      return "path";
  }
  return "";
}

void Judge::count(Crossing crossing) {
  crossing.step = static_cast<int>(verdict_.steps);
  step_crosses_ = true;
  switch (crossing.kind) {
    case CrossingKind::depth:
      ++verdict_.deep_points;
      break;
    case CrossingKind::axis:
      ++verdict_.axis_passes;
      break;
    case CrossingKind::path:
      ++verdict_.path_passes;
      break;
  }
  if (verdict_.examples.size() < Verdict::max_examples) verdict_.examples.push_back(crossing);
}

/// Cross-sections every `spacing_mm` of material arc and the corners of the axis between them, sheath first.
void Judge::lay_sections(const Axis& axis) {
  sections_.clear();
  const double end = axis.inserted_mm;
  const double start = axis.arc_mm.front();
  if (end <= start) return;
  std::vector<std::pair<double, bool>> arcs;
  arcs.emplace_back(start, true);
  const auto first = static_cast<long long>(std::floor(start / settings_.spacing_mm)) + 1;
  for (long long i = first; static_cast<double>(i) * settings_.spacing_mm < end; ++i) {
    arcs.emplace_back(static_cast<double>(i) * settings_.spacing_mm, true);
  }
  arcs.emplace_back(end, true);
  for (const double arc : axis.arc_mm) {
    if (arc > start && arc < end && !std::binary_search(arcs.begin(), arcs.end(), std::pair(arc, true))) {
      arcs.emplace_back(arc, false);
    }
  }
  std::sort(arcs.begin(), arcs.end());
  for (auto it = arcs.rbegin(); it != arcs.rend(); ++it) {
    sections_.push_back(
        {it->first, axis.radius_at(it->first), axis.at(it->first), Vector3d::UnitX(), it->second});
  }
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const Section& behind = sections_[i > 0 ? i - 1 : 0];
    const Section& ahead = sections_[std::min(i + 1, sections_.size() - 1)];
    const Vector3d along = ahead.centre_mm - behind.centre_mm;
    if (along.norm() > 0.0) sections_[i].tangent = along.normalized();
  }
}

void Judge::step(const Axis& axis) {
  ++verdict_.steps;
  step_crosses_ = false;
  previous_.swap(sections_);
  lay_sections(axis);
  if (!sections_.empty()) {
    Side side = side_at_sheath(sections_.front().centre_mm);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const Section& here = sections_[i];
      if (i > 0) {
        const Section& behind = sections_[i - 1];
        const SegmentHits hits = lumen_.wall().hits(behind.centre_mm, here.centre_mm);
        if (hits.any()) {
          const Vector3d piece = here.centre_mm - behind.centre_mm;
          count(
              {CrossingKind::axis, 0, here.arc_mm, 0.0, piece.norm(), behind.centre_mm + hits.first * piece});
        }
        side = side_after(side, behind.centre_mm, here.centre_mm, hits);
      }
      if (here.judged) judge_section(here, side, i + 1 == sections_.size());
    }
    judge_paths();
  }
  if (step_crosses_) ++verdict_.steps_with_crossings;
}

Judge::Side Judge::side_at_sheath(const Vector3d& point) const {
  if (lumen_.inside(point)) return Side::lumen;
  return lumen_.before_opening(point) ? Side::beyond_opening : Side::wall;
}

Judge::Side Judge::side_after(Side before, const Vector3d& from, const Vector3d& to,
                              const SegmentHits& wall) const {
  const SegmentHits gate = lumen_.gates().hits(from, to);
  if (!wall.any() && !gate.any()) return before;
  if (lumen_.inside(to)) return Side::lumen;
  if (gate.any() && (!wall.any() || gate.last > wall.last)) return Side::beyond_opening;
  return !wall.any() && before == Side::beyond_opening ? Side::beyond_opening : Side::wall;
}

void Judge::judge_section(const Section& section, Side side, bool tip) {
  verdict_.points += settings_.points_around + (tip ? settings_.points_around + 1 : 0);
  if (side == Side::beyond_opening) return;
  lumen_.wall().within(section.centre_mm, section.radius_mm, near_);
  if (side == Side::lumen && near_.empty()) return;

  // The first point aims at the nearest wall, or away from it when the axis itself is outside.
  const NearestPoint nearest = lumen_.wall().nearest(section.centre_mm);
  Vector3d aim = nearest.point_mm - section.centre_mm;
  if (side == Side::wall) aim = -aim;
  aim -= aim.dot(section.tangent) * section.tangent;
  const Vector3d u =
      aim.norm() > 1e-9 * section.radius_mm ? Vector3d(aim.normalized()) : normal_to(section.tangent);
  const Vector3d v = section.tangent.cross(u);
  for (int k = 0; k < settings_.points_around; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / settings_.points_around;
    const Vector3d around = std::cos(angle) * u + std::sin(angle) * v;
    judge_point(section, side, section.centre_mm + section.radius_mm * around);
    if (tip) {
      judge_point(section, side,
                  section.centre_mm + section.radius_mm * (around + section.tangent) / std::numbers::sqrt2);
    }
  }
  if (tip) judge_point(section, side, section.centre_mm + section.radius_mm * section.tangent);
}

void Judge::judge_point(const Section& section, Side side, const Vector3d& point) {
  double depth = 0.0;
  if (side == Side::lumen) {
    SegmentHits wall;
    Vector3d facing = point - section.centre_mm;  // of the wall passed first, as its corners turn
    for (const int t : near_) {
      const Triangle& triangle = lumen_.wall().triangle(t);
      const SegmentHits hit = hits_of(triangle, section.centre_mm, point);
      if (hit.any() && hit.first < wall.first) {
        const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        facing = normal.dot(point - section.centre_mm) * (point - section.centre_mm);
      }
      wall += hit;
    }
    if (!wall.any()) return;  // in the lumen, or beyond an opening
    const SegmentHits gate = lumen_.gates().hits(section.centre_mm, point);
    const bool parity_holds = wall.unsure == 0 && !gate.any();
    const bool inside = parity_holds ? wall.sure % 2 == 0 : lumen_.inside(point);
    if (!inside && gate.any() && gate.first < wall.first) return;
    if (inside && wall.sure == 0) return;  // grazes an edge
    const double behind_wall = (1.0 - wall.first) * section.radius_mm;
    depth = inside ? behind_wall
                   : lumen_.wall().nearest(point, behind_wall * (1.0 + 1e-9) + 1e-12, facing).distance_mm;
    if (!std::isfinite(depth)) depth = behind_wall;
  } else {
    if (lumen_.inside(point)) return;
    depth = lumen_.wall().nearest(point).distance_mm;
  }
  const Crossing crossing{
      CrossingKind::depth, static_cast<int>(verdict_.steps), section.arc_mm, depth, 0.0, point};
  if (depth > verdict_.deepest.depth_mm) verdict_.deepest = crossing;
  if (depth > settings_.limit_mm) count(crossing);
}

/// The material points that were outside the sheath at both steps, each along a straight line.
void Judge::judge_paths() {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < previous_.size() && j < sections_.size()) {
    const Section& before = previous_[i];
    const Section& now = sections_[j];
    if (before.arc_mm > now.arc_mm) {
      ++i;
    } else if (now.arc_mm > before.arc_mm) {
      ++j;
    } else {
      ++i;
      ++j;
      const SegmentHits hits = lumen_.wall().hits(before.centre_mm, now.centre_mm);
      if (!hits.any()) continue;
      const Vector3d way = now.centre_mm - before.centre_mm;
      count({CrossingKind::path, 0, now.arc_mm, 0.0, way.norm(), before.centre_mm + hits.first * way});
    }
  }
}

}  // namespace crossings
