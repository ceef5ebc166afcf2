#include "endowire/vessel/bvh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace endowire::vessel {
namespace {

using Eigen::Vector3d;

/// Parts of the largest coordinate, or of a length, by which bounds are widened: more than rounding to single precision takes.
constexpr double widening = 1e-6;
/// A triangle whose corners lie further off the plane of its normal is a sliver: its bound is a ball.
constexpr double flat_mm = 5e-10;

float overstated(double value) {
  return static_cast<float>(value * (1.0 + widening));
}

constexpr std::size_t stack_size =
    128;  // a tree of 2³¹ triangles is at most 12 nodes deep, each leaves 7 parts behind

}  // namespace

namespace {

/// Nearest point of the three sides of a triangle.
double nearest_on_sides(const Vector3d& p, const std::array<const Vector3d*, 3>& corners, Vector3d& nearest,
                        std::uint8_t& feature) {
  double best2 = std::numeric_limits<double>::infinity();
  for (std::uint8_t k = 0; k < 3; ++k) {
    const auto next = static_cast<std::uint8_t>((k + 1) % 3);
    const Vector3d& from = *corners[k];
    const Vector3d side = *corners[next] - from;
    const double along = side.dot(p - from);
    const double whole = side.squaredNorm();
    Vector3d q = from;
    std::uint8_t f = 4 + k;
    if (along >= whole && whole > 0.0) {
      q = *corners[next];
      f = 4 + next;
    } else if (along > 0.0) {
      q = from + (along / whole) * side;
      f = 1 + k;
    }
    const double d2 = (p - q).squaredNorm();
    if (d2 >= best2) continue;
    best2 = d2;
    nearest = q;
    feature = f;
  }
  return best2;
}

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
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  // What these are differences of.
  const double terms = ((std::abs(d3 * d6) + std::abs(d5 * d4)) + (std::abs(d5 * d2) + std::abs(d1 * d6))) +
                       (std::abs(d1 * d4) + std::abs(d3 * d2));
  if (!(va + vb + vc > needle * terms)) return nearest_on_sides(p, {&a, &b, &c}, nearest, feature);
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    nearest = a + (d1 / (d1 - d3)) * ab;
    feature = 1;
    return (p - nearest).squaredNorm();
  }
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    nearest = a + (d2 / (d2 - d6)) * ac;
    feature = 3;
    return (p - nearest).squaredNorm();
  }
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

/// Halves by medians along the longest side, thrice for a node.
class TriangleBvh::Builder {
 public:
  explicit Builder(TriangleBvh& bvh) : bvh_(bvh), mesh_(bvh.mesh_), order_(mesh_.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    centres_.resize(order_.size());
    for (std::size_t t = 0; t < centres_.size(); ++t)
      centres_[t] = (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3.0;
    const Eigen::AlignedBox3d box = bounds_mm(mesh_);
    bvh_.origin_mm_ = box.center();
    bvh_.extent_mm_ = 0.5 * box.sizes().maxCoeff();
    bvh_.leaves_.reserve(order_.size() / 6 + 1);
    bvh_.nodes_.reserve(order_.size() / 40 + 1);
    add_node({0, static_cast<std::int32_t>(order_.size())});
  }

 private:
  static std::int32_t size(const Range& range) { return range.end - range.begin; }

  std::int32_t add_node(const Range& range) {
    const auto index = bvh_.nodes_.size();
    bvh_.nodes_.emplace_back();
    std::array<Range, bvh_width> parts{range};
    std::size_t count = 1;
    while (count < bvh_width) {
      const auto largest = std::max_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
                                            [](const Range& a, const Range& b) { return size(a) < size(b); });
      if (size(*largest) <= static_cast<std::int32_t>(bvh_width)) break;
      const std::int32_t middle = halve(*largest);
      parts[count++] = {middle, largest->end};
      largest->end = middle;
    }
    bvh_.nodes_[index].used = (1U << count) - 1U;
    for (std::size_t i = 0; i < count; ++i) {
      bound(bvh_.nodes_[index].boxes, i, parts[i]);
      const std::int32_t number = size(parts[i]) <= static_cast<std::int32_t>(bvh_width)
                                      ? -1 - add_leaf(parts[i])
                                      : add_node(parts[i]);
      bvh_.nodes_[index].part[i] = number;
    }
    return static_cast<std::int32_t>(index);
  }

