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

int BandMatrix::factorise(double shift) {
  for (int c = 0; c < size_; ++c) {
    double& diagonal = columns_[static_cast<std::size_t>(c)][0];
    pivots_[static_cast<std::size_t>(c)] = std::abs(diagonal) + shift;
    diagonal += shift;
  }
  int not_positive = 0;
  // Right-looking: each column, once final, is subtracted from the ten that follow. Entries beyond the matrix are zero.
  for (int c = 0; c < size_; ++c) {
    const auto uc = static_cast<std::size_t>(c);
    Column& column = columns_[uc];
    // What the columns before took off the diagonal; a pivot lost in its rounding is no pivot.
    const double scale = pivots_[uc];
    double pivot = column[0];
    if (!(pivot > kRelativePivot * scale)) {
      ++not_positive;
      if (!(std::abs(pivot) > kRelativePivot * scale)) pivot = -kRelativePivot * (scale + 1e-300);
    }
    const double inverse = 1.0 / pivot;
    pivots_[uc] = inverse;
    for (std::size_t i = 1; i <= kWidth; ++i) {
      Column& next = columns_[uc + i];
      const double l = column[i] * inverse;
      for (std::size_t k = i; k <= kWidth; ++k) next[k - i] -= l * column[k];
    }
    for (std::size_t i = 1; i <= kWidth; ++i) column[i] *= inverse;
  }
  return not_positive;
}

void BandMatrix::solve(std::vector<double>& x) const {
  // Lengths known to the compiler but for the last ten rows: these loops are a third of a Newton iteration.
  const int whole = std::max(0, size_ - kWidth);
  for (int c = 0; c < size_; ++c) {
    const Column& l = columns_[static_cast<std::size_t>(c)];
    double* at = x.data() + c;
    if (c < whole) {
      for (std::size_t i = 1; i <= kWidth; ++i) at[i] -= l[i] * at[0];
    } else {
      for (int i = 1; i < size_ - c; ++i) at[i] -= l[static_cast<std::size_t>(i)] * at[0];
    }
  }
  for (int c = size_ - 1; c >= 0; --c) {
    const Column& l = columns_[static_cast<std::size_t>(c)];
    double* at = x.data() + c;
    double even = at[0] * pivots_[static_cast<std::size_t>(c)];
    double odd = 0.0;
    if (c < whole) {
      for (std::size_t i = 1; i <= kWidth; i += 2) {
        even -= l[i] * at[i];
        odd -= l[i + 1] * at[i + 1];
      }
    } else {
      for (int i = 1; i < size_ - c; ++i) even -= l[static_cast<std::size_t>(i)] * at[i];
    }
    at[0] = even + odd;
  }
}

void BandMatrix::multiply(const std::vector<double>& x, std::vector<double>& y) const {
  std::fill(y.begin(), y.end(), 0.0);
  const int whole = std::max(0, size_ - kWidth);
  for (int c = 0; c < size_; ++c) {
    const Column& a = columns_[static_cast<std::size_t>(c)];
    const double* from = x.data() + c;
    double* to = y.data() + c;
    double sum = a[0] * from[0];
    const auto pair = [&](std::size_t i) {
      to[i] += a[i] * from[0];
      sum += a[i] * from[i];
    };
    if (c < whole) {
      for (std::size_t i = 1; i <= kWidth; ++i) pair(i);
    } else {
      for (int i = 1; i < size_ - c; ++i) pair(static_cast<std::size_t>(i));
    }
    to[0] += sum;
  }
}

}  // namespace endowire::math
