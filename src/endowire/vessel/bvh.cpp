#include "endowire/vessel/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

double box_distance2(const Vector3d& p, const Vector3d& low, const Vector3d& high) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({low[k] - p[k], 0.0, p[k] - high[k]});
    sum += d * d;
  }
  return sum;
}

constexpr std::size_t stack_size = 128;  // depth of a median-split tree of 2³¹ triangles is below 64

}  // namespace

double nearest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c,
                           Vector3d& nearest, std::uint8_t& feature) {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  const auto at_corner = [&](const Vector3d& v, std::uint8_t f) {
    nearest = v;
    feature = f;
    return (p - v).squaredNorm();
  };
  if (d1 <= 0.0 && d2 <= 0.0) return at_corner(a, 4);
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return at_corner(b, 5);
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return at_corner(c, 6);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    nearest = a + (d1 / (d1 - d3)) * ab;
    feature = 1;
    return (p - nearest).squaredNorm();
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    nearest = a + (d2 / (d2 - d6)) * ac;
    feature = 3;
    return (p - nearest).squaredNorm();
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    nearest = b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    feature = 2;
    return (p - nearest).squaredNorm();
  }
  const double denominator = 1.0 / (va + vb + vc);
  nearest = a + ab * (vb * denominator) + ac * (vc * denominator);
  feature = 0;
  return (p - nearest).squaredNorm();
}

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vector3d> centres(mesh.triangles.size());
  for (std::size_t t = 0; t < centres.size(); ++t)
    centres[t] = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
  nodes_.reserve(mesh.triangles.size());
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()), centres);
}

std::int32_t TriangleBvh::build(std::int32_t begin, std::int32_t end, const std::vector<Vector3d>& centres) {
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centre_box;
  for (std::int32_t i = begin; i < end; ++i) {
    const auto t = static_cast<std::size_t>(order_[static_cast<std::size_t>(i)]);
    for (std::size_t k = 0; k < 3; ++k) box.extend(mesh_.corner(t, k));
    centre_box.extend(centres[t]);
  }
  const auto node = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({box.min(), box.max(), begin, end - begin});
  if (end - begin <= 3) return node;
  int axis = 0;
  centre_box.sizes().maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t i, std::int32_t j) {
                     const double a = centres[static_cast<std::size_t>(i)][axis];
                     const double b = centres[static_cast<std::size_t>(j)][axis];
                     return a < b || (a == b && i < j);
                   });
  build(begin, middle, centres);
  const std::int32_t right = build(middle, end, centres);
  nodes_[static_cast<std::size_t>(node)].first = right;
  nodes_[static_cast<std::size_t>(node)].count = 0;
  return node;
}

NearestPoint TriangleBvh::nearest(const Vector3d& p, double within_mm, double enough_mm) const {
  NearestPoint best;
  if (nodes_.empty()) return best;
  double best2 = within_mm * within_mm;
  const double enough2 = enough_mm * enough_mm;
  bool enough = false;
  struct Entry {
    std::int32_t node;
    double distance2;
  };
  std::array<Entry, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = {0, box_distance2(p, nodes_[0].low, nodes_[0].high)};
  while (top > 0 && !enough) {
    const Entry entry = stack[--top];
    if (entry.distance2 > best2) continue;
    const Node& node = nodes_[static_cast<std::size_t>(entry.node)];
    if (node.count == 0) {
      const std::int32_t left = entry.node + 1;
      const std::int32_t right = node.first;
      const Node& l = nodes_[static_cast<std::size_t>(left)];
      const Node& r = nodes_[static_cast<std::size_t>(right)];
      const double dl = box_distance2(p, l.low, l.high);
      const double dr = box_distance2(p, r.low, r.high);
      const bool left_first = dl <= dr;
      const Entry further = left_first ? Entry{right, dr} : Entry{left, dl};
      const Entry nearer = left_first ? Entry{left, dl} : Entry{right, dr};
      if (further.distance2 <= best2) stack[top++] = further;
      if (nearer.distance2 <= best2) stack[top++] = nearer;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const std::int32_t t = order_[static_cast<std::size_t>(i)];
      const auto index = static_cast<std::size_t>(t);
      Vector3d q;
      std::uint8_t feature = 0;
      const double d2 = nearest_on_triangle(p, mesh_.corner(index, 0), mesh_.corner(index, 1),
                                            mesh_.corner(index, 2), q, feature);
      if (d2 < best2 || (d2 == best2 && (best.triangle < 0 || t < best.triangle))) {
        best2 = d2;
        best.point_mm = q;
        best.triangle = t;
        best.feature = feature;
      }
    }
    enough = best.triangle >= 0 && best2 < enough2;
  }
  if (best.triangle >= 0) best.distance_mm = std::sqrt(best2);
  return best;
}

