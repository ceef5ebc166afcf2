#include "triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace crossings {

using Eigen::Vector3d;

namespace {

constexpr int leaf_size = 4;
constexpr int stack_size = 128;          // far above twice the depth of a median-split tree
constexpr double unsure_margin = 1e-7;   // parameter distance from an edge below which parity is not trusted
constexpr double touch_margin = 1e-10;   // closes the cracks that rounding leaves between two triangles
constexpr double far_field_ratio = 2.0;  // distance over cluster radius beyond which a dipole stands for it

double box_distance_squared(const Vector3d& low, const Vector3d& high, const Vector3d& p) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

/// Slab test of the closed segment a + t d, t in [0, 1], against a box grown by rounding.
bool segment_meets_box(const Vector3d& a, const Vector3d& d, const Vector3d& low, const Vector3d& high) {
  double enter = 0.0;
  double leave = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double slack = 1e-9 * (1.0 + std::abs(a[k]));
    if (d[k] == 0.0) {
      if (a[k] < low[k] - slack || a[k] > high[k] + slack) return false;
      continue;
    }
    double t0 = (low[k] - slack - a[k]) / d[k];
    double t1 = (high[k] + slack - a[k]) / d[k];
    if (t0 > t1) std::swap(t0, t1);
    enter = std::max(enter, t0);
    leave = std::min(leave, t1);
    if (enter > leave) return false;
  }
  return true;
}

Vector3d area_vector(const Triangle& t) {
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
}

/// Solid angle of a triangle seen from the origin: tan(Ω/2) = a·(b×c) / (abc + (a·b)c + (b·c)a + (c·a)b).
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

void SegmentHits::operator+=(const SegmentHits& other) {
  sure += other.sure;
  unsure += other.unsure;
  first = std::min(first, other.first);
  last = std::max(last, other.last);
}

/// Nearest point of a triangle's three sides.
Vector3d nearest_on_sides(const Triangle& triangle, const Vector3d& p) {
  Vector3d best = triangle[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = triangle[k];
    const Vector3d side = triangle[(k + 1) % 3] - from;
    const double whole = side.squaredNorm();
    const Vector3d q =
        whole > 0.0 ? Vector3d(from + std::clamp(side.dot(p - from) / whole, 0.0, 1.0) * side) : from;
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return best;
}

/// Nearest point of a triangle by its Voronoi regions [Ericson2005 §5.1.5]; of its sides where it is so narrow that rounding leaves nothing
/// of the areas that tell the region.
Vector3d nearest_on_triangle(const Triangle& triangle, const Vector3d& p) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  const double sum = va + vb + vc;
  const double terms = std::abs(d3 * d6) + std::abs(d5 * d4) + std::abs(d5 * d2) + std::abs(d1 * d6) +
                       std::abs(d1 * d4) + std::abs(d3 * d2);
  constexpr double narrow = 1e-10;
  if (!(sum > narrow * terms)) return nearest_on_sides(triangle, p);
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double to_c = d4 - d3;
  const double to_b = d5 - d6;
  if (va <= 0.0 && to_c >= 0.0 && to_b >= 0.0) return b + to_c / (to_c + to_b) * (c - b);
  return a + (vb * ab + vc * ac) / sum;
}

/// [MollerTrumbore1997] with closed, slightly grown bounds, so that no segment slips between two neighbours.
SegmentHits hits_of(const Triangle& triangle, const Vector3d& from, const Vector3d& to) {
  SegmentHits result;
  const Vector3d d = to - from;
  const Vector3d e1 = triangle[1] - triangle[0];
  const Vector3d e2 = triangle[2] - triangle[0];
  const Vector3d p = d.cross(e2);
  const double determinant = e1.dot(p);
  // Parallel to the plane or without area: its neighbours are met instead.
  if (std::abs(determinant) <= 1e-14 * d.norm() * e1.norm() * e2.norm()) return result;
  const Vector3d s = from - triangle[0];
  const double u = s.dot(p) / determinant;
  const Vector3d q = s.cross(e1);
  const double v = d.dot(q) / determinant;
  const double t = e2.dot(q) / determinant;
  const double margin = std::min({u, v, 1.0 - u - v, t, 1.0 - t});
  if (margin < -touch_margin) return result;
  (margin > unsure_margin ? result.sure : result.unsure) = 1;
  result.first = result.last = std::clamp(t, 0.0, 1.0);
  return result;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles) {
  if (triangles.empty()) return;
  std::vector<int> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  triangles_.reserve(triangles.size());
  nodes_.reserve(triangles.size());
  build(0, static_cast<int>(triangles.size()), order, triangles);
}

