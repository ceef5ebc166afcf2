#include "endowire/vessel/anatomy/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "endowire/vessel/anatomy/half_edges.hpp"
#include "endowire/vessel/anatomy/portable.hpp"

namespace endowire::vessel::anatomy {
namespace {

using Eigen::Vector3d;
using Index = HalfEdges::Index;

// Split above and collapse below: the two meet in the middle, 4/3 halved is below 4/5, so neither undoes the other.
constexpr double longest = 4.0 / 3.0;
constexpr double shortest = 4.0 / 5.0;
// Rounds after which the smallest angles stop growing.
constexpr int rounds = 6;
constexpr int polishing_rounds = 3;
// A triangle may turn from its vertices' normals by at most 60° in one operation.
constexpr double least_cosine = 0.5;
constexpr double least_cosine_of_halves = 0.0;
// The sum of two normals has length 2 cos of half the angle between them. Walls that turn by less than 60° need no
// care, and opposite ones have no direction between them.
constexpr double least_sum2 = 0.04;
constexpr double most_sum2 = 3.0;
constexpr double least_slope = 0.2;
// How near the surface vertices are kept meanwhile, and in the end.
constexpr double meanwhile_mm = 2e-3;
constexpr double finally_mm = 1e-7;

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh, const LumenShape& shape, const std::vector<Rim>& rims,
           const EdgeSizes& sizes)
      : shape_(shape), rims_(rims), sizes_(sizes), mesh_(mesh), position_(mesh.vertices_mm) {
    normal_.resize(position_.size());
    size_.resize(position_.size());
    rim_.assign(position_.size(), -1);
    for (Index v = 0; v < mesh_.vertices(); ++v) {
      if (!mesh_.vertex_alive(v)) continue;
      if (mesh_.on_border(v)) rim_[at(v)] = nearest_rim(position_[at(v)]);
      settle(v);
    }
  }

