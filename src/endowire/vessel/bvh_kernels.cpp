#include "endowire/vessel/bvh_kernels.hpp"

#include "endowire/math/four.hpp"
#include "endowire/math/processor.hpp"

namespace endowire::vessel {
namespace {

using math::load;

/// Of squares of lengths and of quotients in single precision: what rounding may do to them.
constexpr float rounding = 2e-6F;

template <typename F>
[[gnu::always_inline]] inline F larger(const F& a, const F& b) {
  return a > b ? a : b;
}

template <typename F>
[[gnu::always_inline]] inline F smaller(const F& a, const F& b) {
  return a < b ? a : b;
}

/// One bit a lane of a comparison.
template <typename I>
[[gnu::always_inline]] inline unsigned bits_of(const I& mask) {
  constexpr std::size_t lanes = sizeof(I) / sizeof(std::int32_t);
  I own{};  // 1, 2, 4, ...
  for (std::size_t i = 0; i < lanes; ++i) own[i] = 1 << i;
  std::array<std::uint64_t, lanes / 2> pairs;
  math::store(I(mask & own), pairs.data());
  std::uint64_t joined = 0;
  for (std::uint64_t pair : pairs) joined |= pair;
  return static_cast<unsigned>(joined | (joined >> 32U));
}

template <typename F>
[[gnu::always_inline]] inline unsigned near_boxes(const EightBoxes& boxes, const std::array<float, 3>& point,
                                                  float within2, EightFloats& distance2) {
  constexpr std::size_t lanes = sizeof(F) / sizeof(float);
  unsigned bits = 0;
  for (std::size_t i = 0; i < bvh_width; i += lanes) {
    F sum{};
    for (std::size_t k = 0; k < 3; ++k) {
      const F below = load<F>(boxes.low[k].data() + i) - point[k];
      const F above = point[k] - load<F>(boxes.high[k].data() + i);
      const F outside = larger(larger(below, above), F{});
      sum += outside * outside;
    }
    sum = sum * (1.0F - rounding);
    math::store(sum, distance2.data() + i);
    bits |= bits_of(sum <= within2) << i;
  }
  return bits;
}

/// A point h above the plane of a disc and l beside its middle is no nearer to it than √(h² + (l − R)²) where l > R. With w² what h
/// leaves of the square of the reach, it is within reach where k = l² − R² − w² is no more than 2 R w.
template <typename F>
[[gnu::always_inline]] inline unsigned near_discs(const EightDiscs& discs, const std::array<float, 3>& point,
                                                  float reach) {
  constexpr std::size_t lanes = sizeof(F) / sizeof(float);
  unsigned bits = 0;
  for (std::size_t i = 0; i < bvh_width; i += lanes) {
    F distance2{};
    F h{};
    for (std::size_t k = 0; k < 3; ++k) {
      const F away = point[k] - load<F>(discs.middle[k].data() + i);
      distance2 += away * away;
      h += away * load<F>(discs.normal[k].data() + i);
    }
    const F radius = load<F>(discs.radius.data() + i);
    const F lost2 = rounding * distance2;
    const F w2 = reach * reach - h * h + lost2;
    const F k = distance2 - h * h - radius * radius - w2 - lost2;
    bits |= bits_of((w2 >= 0.0F) & ((k <= 0.0F) | (k * k <= (4.0F + rounding) * (radius * radius * w2))))
            << i;
  }
  return bits;
}

template <typename F>
[[gnu::always_inline]] inline unsigned hit_boxes(const EightBoxes& boxes, const BvhRay& ray,
                                                 EightFloats& enters) {
  constexpr std::size_t lanes = sizeof(F) / sizeof(float);
  unsigned bits = 0;
  for (std::size_t i = 0; i < bvh_width; i += lanes) {
    F near = F{} + ray.begin;
    F far = F{} + ray.end;
    for (std::size_t k = 0; k < 3; ++k) {
      const F a = (load<F>(boxes.low[k].data() + i) - ray.from[k]) * ray.inverse[k];
      const F b = (load<F>(boxes.high[k].data() + i) - ray.from[k]) * ray.inverse[k];
      const F first = smaller(a, b);
      const F last = larger(a, b);
      near = larger(near, first - rounding * larger(first, -first));
      far = smaller(far, last + rounding * larger(last, -last));
    }
    math::store(near, enters.data() + i);
    bits |= bits_of(near <= far) << i;
  }
  return bits;
}

template <typename F>
[[gnu::always_inline]] inline unsigned hit_discs(const EightDiscs& discs, const BvhRay& ray, float margin) {
  constexpr std::size_t lanes = sizeof(F) / sizeof(float);
  unsigned bits = 0;
  for (std::size_t i = 0; i < bvh_width; i += lanes) {
    const F x = load<F>(discs.middle[0].data() + i) - ray.from[0];
    const F y = load<F>(discs.middle[1].data() + i) - ray.from[1];
    const F z = load<F>(discs.middle[2].data() + i) - ray.from[2];
    const F cx = y * ray.direction[2] - z * ray.direction[1];
    const F cy = z * ray.direction[0] - x * ray.direction[2];
    const F cz = x * ray.direction[1] - y * ray.direction[0];
    const F beside2 = cx * cx + cy * cy + cz * cz;
    // With e = 4·10⁻⁷ |v|, what rounding does to |v × d|: (r + e)² ≤ 1.01 r² + 101 e².
    const F lost2 = 2e-11F * (x * x + y * y + z * z);
    const F within = load<F>(discs.radius.data() + i) + margin;
    bits |= bits_of(beside2 <= 1.01F * within * within + lost2) << i;
  }
  return bits;
}

using FourFloats [[gnu::vector_size(16)]] = float;

unsigned near_boxes_fours(const EightBoxes& boxes, const std::array<float, 3>& point, float within2,
                          EightFloats& distance2) {
  return near_boxes<FourFloats>(boxes, point, within2, distance2);
}
unsigned near_discs_fours(const EightDiscs& discs, const std::array<float, 3>& point, float reach) {
  return near_discs<FourFloats>(discs, point, reach);
}
unsigned hit_boxes_fours(const EightBoxes& boxes, const BvhRay& ray, EightFloats& enters) {
  return hit_boxes<FourFloats>(boxes, ray, enters);
}
unsigned hit_discs_fours(const EightDiscs& discs, const BvhRay& ray, float margin) {
  return hit_discs<FourFloats>(discs, ray, margin);
}

#if ENDOWIRE_WIDE_KERNELS
using Eight [[gnu::vector_size(32)]] = float;

[[gnu::target("avx2")]] unsigned near_boxes_eights(const EightBoxes& boxes, const std::array<float, 3>& point,
                                                   float within2, EightFloats& distance2) {
  return near_boxes<Eight>(boxes, point, within2, distance2);
}
[[gnu::target("avx2")]] unsigned near_discs_eights(const EightDiscs& discs, const std::array<float, 3>& point,
                                                   float reach) {
  return near_discs<Eight>(discs, point, reach);
}
[[gnu::target("avx2")]] unsigned hit_boxes_eights(const EightBoxes& boxes, const BvhRay& ray,
                                                  EightFloats& enters) {
  return hit_boxes<Eight>(boxes, ray, enters);
}
[[gnu::target("avx2")]] unsigned hit_discs_eights(const EightDiscs& discs, const BvhRay& ray, float margin) {
  return hit_discs<Eight>(discs, ray, margin);
}
#endif

}  // namespace

const BvhKernels& bvh_kernels() {
  static const BvhKernels four{near_boxes_fours, near_discs_fours, hit_boxes_fours, hit_discs_fours};
#if ENDOWIRE_WIDE_KERNELS
  static const BvhKernels eight{near_boxes_eights, near_discs_eights, hit_boxes_eights, hit_discs_eights};
  if (math::runs_avx2()) return eight;
#endif
  return four;
}

}  // namespace endowire::vessel
