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
  std::copy(columns_.begin(), columns_.end(), factor_.begin());
  int not_positive = 0;
  // Right-looking: each column, once final, is subtracted from the ten that follow. Entries beyond the matrix are zero.
  for (int c = 0; c < size_; ++c) {
    const auto uc = static_cast<std::size_t>(c);
    Column& column = factor_[uc];
    if (!shift.empty()) column[0] += shift[uc];
    // What the columns before took off the diagonal; a pivot lost in its rounding is no pivot.
    const double scale = std::abs(columns_[uc][0]) + (shift.empty() ? 0.0 : shift[uc]);
    double pivot = column[0];
    if (!(pivot > kRelativePivot * scale)) {
      ++not_positive;
      if (!(std::abs(pivot) > kRelativePivot * scale)) pivot = -kRelativePivot * (scale + 1e-300);
    }
    const double inverse = 1.0 / pivot;
    inverse_pivots_[uc] = inverse;
    for (std::size_t i = 1; i <= kWidth; ++i) {
      Column& next = factor_[uc + i];
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
    const Column& l = factor_[static_cast<std::size_t>(c)];
    double* at = x.data() + c;
    if (c < whole) {
      for (std::size_t i = 1; i <= kWidth; ++i) at[i] -= l[i] * at[0];
    } else {
      for (int i = 1; i < size_ - c; ++i) at[i] -= l[static_cast<std::size_t>(i)] * at[0];
    }
  }
  for (int c = size_ - 1; c >= 0; --c) {
    const Column& l = factor_[static_cast<std::size_t>(c)];
    double* at = x.data() + c;
    double even = at[0] * inverse_pivots_[static_cast<std::size_t>(c)];
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
  for (int r = 0; r < size_; ++r) {
    for (int c = std::max(0, r - kWidth); c <= r; ++c) {
      const double entry = lower(r, c);
      y[static_cast<std::size_t>(r)] += entry * x[static_cast<std::size_t>(c)];
      if (c != r) y[static_cast<std::size_t>(c)] += entry * x[static_cast<std::size_t>(r)];
    }
  }
}

}  // namespace endowire::math
