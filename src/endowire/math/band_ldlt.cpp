#include "endowire/math/band_ldlt.hpp"

#include <cmath>

namespace endowire::math {

namespace {
constexpr int kWidth = BandMatrix::kHalfBandwidth;
/// A pivot this small relative to its diagonal entry carries no correct digit.
constexpr double kRelativePivot = 1e-14;
}  // namespace

void BandMatrix::fix(int index) {
  for (int column = std::max(0, index - kWidth); column < index; ++column) lower(index, column) = 0.0;
  for (int row = index + 1; row <= std::min(size_ - 1, index + kWidth); ++row) lower(row, index) = 0.0;
  lower(index, index) = 1.0;
}

int BandMatrix::factorise(const std::vector<double>& shift) {
  int not_positive = 0;
  for (int r = 0; r < size_; ++r) {
    const auto ur = static_cast<std::size_t>(r);
    const Row& a = rows_[ur];
    Row& f = factor_[ur];
    const int first = std::max(0, r - kWidth);
    // u_c = L(r,c)·D(c), row-oriented: u_c = a(r,c) − Σ_k u_k L(c,k).
    for (int c = first; c < r; ++c) {
      const Row& l = factor_[static_cast<std::size_t>(c)];
      double sum = a[static_cast<std::size_t>(c - r + kWidth)];
      for (int k = std::max(first, c - kWidth); k < c; ++k) {
        sum -= f[static_cast<std::size_t>(k - r + kWidth)] * l[static_cast<std::size_t>(k - c + kWidth)];
      }
      f[static_cast<std::size_t>(c - r + kWidth)] = sum;
    }
    const double diagonal = a[kWidth] + (shift.empty() ? 0.0 : shift[ur]);
    double pivot = diagonal;
    for (int c = first; c < r; ++c) {
      double& entry = f[static_cast<std::size_t>(c - r + kWidth)];
      const double l = entry / pivots_[static_cast<std::size_t>(c)];
      pivot -= entry * l;
      entry = l;
    }
    if (!(pivot > kRelativePivot * std::abs(diagonal))) {
      ++not_positive;
      if (!(std::abs(pivot) > kRelativePivot * std::abs(diagonal))) pivot = -kRelativePivot * (std::abs(diagonal) + 1e-300);
    }
    pivots_[ur] = pivot;
  }
  return not_positive;
}

void BandMatrix::solve(std::vector<double>& x) const {
  for (int r = 0; r < size_; ++r) {
    const Row& f = factor_[static_cast<std::size_t>(r)];
    double sum = x[static_cast<std::size_t>(r)];
    for (int c = std::max(0, r - kWidth); c < r; ++c) {
      sum -= f[static_cast<std::size_t>(c - r + kWidth)] * x[static_cast<std::size_t>(c)];
    }
    x[static_cast<std::size_t>(r)] = sum;
  }
  for (int r = 0; r < size_; ++r) x[static_cast<std::size_t>(r)] /= pivots_[static_cast<std::size_t>(r)];
  for (int r = size_ - 1; r >= 0; --r) {
    const Row& f = factor_[static_cast<std::size_t>(r)];
    const double value = x[static_cast<std::size_t>(r)];
    for (int c = std::max(0, r - kWidth); c < r; ++c) {
      x[static_cast<std::size_t>(c)] -= f[static_cast<std::size_t>(c - r + kWidth)] * value;
    }
  }
}

void BandMatrix::multiply(const std::vector<double>& x, std::vector<double>& y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (int r = 0; r < size_; ++r) {
    for (int c = std::max(0, r - kWidth); c <= r; ++c) {
      const double entry = lower(r, c);
      y[static_cast<std::size_t>(r)] += entry * x[static_cast<std::size_t>(c)];
      if (c != r) y[static_cast<std::size_t>(c)] += entry * x[static_cast<std::size_t>(r)];
    }
  }
}

}  // namespace endowire::math
