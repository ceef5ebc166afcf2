#include "endowire/vessel/brick_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "endowire/math/four.hpp"
#include "endowire/math/processor.hpp"
#include "endowire/vessel/bvh.hpp"

namespace endowire::vessel {
namespace {

// No Eigen types and no lambdas inside: their code depends on the instruction set they are compiled for.

template <typename V>
struct Vec {
  V x, y, z;
  [[gnu::always_inline]] friend Vec operator-(const Vec& a, const Vec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

template <typename V>
[[gnu::always_inline]] inline V all(double value) {
  V lanes;
  for (std::size_t i = 0; i < sizeof(V) / sizeof(double); ++i) lanes[i] = value;
  return lanes;
}

template <typename V>
[[gnu::always_inline]] inline Vec<V> all(const double* v) {
  return {all<V>(v[0]), all<V>(v[1]), all<V>(v[2])};
}

template <typename V>
[[gnu::always_inline]] inline V dot(const Vec<V>& a, const Vec<V>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <typename V, typename M>
[[gnu::always_inline]] inline void choose(const M& mask, const Vec<V>& from, Vec<V>& into) {
  into.x = mask ? from.x : into.x;
  into.y = mask ? from.y : into.y;
  into.z = mask ? from.z : into.z;
}

template <typename V>
[[gnu::always_inline]] inline V size(const V& v) {
  return v < 0.0 ? -v : v;
}

template <typename M>
[[gnu::always_inline]] inline bool in_all(const M& mask) {
  constexpr std::size_t lanes = sizeof(M) / sizeof(std::int64_t);
  std::int64_t joined = -1;
  for (std::size_t i = 0; i < lanes; ++i) joined &= mask[i];
  return joined != 0;
}

#if ENDOWIRE_WIDE_KERNELS
using QuadMask = decltype(math::Quad{} < math::Quad{});
[[gnu::always_inline]] inline bool in_all(const QuadMask& mask) {
  using Half [[gnu::vector_size(16)]] = double;
  std::array<Half, 2> halves;
  math::store(mask, halves.data());
  return (__builtin_ia32_movmskpd(halves[0]) & __builtin_ia32_movmskpd(halves[1])) == 3;
}
#endif

/// nearest_on_triangle without branches: the regions of the triangle's plane are decided last to first, and what one of them says is
/// overwritten by those that come before it. The nearest point is base + s e₁ + t (c − a).
template <typename V>
[[gnu::always_inline]] inline void try_lanes(const KernelTriangle& triangle, PointBlock& block,
                                             std::size_t lane) {
  using M = decltype(V{} < V{});
  const Vec<V> p = {math::load<V>(&block.x[lane]), math::load<V>(&block.y[lane]),
                    math::load<V>(&block.z[lane])};
  const V before = math::load<V>(&block.distance2_mm2[lane]);
  const Vec<V> a = all<V>(triangle.a);
  const Vec<V> ap = p - a;
  const Vec<V> b = all<V>(triangle.b);
  const Vec<V> c = all<V>(triangle.c);
  const Vec<V> bp = p - b;
  const Vec<V> cp = p - c;
  const Vec<V> normal = all<V>(triangle.normal);
  // The triangle is no nearer than its plane and, beside it, than its sides. Both may be wrong by e = 10⁻⁹ mm:
  // (h − e)² ≥ (1 − 10⁻⁶) h² − 10⁶ e².
  const V h = triangle.flat * dot(normal, ap);
  V beside{};
  const V beyond_a = dot(all<V>(triangle.side[0].data()), ap);
  const V beyond_b = dot(all<V>(triangle.side[1].data()), bp);
  const V beyond_c = dot(all<V>(triangle.side[2].data()), cp);
  beside = beyond_a > beside ? beyond_a : beside;
  beside = beyond_b > beside ? beyond_b : beside;
  beside = beyond_c > beside ? beyond_c : beside;
  if (in_all((h * h + beside * beside) * (1.0 - 1e-6) - 2e-12 > before)) return;

  const Vec<V> ab = b - a;
  const Vec<V> ac = c - a;
  const V d1 = dot(ab, ap);
  const V d2 = dot(ac, ap);
  const V d3 = dot(ab, bp);
  const V d4 = dot(ac, bp);
  const V d5 = dot(ab, cp);
  const V d6 = dot(ac, cp);
  const V va = d3 * d6 - d5 * d4;
  const V vb = d5 * d2 - d1 * d6;
  const V vc = d1 * d4 - d3 * d2;
  const V terms =
      ((size(d3 * d6) + size(d5 * d4)) + (size(d5 * d2) + size(d1 * d6))) + (size(d1 * d4) + size(d3 * d2));
  const V zero{};
  const M at_a = (d1 <= zero) & (d2 <= zero);
  const M at_b = (d3 >= zero) & (d4 <= d3);
  const M at_c = (d6 >= zero) & (d5 <= d6);
  const M on_ab = (vc <= zero) & (d1 >= zero) & (d3 <= zero);
  const M on_ac = (vb <= zero) & (d2 >= zero) & (d6 <= zero);
  const M on_bc = (va <= zero) & (d4 - d3 >= zero) & (d5 - d6 >= zero);

  V above = all<V>(1.0);
  V below = va + vb + vc;
  above = on_bc ? d4 - d3 : above;
  below = on_bc ? (d4 - d3) + (d5 - d6) : below;
  above = on_ac ? d2 : above;
  below = on_ac ? d2 - d6 : below;
  above = on_ab ? d1 : above;
  below = on_ab ? d1 - d3 : below;
  const V part = above / below;

  const M on_edge = on_ab | on_ac | on_bc;
  const V s = on_edge ? part : vb * part;
  const V t = on_edge ? zero : vc * part;
  Vec<V> base = a;
  Vec<V> e1 = ab;
  M feature{};
  choose(on_bc, b, base);
  choose(on_bc, c - b, e1);
  feature = on_bc ? M{} + 2 : feature;
  choose(on_ac, a, base);
  choose(on_ac, ac, e1);
  feature = on_ac ? M{} + 3 : feature;
  choose(on_ab, a, base);
  choose(on_ab, ab, e1);
  feature = on_ab ? M{} + 1 : feature;
  Vec<V> nearest = {(base.x + e1.x * s) + ac.x * t, (base.y + e1.y * s) + ac.y * t,
                    (base.z + e1.z * s) + ac.z * t};
  choose(at_c, c, nearest);
  feature = at_c ? M{} + 6 : feature;
  choose(at_b, b, nearest);
  feature = at_b ? M{} + 5 : feature;
  choose(at_a, a, nearest);
  feature = at_a ? M{} + 4 : feature;
  const M open = ~(at_a | at_b | at_c) & ~(va + vb + vc > needle * terms);
  math::store(math::load<M>(&block.needle[lane]) | open, &block.needle[lane]);
  const Vec<V> away = p - nearest;
  const V distance2 = dot(away, away);

  const M last = math::load<M>(&block.triangle[lane]);
  const M number = M{} + triangle.triangle;
  const M better = (distance2 < before) | ((distance2 == before) & (number < last));
  math::store(better ? number : last, &block.triangle[lane]);
  math::store(better ? feature : math::load<M>(&block.feature[lane]), &block.feature[lane]);
  math::store(better ? distance2 : before, &block.distance2_mm2[lane]);
  math::store(better ? dot(normal, away) : math::load<V>(&block.height_mm[lane]), &block.height_mm[lane]);
  math::store(better ? nearest.x : math::load<V>(&block.nearest_x[lane]), &block.nearest_x[lane]);
  math::store(better ? nearest.y : math::load<V>(&block.nearest_y[lane]), &block.nearest_y[lane]);
  math::store(better ? nearest.z : math::load<V>(&block.nearest_z[lane]), &block.nearest_z[lane]);
}

template <typename V>
[[gnu::always_inline]] inline void try_block(const KernelTriangle& triangle, PointBlock& block) {
  constexpr std::size_t lanes = sizeof(V) / sizeof(double);
  for (std::size_t lane = 0; lane < block.count; lane += lanes) try_lanes<V>(triangle, block, lane);
}

template <typename V>
[[gnu::always_inline]] inline void slopes_in_lanes(const PointBlock& nodes, Slopes& slopes) {
  constexpr std::size_t lanes = sizeof(V) / sizeof(double);
  for (std::size_t n = 0; n < nodes.count; n += lanes) {
    const V distance = math::load<V>(&nodes.distance_mm[n]);
    math::store((math::load<V>(&nodes.x[n]) - math::load<V>(&nodes.nearest_x[n])) / distance, &slopes.x[n]);
    math::store((math::load<V>(&nodes.y[n]) - math::load<V>(&nodes.nearest_y[n])) / distance, &slopes.y[n]);
    math::store((math::load<V>(&nodes.z[n]) - math::load<V>(&nodes.nearest_z[n])) / distance, &slopes.z[n]);
  }
}

template <typename V>
[[gnu::always_inline]] inline void range_in_lanes(const PointBlock& nodes, const Slopes& slopes,
                                                  double half_mm, TangentRange& range) {
  constexpr std::size_t lanes = sizeof(V) / sizeof(double);
  constexpr std::size_t along = 5;
  for (std::size_t cell = 0; cell < TangentRange::cells; cell += lanes) {
    const std::size_t first = (cell / 16 * along + cell / 4 % 4) * along + cell % 4;
    V low = V{} + std::numeric_limits<double>::infinity();
    V high = -low;
    for (std::size_t o = 0; o < 8; ++o) {
      const std::size_t i = o & 1U;
      const std::size_t j = (o >> 1U) & 1U;
      const std::size_t k = o >> 2U;
      const std::size_t n = first + (i * along + j) * along + k;
      const V x = math::load<V>(&slopes.x[n]);
      const V y = math::load<V>(&slopes.y[n]);
      const V z = math::load<V>(&slopes.z[n]);
      const V along_x = i == 0 ? x : -x;
      const V along_y = j == 0 ? y : -y;
      const V along_z = k == 0 ? z : -z;
      const V plane = math::load<V>(&nodes.distance_mm[n]) + half_mm * ((along_x + along_y) + along_z);
      low = plane < low ? plane : low;
      high = plane > high ? plane : high;
    }
    math::store(low, &range.low_mm[cell]);
    math::store(high, &range.high_mm[cell]);
  }
}

/// @param root  square roots of distance2_mm2
template <typename V>
[[gnu::always_inline]] inline V signed_by_face(const PointBlock& block, std::size_t n, const V& root) {
  return math::load<V>(&block.height_mm[n]) <= 0.0 ? root : -root;
}

using Two [[gnu::vector_size(16)]] = double;

void try_twos(const KernelTriangle& triangle, PointBlock& block) {
  try_block<Two>(triangle, block);
}
void end_in_twos(PointBlock& block) {
  for (std::size_t n = 0; n < block.count; n += 2) {
    const Two root = {std::sqrt(block.distance2_mm2[n]), std::sqrt(block.distance2_mm2[n + 1])};
    math::store(signed_by_face(block, n, root), &block.distance_mm[n]);
  }
}
void slopes_in_twos(const PointBlock& nodes, Slopes& slopes) {
  slopes_in_lanes<Two>(nodes, slopes);
}
void range_in_twos(const PointBlock& nodes, const Slopes& slopes, double half_mm, TangentRange& range) {
  range_in_lanes<Two>(nodes, slopes, half_mm, range);
}

#if ENDOWIRE_WIDE_KERNELS
[[gnu::target("avx2")]] void try_quads(const KernelTriangle& triangle, PointBlock& block) {
  try_block<math::Quad>(triangle, block);
}
[[gnu::target("avx2")]] void end_in_quads(PointBlock& block) {
  for (std::size_t n = 0; n < block.count; n += 4) {
    const math::Quad root = __builtin_ia32_sqrtpd256(math::load<math::Quad>(&block.distance2_mm2[n]));
    math::store(signed_by_face(block, n, root), &block.distance_mm[n]);
  }
}
[[gnu::target("avx2")]] void slopes_in_quads(const PointBlock& nodes, Slopes& slopes) {
  slopes_in_lanes<math::Quad>(nodes, slopes);
}
[[gnu::target("avx2")]] void range_in_quads(const PointBlock& nodes, const Slopes& slopes, double half_mm,
                                            TangentRange& range) {
  range_in_lanes<math::Quad>(nodes, slopes, half_mm, range);
}
#endif

struct Kernels {
  void (*try_triangle)(const KernelTriangle&, PointBlock&);
  void (*end_search)(PointBlock&);
  void (*slopes)(const PointBlock&, Slopes&);
  void (*range)(const PointBlock&, const Slopes&, double, TangentRange&);
};

const Kernels& kernels() {
#if ENDOWIRE_WIDE_KERNELS
  static const Kernels chosen = math::runs_avx2()
                                    ? Kernels{try_quads, end_in_quads, slopes_in_quads, range_in_quads}
                                    : Kernels{try_twos, end_in_twos, slopes_in_twos, range_in_twos};
#else
  static const Kernels chosen{try_twos, end_in_twos, slopes_in_twos, range_in_twos};
#endif
  return chosen;
}

}  // namespace

void begin_search(PointBlock& block) {
  const std::size_t padded = (block.count + 3) / 4 * 4;
  for (std::size_t n = block.count; n < padded; ++n) {
    block.x[n] = block.x[block.count - 1];
    block.y[n] = block.y[block.count - 1];
    block.z[n] = block.z[block.count - 1];
  }
  const auto to = static_cast<std::ptrdiff_t>(padded);
  std::fill(block.distance2_mm2.begin(), block.distance2_mm2.begin() + to,
            std::numeric_limits<double>::infinity());
  std::fill(block.needle.begin(), block.needle.begin() + to, 0);
  std::fill(block.triangle.begin(), block.triangle.begin() + to, std::numeric_limits<std::int64_t>::max());
}

void try_triangle(const KernelTriangle& triangle, PointBlock& block) {
  kernels().try_triangle(triangle, block);
}
void end_search(PointBlock& block) {
  kernels().end_search(block);
}
void slopes_of(const PointBlock& nodes, Slopes& slopes) {
  kernels().slopes(nodes, slopes);
}
void tangent_range(const PointBlock& nodes, const Slopes& slopes, double half_mm, TangentRange& range) {
  kernels().range(nodes, slopes, half_mm, range);
}

}  // namespace endowire::vessel