  std::int32_t halve(const Range& range) {
    Eigen::AlignedBox3d box;
    for (std::int32_t i = range.begin; i < range.end; ++i) box.extend(centres_[at(i)]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    constexpr auto width = static_cast<std::int32_t>(bvh_width);
    const std::int32_t leaves = (size(range) + width - 1) / width;
    const std::int32_t middle = range.begin + (leaves + 1) / 2 * width;  // all leaves but the last are full
    std::nth_element(order_.begin() + range.begin, order_.begin() + middle, order_.begin() + range.end,
                     [&](std::int32_t i, std::int32_t j) {
                       const double a = centres_[static_cast<std::size_t>(i)][axis];
                       const double b = centres_[static_cast<std::size_t>(j)][axis];
                       return a < b || (a == b && i < j);
                     });
    return middle;
  }

  void bound(EightBoxes& boxes, std::size_t i, const Range& range) const {
    Eigen::AlignedBox3d box;
    for (std::int32_t n = range.begin; n < range.end; ++n)
      for (std::size_t k = 0; k < 3; ++k) box.extend(mesh_.corner(at(n), k));
    const double margin_mm = widening * bvh_.extent_mm_;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      boxes.low[k][i] = static_cast<float>(box.min()[axis] - bvh_.origin_mm_[axis] - margin_mm);
      boxes.high[k][i] = static_cast<float>(box.max()[axis] - bvh_.origin_mm_[axis] + margin_mm);
    }
  }

  std::int32_t add_leaf(const Range& range) {
    Leaf& leaf = bvh_.leaves_.emplace_back();
    leaf.used = (1U << static_cast<unsigned>(size(range))) - 1U;
    for (std::int32_t i = range.begin; i < range.end; ++i) {
      const auto place = static_cast<std::size_t>(i - range.begin);
      leaf.triangle[place] = order_[static_cast<std::size_t>(i)];
      surround(leaf.discs, place, at(i));
    }
    return static_cast<std::int32_t>(bvh_.leaves_.size() - 1);
  }

  void surround(EightDiscs& discs, std::size_t i, std::size_t t) const {
    Vector3d normal = mesh_.area_normal(t).stableNormalized();
    double radius2 = 0.0;
    double off_mm = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d to_corner = mesh_.corner(t, k) - centres_[t];
      radius2 = std::max(radius2, to_corner.squaredNorm());
      off_mm = std::max(off_mm, std::abs(normal.dot(to_corner)));
    }
    if (!(off_mm <= flat_mm)) normal.setZero();
    const Vector3d middle = centres_[t] - bvh_.origin_mm_;
    for (std::size_t k = 0; k < 3; ++k) {
      discs.middle[k][i] = static_cast<float>(middle[static_cast<Eigen::Index>(k)]);
      discs.normal[k][i] = static_cast<float>(normal[static_cast<Eigen::Index>(k)]);
    }
    discs.radius[i] = overstated(std::sqrt(radius2));
  }

  [[nodiscard]] std::size_t at(std::int32_t i) const {
    return static_cast<std::size_t>(order_[static_cast<std::size_t>(i)]);
  }

  TriangleBvh& bvh_;
  const TriangleMesh& mesh_;
  std::vector<std::int32_t> order_;
  std::vector<Vector3d> centres_;
};

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) : mesh_(mesh), kernels_(bvh_kernels()) {
  if (!mesh.triangles.empty()) Builder(*this);
}