template <class Enters, class Visit>
void TriangleBvh::walk(const Enters& enters, const Visit& visit) const {
  if (nodes_.empty()) return;
  std::array<std::int32_t, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::int32_t at = stack[--top];
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    if (!enters(node)) continue;
    if (node.count == 0) {
      stack[top++] = node.first;
      stack[top++] = at + 1;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      visit(order_[static_cast<std::size_t>(i)]);
  }
}

void TriangleBvh::collect(const Vector3d& centre, double radius_mm, std::vector<Candidate>& out) const {
  out.clear();
  const double radius2 = radius_mm * radius_mm;
  walk([&](const Node& node) { return box_distance2(centre, node.low, node.high) <= radius2; },
       [&](std::int32_t t) {
         const auto index = static_cast<std::size_t>(t);
         Vector3d q;
         std::uint8_t feature = 0;
         const double d2 = nearest_on_triangle(centre, mesh_.corner(index, 0), mesh_.corner(index, 1),
                                               mesh_.corner(index, 2), q, feature);
         if (d2 <= radius2) out.push_back({std::sqrt(d2), t});
       });
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance_mm < b.distance_mm || (a.distance_mm == b.distance_mm && a.triangle < b.triangle);
  });
}

void TriangleBvh::touching(const Eigen::AlignedBox3d& box, std::vector<std::int32_t>& out) const {
  out.clear();
  walk([&](const Node& node) { return box.intersects(Eigen::AlignedBox3d(node.low, node.high)); },
       [&](std::int32_t t) {
         Eigen::AlignedBox3d own;
         for (std::size_t k = 0; k < 3; ++k) own.extend(mesh_.corner(static_cast<std::size_t>(t), k));
         if (box.intersects(own)) out.push_back(t);
       });
}

TriangleBvh::Hit TriangleBvh::cast(const Vector3d& origin, const Vector3d& direction, double from_mm,
                                   double to_mm) const {
  Hit hit;
  const Vector3d inverse = direction.cwiseInverse();
  double nearest = to_mm;
  const auto enters = [&](const Node& node) {
    double near = from_mm;
    double far = nearest;
    for (int k = 0; k < 3; ++k) {
      if (direction[k] == 0.0) {
        if (origin[k] < node.low[k] || origin[k] > node.high[k]) return false;
        continue;
      }
      const double a = (node.low[k] - origin[k]) * inverse[k];
      const double b = (node.high[k] - origin[k]) * inverse[k];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far;
  };
  // Möller & Trumbore 1997
  const auto visit = [&](std::int32_t t) {
    const auto index = static_cast<std::size_t>(t);
    const Vector3d e1 = mesh_.corner(index, 1) - mesh_.corner(index, 0);
    const Vector3d e2 = mesh_.corner(index, 2) - mesh_.corner(index, 0);
    const Vector3d h = direction.cross(e2);
    const double determinant = e1.dot(h);
    if (determinant == 0.0) return;
    const Vector3d s = (origin - mesh_.corner(index, 0)) / determinant;
    const double u = s.dot(h);
    const Vector3d q = s.cross(e1);
    const double v = direction.dot(q);
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return;
    const double along = e2.dot(q);
    if (along < from_mm || along > nearest || (along == nearest && hit.triangle >= 0 && t > hit.triangle))
      return;
    nearest = along;
    hit = {along, t};
  };
  walk(enters, visit);
  return hit;
}

}  // namespace endowire::vessel