  TriangleMesh run() {
    for (int round = 0; round < rounds; ++round) {
      limit_growth();
      split_long();
      collapse_short();
      flip_all();
      relax();
    }
    for (int round = 0; round < polishing_rounds; ++round) {
      flip_all();
      relax();
    }
    flip_all();
    tolerance_mm_ = finally_mm;
    for (Index v = 0; v < mesh_.vertices(); ++v)
      if (mesh_.vertex_alive(v)) settle(v);
    TriangleMesh result;
    std::vector<Index> kept;
    result.triangles = mesh_.compact(kept);
    for (const Index v : kept) result.vertices_mm.push_back(position_[at(v)]);
    return result;
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] int nearest_rim(const Vector3d& p) const {
    int best = -1;
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < rims_.size(); ++i) {
      const double d = length(p - rims_[i].centre_mm);
      if (d < nearest) {
        nearest = d;
        best = static_cast<int>(i);
      }
    }
    return best;
  }

  /// A vertex on the surface.
  struct Place {
    Vector3d position, normal;
    double size;  ///< wanted length of edges
  };

  /// Where a point ends that is moved onto the surface, or onto its rim.
  [[nodiscard]] Place settled(const Vector3d& p, int rim) const {
    WallSample sample;
    Place place;
    if (rim >= 0) {
      const Rim& r = rims_[at(rim)];
      Vector3d out = p - r.centre_mm;
      out -= dot(out, r.direction) * r.direction;
      place.position = r.centre_mm + r.radius_mm * unit(out);
      sample = shape_.at(place.position);
    } else {
      place.position = shape_.projected(p, tolerance_mm_, sample);
    }
    const double radius = sample.curvature_radius_mm;
    const double sagitta = std::max(sizes_.least_over_radius * radius,
                                    std::min(sizes_.sagitta_mm, sizes_.most_over_radius * radius));
    place.normal = sample.gradient;
    place.size = std::sqrt(8.0 * radius * sagitta);
    return place;
  }

  void put(Index v, const Place& place) {
    position_[at(v)] = place.position;
    normal_[at(v)] = place.normal;
    size_[at(v)] = place.size;
  }

  void settle(Index v) { put(v, settled(position_[at(v)], rim_[at(v)])); }

  void limit_growth() {
    for (int sweep = 0; sweep < 8; ++sweep) {
      bool changed = false;
      for (Index h = 0; h < mesh_.count(); ++h) {
        if (!mesh_.alive(h)) continue;
        const double most = size_[at(mesh_.from(h))] +
                            sizes_.growth * length(position_[at(mesh_.to(h))] - position_[at(mesh_.from(h))]);
        if (size_[at(mesh_.to(h))] > most) {
          size_[at(mesh_.to(h))] = most;
          changed = true;
        }
      }
      if (!changed) return;
    }
  }

  [[nodiscard]] double length_of(Index h) const {
    return length(position_[at(mesh_.to(h))] - position_[at(mesh_.from(h))]);
  }
  [[nodiscard]] double wanted(Index a, Index b) const { return std::min(size_[at(a)], size_[at(b)]); }

  /// Cosine of the angle between the triangle a b c and the surface's normal; -1 where it has no area.
  [[nodiscard]] static double facing(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                     const Vector3d& normal) {
    const Vector3d area = cross(b - a, c - a);
    const double size2 = dot(area, area) * dot(normal, normal);
    return size2 > 0.0 ? dot(area, normal) / std::sqrt(size2) : -1.0;
  }

  /// The same of the worst triangle around a vertex, were the vertex at `p`; triangles at `gone` do not count.
  [[nodiscard]] double worst_facing(Index v, const Vector3d& p, const Vector3d& normal,
                                    Index gone = HalfEdges::none) const {
    double worst = 1.0;
    mesh_.around(v, [&](Index h) {
      const Index b = mesh_.to(h);
      const Index c = mesh_.apex(h);
      if (b == gone || c == gone) return;
      worst = std::min(
          worst, facing(p, position_[at(b)], position_[at(c)], normal + normal_[at(b)] + normal_[at(c)]));
    });
    return worst;
  }
  [[nodiscard]] double worst_facing(Index v) const {
    return worst_facing(v, position_[at(v)], normal_[at(v)]);
  }

  void split_long() {
    const Index count = mesh_.count();
    for (Index h = 0; h < count; ++h) {
      const Index o = mesh_.opposite(h);
      if (!mesh_.alive(h) || (o != HalfEdges::none && o < h)) continue;
      const Index a = mesh_.from(h);
      const Index b = mesh_.to(h);
      if (length_of(h) <= longest * wanted(a, b)) continue;
      const int rim = o == HalfEdges::none ? rim_[at(a)] : -1;
      const Place middle = settled(between_walls(a, b), rim);
      if (turns_over(h, middle) || (o != HalfEdges::none && turns_over(o, middle))) continue;
      const double most = 0.5 * (size_[at(a)] + size_[at(b)] + sizes_.growth * length_of(h));
      mesh_.split(h);
      position_.push_back(middle.position);
      normal_.push_back(middle.normal);
      size_.push_back(std::min(middle.size, most));
      rim_.push_back(rim);
    }
  }

  /// The middle of an edge, moved along the mean of its ends' normals to where the surface is: an edge that cuts
  /// off a carina has a wall on either side, and the nearest point would be on one of them.
  [[nodiscard]] Vector3d between_walls(Index a, Index b) const {
    Vector3d p = 0.5 * (position_[at(a)] + position_[at(b)]);
    const Vector3d sum = normal_[at(a)] + normal_[at(b)];
    if (dot(sum, sum) < least_sum2 || dot(sum, sum) > most_sum2) return p;
    const Vector3d along = unit(sum);
    for (int i = 0; i < 4; ++i) {
      const WallSample sample = shape_.at(p);
      const double slope = dot(sample.gradient, along);
      if (slope < least_slope) break;
      p -= sample.distance_mm / slope * along;
    }
    return p;
  }

  /// Would one of the halves of a triangle, split at `middle`, face inward? Round a carina the middle of a long
  /// edge can find the wrong wall; once its neighbours are split it finds the right one.
  [[nodiscard]] bool turns_over(Index h, const Place& middle) const {
    const Index c = mesh_.apex(h);
    const auto half = [&](Index u, bool first) {
      const Vector3d& p = position_[at(u)];
      const Vector3d normal = normal_[at(u)] + middle.normal + normal_[at(c)];
      return first ? facing(p, middle.position, position_[at(c)], normal)
                   : facing(middle.position, p, position_[at(c)], normal);
    };
    return std::min(half(mesh_.from(h), true), half(mesh_.to(h), false)) < least_cosine_of_halves;
  }

  /// Would the edges from `p` to the neighbours of `v` be short enough?
  [[nodiscard]] bool near_enough(Index v, const Vector3d& p) const {
    bool near = true;
    mesh_.around(v, [&](Index h) {
      for (const Index w : {mesh_.to(h), mesh_.apex(h)})
        near = near && length(position_[at(w)] - p) <= longest * size_[at(w)];
    });
    return near;
  }

  void collapse_short() {
    for (Index h = 0; h < mesh_.count(); ++h) {
      if (!mesh_.alive(h)) continue;
      const Index a = mesh_.from(h);
      const Index b = mesh_.to(h);
      if (length_of(h) >= shortest * wanted(a, b) || !mesh_.may_collapse(h)) continue;
      Vector3d p = position_[at(a)];
      Vector3d normal = normal_[at(a)];
      if (rim_[at(a)] < 0) {
        WallSample sample;
        p = shape_.projected(0.5 * (p + position_[at(b)]), tolerance_mm_, sample);
        normal = sample.gradient;
      }
      const double before = std::min(worst_facing(a), worst_facing(b));
      const double after = std::min(worst_facing(a, p, normal, b), worst_facing(b, p, normal, a));
      if (after < std::min(before, least_cosine)) continue;
      if (before >= least_cosine && !(near_enough(a, p) && near_enough(b, p))) continue;
      mesh_.collapse(h);
      position_[at(a)] = p;
      normal_[at(a)] = normal;
      size_[at(a)] = std::min(size_[at(a)], size_[at(b)]);
    }
  }

  /// Cosine of the angle at `apex` of the triangle over the edge p q.
  [[nodiscard]] static double cosine_at(const Vector3d& apex, const Vector3d& p, const Vector3d& q) {
    const Vector3d u = p - apex;
    const Vector3d v = q - apex;
    return dot(u, v) / std::sqrt(dot(u, u) * dot(v, v));
  }

  void flip_all() {
    for (int sweep = 0; sweep < 5; ++sweep) {
      int flips = 0;
      for (Index h = 0; h < mesh_.count(); ++h) {
        if (!mesh_.alive(h) || mesh_.opposite(h) < h) continue;
        if (wants_flip(h)) {
          mesh_.flip(h);
          ++flips;
        }
      }
      if (flips == 0) return;
    }
  }

  [[nodiscard]] bool wants_flip(Index h) const {
    const Index a = mesh_.from(h);
    const Index b = mesh_.to(h);
    const Index c = mesh_.apex(h);
    const Index d = mesh_.apex(mesh_.opposite(h));
    const Vector3d& pa = position_[at(a)];
    const Vector3d& pb = position_[at(b)];
    const Vector3d& pc = position_[at(c)];
    const Vector3d& pd = position_[at(d)];
    if (mesh_.joined(c, d)) return false;
    const auto few = [&](Index v) { return mesh_.triangles_at(v) <= (mesh_.on_border(v) ? 2 : 4); };
    const bool thin = few(a) || few(b);
    // The angles at c and d exceed π together when cos c + cos d < 0; a little less, so that ties do not flip
    // back and forth.
    const bool better = !thin && cosine_at(pc, pa, pb) + cosine_at(pd, pa, pb) < -1e-6;
    const auto between = [&](Index u, Index v, Index w) {
      return facing(position_[at(u)], position_[at(v)], position_[at(w)],
                    normal_[at(u)] + normal_[at(v)] + normal_[at(w)]);
    };
    const double before = std::min(between(a, b, c), between(b, a, d));
    if (!better && before >= least_cosine) return false;
    const double after = std::min(between(d, c, a), between(c, d, b));
    return better ? after >= std::min(before, least_cosine) : after > before + 0.1;
  }

  void relax() {
    for (Index v = 0; v < mesh_.vertices(); ++v) {
      if (!mesh_.vertex_alive(v)) continue;
      Vector3d sum = Vector3d::Zero();
      double weights = 0.0;
      if (rim_[at(v)] >= 0) {
        mesh_.around(v, [&](Index h) {
          if (mesh_.opposite(h) == HalfEdges::none) {
            sum += position_[at(mesh_.to(h))];
            weights += 1.0;
          }
          if (mesh_.opposite(mesh_.previous(h)) == HalfEdges::none) {
            sum += position_[at(mesh_.apex(h))];
            weights += 1.0;
          }
        });
      } else {
        mesh_.around(v, [&](Index h) {
          const Index b = mesh_.to(h);
          const Index c = mesh_.apex(h);
          const Vector3d& p = position_[at(v)];
          const double size = (size_[at(v)] + size_[at(b)] + size_[at(c)]) / 3.0;
          const double weight = length(cross(position_[at(b)] - p, position_[at(c)] - p)) / (size * size);
          sum += weight / 3.0 * (p + position_[at(b)] + position_[at(c)]);
          weights += weight;
        });
      }
      const double before = worst_facing(v);
      const Vector3d old = position_[at(v)];
      const Vector3d old_normal = normal_[at(v)];
      const double old_size = size_[at(v)];
      Vector3d move = sum / weights - old;
      move -= dot(move, old_normal) * old_normal;
      position_[at(v)] = old + move;
      settle(v);
      size_[at(v)] = std::min(size_[at(v)], old_size + sizes_.growth * length(move));
      if (worst_facing(v) < std::min(before, least_cosine)) {
        position_[at(v)] = old;
        normal_[at(v)] = old_normal;
        size_[at(v)] = old_size;
      }
    }
  }

  const LumenShape& shape_;
  const std::vector<Rim>& rims_;
  const EdgeSizes& sizes_;
  double tolerance_mm_ = meanwhile_mm;
  HalfEdges mesh_;
  std::vector<Vector3d> position_;
  std::vector<Vector3d> normal_;  ///< of the surface, outward
  std::vector<double> size_;      ///< wanted length of edges
  std::vector<int> rim_;          ///< that the vertex belongs to, -1 inside
};

}  // namespace

TriangleMesh remesh(const TriangleMesh& mesh, const LumenShape& shape, const std::vector<Rim>& rims,
                    const EdgeSizes& sizes) {
  return Remesher(mesh, shape, rims, sizes).run();
}

}  // namespace endowire::vessel::anatomy