std::array<float, 3> TriangleBvh::near_origin(const Vector3d& point_mm) const {
  const Vector3d p = point_mm - origin_mm_;
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

namespace {

/// Parts of a tree that are still to be visited, those that promise most on top.
class Ahead {
 public:
  struct Entry {
    float bound;
    std::int32_t part;
  };
  [[nodiscard]] bool empty() const { return count_ == 0; }
  Entry pop() { return entries_[--count_]; }
  /// Adds the parts of a node that bits mark, the one with the smallest bound last.
  void push(unsigned bits, const EightFloats& bounds, const std::array<std::int32_t, bvh_width>& parts) {
    const std::size_t first = count_;
    for (; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      std::size_t place = count_++;
      for (; place > first && entries_[place - 1].bound < bounds[i]; --place)
        entries_[place] = entries_[place - 1];
      entries_[place] = {bounds[i], parts[i]};
    }
  }

 private:
  std::array<Entry, stack_size> entries_;
  std::size_t count_ = 0;
};

template <class Visit>
void each_bit(unsigned bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace

template <class Enter, class Visit, class Lost>
void TriangleBvh::walk(const Enter& enter, const Visit& visit, const Lost& lost) const {
  if (nodes_.empty()) return;
  Ahead ahead;
  EightFloats bounds;
  std::int32_t part = 0;
  for (;;) {
    if (part >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(part)];
      ahead.push(node.used & enter(node.boxes, bounds), bounds, node.part);
    } else if (!visit(leaves_[static_cast<std::size_t>(-1 - part)])) {
      return;
    }
    Ahead::Entry next{};
    do {
      if (ahead.empty()) return;
      next = ahead.pop();
    } while (lost(next.bound));
    part = next.part;
  }
}

NearestPoint TriangleBvh::nearest(const Vector3d& p, double within_mm, double enough_mm) const {
  NearestPoint best;
  const std::array<float, 3> point = near_origin(p);
  const double margin_mm = widening * (extent_mm_ + (p - origin_mm_).cwiseAbs().maxCoeff());
  double best2 = within_mm * within_mm;
  float within2 = overstated(best2);
  float reach = overstated(within_mm + margin_mm);
  const double enough2 = enough_mm * enough_mm;
  const auto attempt = [&](std::int32_t t) {
    const auto index = static_cast<std::size_t>(t);
    Vector3d q;
    std::uint8_t feature = 0;
    const double d2 = nearest_on_triangle(p, mesh_.corner(index, 0), mesh_.corner(index, 1),
                                          mesh_.corner(index, 2), q, feature);
    if (d2 > best2 || (d2 == best2 && best.triangle >= 0 && t > best.triangle)) return;
    best2 = d2;
    best.point_mm = q;
    best.triangle = t;
    best.feature = feature;
  };
  walk([&](const EightBoxes& boxes,
           EightFloats& bounds) { return kernels_.near_boxes(boxes, point, within2, bounds); },
       [&](const Leaf& leaf) {
         const double before2 = best2;
         each_bit(leaf.used & kernels_.near_discs(leaf.discs, point, reach),
                  [&](std::size_t i) { attempt(leaf.triangle[i]); });
         if (best2 < before2) {
           within2 = overstated(best2);
           reach = overstated(std::sqrt(best2) + margin_mm);
         }
         return !(best2 < before2 && best2 < enough2);
       },
       [&](float bound) { return bound > within2; });
  if (best.triangle >= 0) best.distance_mm = std::sqrt(best2);
  return best;
}

bool TriangleBvh::touching(const Eigen::AlignedBox3d& box, std::vector<std::int32_t>& out,
                           std::size_t most) const {
  out.clear();
  const Vector3d low = box.min() - origin_mm_;
  const Vector3d high = box.max() - origin_mm_;
  walk(
      [&](const EightBoxes& boxes, EightFloats& bounds) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < bvh_width; ++i) {
          bool touches = true;
          for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            touches = touches && low[axis] <= static_cast<double>(boxes.high[k][i]) &&
                      high[axis] >= static_cast<double>(boxes.low[k][i]);
          }
          bits |= (touches ? 1U : 0U) << i;
        }
        bounds.fill(0.0F);
        return bits;
      },
      [&](const Leaf& leaf) {
        each_bit(leaf.used, [&](std::size_t i) {
          const std::int32_t t = leaf.triangle[i];
          Eigen::AlignedBox3d own;
          for (std::size_t k = 0; k < 3; ++k) own.extend(mesh_.corner(static_cast<std::size_t>(t), k));
          if (box.intersects(own)) out.push_back(t);
        });
        return out.size() <= most;
      },
      [](float) { return false; });
  return out.size() <= most;
}

TriangleBvh::Hit TriangleBvh::cast(const Vector3d& origin, const Vector3d& direction, double from_mm,
                                   double to_mm) const {
  Hit hit;
  BvhRay ray{near_origin(origin), {}, {}, static_cast<float>(from_mm * (1.0 - widening)), overstated(to_mm)};
  constexpr float steepest = 1e30F;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.direction[k] = static_cast<float>(direction[static_cast<Eigen::Index>(k)]);
    ray.inverse[k] = std::abs(ray.direction[k]) > 1.0F / steepest ? 1.0F / ray.direction[k] : steepest;
  }
  const auto margin =
      static_cast<float>(widening * (extent_mm_ + (origin - origin_mm_).cwiseAbs().maxCoeff()));
  double nearest = to_mm;
  // Möller & Trumbore 1997
  const auto attempt = [&](std::int32_t t) {
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
  walk([&](const EightBoxes& boxes, EightFloats& enters) { return kernels_.hit_boxes(boxes, ray, enters); },
       [&](const Leaf& leaf) {
         each_bit(leaf.used & kernels_.hit_discs(leaf.discs, ray, margin),
                  [&](std::size_t i) { attempt(leaf.triangle[i]); });
         ray.end = overstated(nearest);
         return true;
       },
       [&](float bound) { return bound > ray.end; });
  return hit;
}

}  // namespace endowire::vessel
