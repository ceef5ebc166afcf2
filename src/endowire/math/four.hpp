#pragma once

#include <cstring>

/// Whether this machine's compiler can build kernels for instruction sets that not every machine has, to be chosen at run time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__EMSCRIPTEN__)
#define ENDOWIRE_WIDE_KERNELS 1
#else
#define ENDOWIRE_WIDE_KERNELS 0
#endif

namespace endowire::math {

/// Four doubles at a time, for kernels that are built once for every machine and once for machines with AVX2.
///
/// Both kinds do the same operations in the same order, none of them fused, so that they give the same bits: Pairs where registers
/// hold two numbers, Quad where they hold four.
struct Pairs {
  using Two [[gnu::vector_size(16)]] = double;
  Two low, high;

  [[gnu::always_inline]] double operator[](int i) const { return i < 2 ? low[i] : high[i - 2]; }
  [[gnu::always_inline]] Pairs& operator+=(const Pairs& b) {
    low += b.low, high += b.high;
    return *this;
  }
  [[gnu::always_inline]] Pairs& operator-=(const Pairs& b) {
    low -= b.low, high -= b.high;
    return *this;
  }
  [[gnu::always_inline]] friend Pairs operator+(const Pairs& a, const Pairs& b) {
    return {a.low + b.low, a.high + b.high};
  }
  [[gnu::always_inline]] friend Pairs operator-(const Pairs& a, const Pairs& b) {
    return {a.low - b.low, a.high - b.high};
  }
  [[gnu::always_inline]] friend Pairs operator*(const Pairs& a, const Pairs& b) {
    return {a.low * b.low, a.high * b.high};
  }
  [[gnu::always_inline]] friend Pairs operator*(double a, const Pairs& b) { return {a * b.low, a * b.high}; }
};

/// A row of numbers side by side in memory, of any of these kinds or of other vectors.
template <typename Row, typename Number>
[[gnu::always_inline]] inline Row load(const Number* from) {
  Row row;
  std::memcpy(&row, from, sizeof(row));
  return row;
}

template <typename Row, typename Number>
[[gnu::always_inline]] inline void store(const Row& row, Number* to) {
  std::memcpy(to, &row, sizeof(row));
}

/// The sums (v₀ + v₁) + (v₂ + v₃) of four vectors.
[[gnu::always_inline]] inline Pairs sums(const Pairs& a, const Pairs& b, const Pairs& c, const Pairs& d) {
  return {Pairs::Two{a.low[0] + a.low[1], b.low[0] + b.low[1]} +
              Pairs::Two{a.high[0] + a.high[1], b.high[0] + b.high[1]},
          Pairs::Two{c.low[0] + c.low[1], d.low[0] + d.low[1]} +
              Pairs::Two{c.high[0] + c.high[1], d.high[0] + d.high[1]}};
}
#if ENDOWIRE_WIDE_KERNELS
using Quad [[gnu::vector_size(32)]] = double;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored \
    "-Wpsabi"  // how a Quad is returned does not matter where every call is inlined
[[gnu::always_inline]] inline Quad sums(const Quad& a, const Quad& b, const Quad& c, const Quad& d) {
  const Quad ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}
#endif

}  // namespace endowire::math