int TriangleTree::build(int first, int last, std::vector<int>& order, const std::vector<Triangle>& input) {
  const auto triangle_at = [&](int i) -> const Triangle& {
    return input[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
  };
  Node node;
  node.low.setConstant(std::numeric_limits<double>::infinity());
  node.high = -node.low;
  node.centre.setZero();
  node.area_vector.setZero();
  double area = 0.0;
  for (int i = first; i < last; ++i) {
    const Triangle& t = triangle_at(i);
    for (const Vector3d& corner : t) {
      node.low = node.low.cwiseMin(corner);
      node.high = node.high.cwiseMax(corner);
    }
    const Vector3d vector = area_vector(t);
    node.area_vector += vector;
    node.centre += vector.norm() * (t[0] + t[1] + t[2]) / 3.0;
    area += vector.norm();
  }
  node.centre = area > 0.0 ? Vector3d(node.centre / area) : Vector3d(0.5 * (node.low + node.high));
  for (int i = first; i < last; ++i) {
    for (const Vector3d& corner : triangle_at(i)) {
      node.radius = std::max(node.radius, (corner - node.centre).norm());
    }
  }
  const int index = static_cast<int>(nodes_.size());
  const auto at = static_cast<std::size_t>(index);
  nodes_.push_back(node);
  if (last - first <= leaf_size) {
    nodes_[at].first = static_cast<int>(triangles_.size());
    nodes_[at].count = last - first;
    for (int i = first; i < last; ++i) triangles_.push_back(triangle_at(i));
    return index;
  }
  int axis = 0;
  (node.high - node.low).maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last, [&](int l, int r) {
    const Triangle& a = input[static_cast<std::size_t>(l)];
    const Triangle& b = input[static_cast<std::size_t>(r)];
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  build(first, middle, order, input);
  const int right = build(middle, last, order, input);
  nodes_[at].right = right;
  return index;
}

NearestPoint TriangleTree::nearest(const Vector3d& p, double cap_mm, const Vector3d& facing) const {
  NearestPoint best;
  if (nodes_.empty()) return best;
  const bool filtered = !facing.isZero(0.0);
  double bound = cap_mm * cap_mm;
  std::array<int, stack_size> stack{};
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = 0;
  while (top > 0) {
    const int index = stack[static_cast<std::size_t>(--top)];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (box_distance_squared(node.low, node.high, p) > bound) continue;
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i) {
        const Triangle& t = triangle(i);
        if (filtered && area_vector(t).dot(facing) <= 0.0) continue;
        const Vector3d q = nearest_on_triangle(t, p);
        const double squared = (q - p).squaredNorm();
        if (squared <= bound) {
          bound = squared;
          best = {std::sqrt(squared), q};
        }
      }
      continue;
    }
    const Node& left = nodes_[static_cast<std::size_t>(index + 1)];
    const Node& right = nodes_[static_cast<std::size_t>(node.right)];
    const bool left_first =
        box_distance_squared(left.low, left.high, p) <= box_distance_squared(right.low, right.high, p);
    stack[static_cast<std::size_t>(top++)] = left_first ? node.right : index + 1;
    stack[static_cast<std::size_t>(top++)] = left_first ? index + 1 : node.right;
  }
  return best;
}

void TriangleTree::within(const Vector3d& p, double radius_mm, std::vector<int>& out) const {
  out.clear();
  if (nodes_.empty()) return;
  const double bound = radius_mm * radius_mm;
  std::array<int, stack_size> stack{};
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = 0;
  while (top > 0) {
    const int index = stack[static_cast<std::size_t>(--top)];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (box_distance_squared(node.low, node.high, p) > bound) continue;
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i) {
        if ((nearest_on_triangle(triangle(i), p) - p).squaredNorm() <= bound) out.push_back(i);
      }
      continue;
    }
    stack[static_cast<std::size_t>(top++)] = node.right;
    stack[static_cast<std::size_t>(top++)] = index + 1;
  }
}

SegmentHits TriangleTree::hits(const Vector3d& from, const Vector3d& to) const {
  SegmentHits result;
  if (nodes_.empty()) return result;
  const Vector3d d = to - from;
  std::array<int, stack_size> stack{};
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = 0;
  while (top > 0) {
    const int index = stack[static_cast<std::size_t>(--top)];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!segment_meets_box(from, d, node.low, node.high)) continue;
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i) result += hits_of(triangle(i), from, to);
      continue;
    }
    stack[static_cast<std::size_t>(top++)] = node.right;
    stack[static_cast<std::size_t>(top++)] = index + 1;
  }
  return result;
}

double TriangleTree::winding(const Vector3d& p) const {
  if (nodes_.empty()) return 0.0;
  double sum = 0.0;
  std::array<int, stack_size> stack{};
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = 0;
  while (top > 0) {
    const int index = stack[static_cast<std::size_t>(--top)];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    const Vector3d to_centre = node.centre - p;
    const double distance = to_centre.norm();
    if (distance > far_field_ratio * node.radius) {
      sum += node.area_vector.dot(to_centre) / (distance * distance * distance);
    } else if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i) {
        const Triangle& t = triangle(i);
        sum += solid_angle(t[0] - p, t[1] - p, t[2] - p);
      }
    } else {
      stack[static_cast<std::size_t>(top++)] = node.right;
      stack[static_cast<std::size_t>(top++)] = index + 1;
    }
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace crossings
