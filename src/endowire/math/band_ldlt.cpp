#include "endowire/math/band_ldlt.hpp"

#include <cmath>

#include "endowire/base/contract.hpp"
#include "endowire/math/band_columns.hpp"
#include "endowire/math/four.hpp"
#include "endowire/math/processor.hpp"

namespace endowire::math {

namespace {

constexpr int kBlock = BandMatrix::kBlock;
constexpr int kHeight = BandMatrix::kBlocks * kBlock;

/// Factorises blocks of columns in place: below the diagonal block L D, so that of the two factors of a product one is at hand as
/// it is; in the diagonal block the inverse of its unit lower part, without the diagonal.
/// @param size  unknowns; further ones complete the last block and are not counted
template <typename Four>
[[gnu::always_inline]] inline int factorise_blocks(double* own, double* inverse, int size, double shift) {
  int not_positive = 0;
  // Left-looking: a block takes what the two before it subtract, and is then factorised itself.
  for (int first = 0; first < size; first += kBlock, own += kBlock * kHeight, inverse += kBlock) {
    Four a[4][3];
    double scale[4];
    for (int q = 0; q < 4; ++q) {
      scale[q] = std::abs(own[kHeight * q + q]) + shift;
      for (int b = 0; b < 3; ++b) a[q][b] = load<Four>(own + kHeight * q + 4 * b);
    }
    if (first >= 2 * kBlock) {
      for (int k = -8; k < -4; ++k) {
        const Four w = load<Four>(own + kHeight * k + 8);
        double l[4];
        store(inverse[k] * w, l);
        for (int q = 0; q < 4; ++q) a[q][0] -= l[q] * w;
      }
    }
    if (first >= kBlock) {
      for (int k = -4; k < 0; ++k) {
        const Four w = load<Four>(own + kHeight * k + 4);
        const Four below = load<Four>(own + kHeight * k + 8);
        double l[4];
        store(inverse[k] * w, l);
        for (int q = 0; q < 4; ++q) {
          a[q][0] -= l[q] * w;
          a[q][1] -= l[q] * below;
        }
      }
    }
    double d[4][4];  // d[q][p], p >= q: the diagonal block by columns
    for (int q = 0; q < 4; ++q) {
      store(a[q][0], d[q]);
      d[q][q] += shift;
    }
    double l[4][4];  // l[p][q], p > q
    for (int q = 0; q < 4; ++q) {
      // What the columns before took off the diagonal; a pivot lost in its rounding is no pivot.
      double pivot = d[q][q];
      if (!(pivot > kRelativePivot * scale[q])) {
        not_positive += first + q < size ? 1 : 0;
        if (!(std::abs(pivot) > kRelativePivot * scale[q])) pivot = -kRelativePivot * (scale[q] + 1e-300);
      }
      inverse[q] = 1.0 / pivot;
      for (int p = q + 1; p < 4; ++p) {
        l[p][q] = inverse[q] * d[q][p];
        for (int r = p; r < 4; ++r) d[p][r] -= l[p][q] * d[q][r];
        for (int b = 1; b < 3; ++b) a[p][b] -= l[p][q] * a[q][b];
      }
    }
    const double m20 = l[2][1] * l[1][0] - l[2][0];
    const double m31 = l[3][2] * l[2][1] - l[3][1];
    const double m30 = l[3][2] * l[2][0] + l[3][1] * l[1][0] - l[3][0] - l[3][2] * l[2][1] * l[1][0];
    const double m[4][4] = {
        {0.0, -l[1][0], m20, m30}, {0.0, 0.0, -l[2][1], m31}, {0.0, 0.0, 0.0, -l[3][2]}, {}};
    for (std::size_t q = 0; q < 4; ++q)
      for (std::size_t r = 0; r < 4; ++r) own[kHeight * q + r] = m[q][r];
    for (int q = 0; q < 4; ++q) {
      store(a[q][1], own + kHeight * q + 4);
      store(a[q][2], own + kHeight * q + 8);
    }
  }
  return not_positive;
}

/// x of whole blocks, with two blocks of padding.
template <typename Four>
[[gnu::always_inline]] inline void solve_blocks(const double* own, const double* inverse, int blocks,
                                                double* x) {
  for (int block = 0; block < blocks; ++block, own += kBlock * kHeight, inverse += kBlock, x += kBlock) {
    Four x0 = load<Four>(x);
    const Four b = x0;
    for (int q = 0; q < 3; ++q) x0 += b[q] * load<Four>(own + kHeight * q);
    x0 = x0 * load<Four>(inverse);
    store(x0, x);
    Four x1 = load<Four>(x + 4);
    Four x2 = load<Four>(x + 8);
    for (int q = 0; q < 4; ++q) {
      x1 -= x0[q] * load<Four>(own + kHeight * q + 4);
      x2 -= x0[q] * load<Four>(own + kHeight * q + 8);
    }
    store(x1, x + 4);
    store(x2, x + 8);
  }
  for (int block = 0; block < blocks; ++block) {
    own -= kBlock * kHeight, inverse -= kBlock, x -= kBlock;
    const Four x1 = load<Four>(x + 4);
    const Four x2 = load<Four>(x + 8);
    Four product[4];
    for (int q = 0; q < 4; ++q)
      product[q] = x1 * load<Four>(own + kHeight * q + 4) + x2 * load<Four>(own + kHeight * q + 8);
    const Four v = load<Four>(x) - load<Four>(inverse) * sums(product[0], product[1], product[2], product[3]);
    for (int q = 0; q < 4; ++q) product[q] = v * load<Four>(own + kHeight * q);
    store(v + sums(product[0], product[1], product[2], product[3]), x);
  }
}

/// y += A x of whole blocks, with two blocks of padding.
template <typename Four>
[[gnu::always_inline]] inline void multiply_blocks(const double* own, int blocks, const double* x,
                                                   double* y) {
  for (int block = 0; block < blocks; ++block, own += kBlock * kHeight, x += kBlock, y += kBlock) {
    const Four x0 = load<Four>(x);
    const Four x1 = load<Four>(x + 4);
    const Four x2 = load<Four>(x + 8);
    Four y0 = load<Four>(y);
    Four y1 = load<Four>(y + 4);
    Four y2 = load<Four>(y + 8);
    Four across[4];
    for (int q = 0; q < 4; ++q) {
      const Four a0 = load<Four>(own + kHeight * q);
      const Four a1 = load<Four>(own + kHeight * q + 4);
      const Four a2 = load<Four>(own + kHeight * q + 8);
      y0 += x0[q] * a0;
      y1 += x0[q] * a1;
      y2 += x0[q] * a2;
      across[q] = x1 * a1 + x2 * a2;
    }
    // The upper half of the diagonal block: column by column what lies below its diagonal, turned over.
    const double* next = own + kHeight;
    const double upper[4] = {own[1] * x[1] + own[2] * x[2] + own[3] * x[3], next[2] * x[2] + next[3] * x[3],
                             next[kHeight + 3] * x[3], 0.0};
    store(y0 + load<Four>(upper) + sums(across[0], across[1], across[2], across[3]), y);
    store(y1, y + 4);
    store(y2, y + 8);
  }
}

int factorise_pairs(double* columns, double* inverse, int size, double shift) {
  return factorise_blocks<Pairs>(columns, inverse, size, shift);
}
void solve_pairs(const double* columns, const double* inverse, int blocks, double* x) {
  solve_blocks<Pairs>(columns, inverse, blocks, x);
}
void multiply_pairs(const double* columns, int blocks, const double* x, double* y) {
  multiply_blocks<Pairs>(columns, blocks, x, y);
}

#if ENDOWIRE_WIDE_KERNELS
[[gnu::target("avx2")]] int factorise_quads(double* columns, double* inverse, int size, double shift) {
  return factorise_blocks<Quad>(columns, inverse, size, shift);
}
[[gnu::target("avx2")]] void solve_quads(const double* columns, const double* inverse, int blocks,
                                         double* x) {
  solve_blocks<Quad>(columns, inverse, blocks, x);
}
[[gnu::target("avx2")]] void multiply_quads(const double* columns, int blocks, const double* x, double* y) {
  multiply_blocks<Quad>(columns, blocks, x, y);
}
#endif

struct Kernels {
  int (*factorise)(double*, double*, int, double);
  void (*solve)(const double*, const double*, int, double*);
  void (*multiply)(const double*, int, const double*, double*);
};

const Kernels& kernels() {
#if ENDOWIRE_WIDE_KERNELS
  static const Kernels chosen = runs_avx2() ? Kernels{factorise_quads, solve_quads, multiply_quads}
                                            : Kernels{factorise_pairs, solve_pairs, multiply_pairs};
#else
  static const Kernels chosen{factorise_pairs, solve_pairs, multiply_pairs};
#endif
  return chosen;
}

}  // namespace

void BandMatrix::resize(int size, int block) {
  ENDOWIRE_EXPECTS(size >= 0 && block >= 1, "sizes");
  size_ = size;
  if (block != block_) start_.clear();
  block_ = block;
  const auto padded = static_cast<std::size_t>(block_ * (blocks() + kBlocks - 1));
  entries_.resize(padded * static_cast<std::size_t>(height()));
  for (auto c = static_cast<int>(start_.size()); c < static_cast<int>(padded); ++c)
    start_.push_back(height() * c - block_ * (c / block_));
  inverse_pivots_.resize(padded);
  for (auto* v : {&in_, &out_}) v->assign(padded, 0.0);
}

void BandMatrix::reserve(int size, int block) {
  const auto padded = static_cast<std::size_t>(size + block * kBlocks);
  entries_.reserve(padded * static_cast<std::size_t>(kBlocks * block));
  start_.reserve(padded);
  for (auto* v : {&inverse_pivots_, &in_, &out_}) v->reserve(padded);
}

void BandMatrix::fix(int index) {
  for (int column = block_ * std::max(0, index / block_ - kBlocks + 1); column < index; ++column)
    lower(index, column) = 0.0;
  std::fill_n(&lower(index / block_ * block_, index), height(), 0.0);
  lower(index, index) = 1.0;
}

int BandMatrix::factorise(double shift) {
  for (int c = size_; c < block_ * blocks(); ++c) fix(c);
  if (block_ != kBlock) {
    return factorise_columns({block_, blocks(), entries_.data()}, inverse_pivots_.data(), size_, shift);
  }
  return kernels().factorise(entries_.data(), inverse_pivots_.data(), size_, shift);
}

void BandMatrix::solve(std::vector<double>& x) {
  std::copy_n(x.begin(), size_, in_.begin());
  if (block_ != kBlock) {
    solve_columns({block_, blocks(), entries_.data()}, inverse_pivots_.data(), in_.data());
  } else {
    kernels().solve(entries_.data(), inverse_pivots_.data(), blocks(), in_.data());
  }
  std::copy_n(in_.begin(), size_, x.begin());
}

void BandMatrix::multiply(const std::vector<double>& x, std::vector<double>& y) {
  std::copy_n(x.begin(), size_, in_.begin());
  std::fill(out_.begin(), out_.end(), 0.0);
  if (block_ != kBlock) {
    multiply_columns({block_, blocks(), entries_.data()}, in_.data(), out_.data());
  } else {
    kernels().multiply(entries_.data(), blocks(), in_.data(), out_.data());
  }
  std::copy_n(out_.begin(), size_, y.begin());
}

}  // namespace endowire::math
