#include "endowire/math/band_columns.hpp"

#include <cmath>

namespace endowire::math {

namespace {

/// One column of the lower part, from its diagonal down.
struct Column {
  double* entry;  ///< entry[0] on the diagonal
  int rows;       ///< below the diagonal
};

/// What walks along the columns.
class Columns {
 public:
  explicit Columns(const BandColumns& matrix)
      : block_(matrix.block), height_(3 * matrix.block), entries_(matrix.entries) {}
  [[nodiscard]] Column operator[](int column) const {
    const int within = column % block_;
    return {entries_ + height_ * column + within, height_ - 1 - within};
  }

 private:
  int block_, height_;
  double* entries_;
};

}  // namespace

int factorise_columns(const BandColumns& matrix, double* inverse, int size, double shift) {
  const Columns columns(matrix);
  const int n = matrix.block * matrix.blocks;
  // Right-looking: what a column takes off the diagonals after it is known before their pivots are judged; until then the place of
  // a pivot's inverse keeps the size of the entry that it came from.
  for (int c = 0; c < n; ++c) inverse[c] = std::abs(columns[c].entry[0]) + shift;
  int not_positive = 0;
  for (int c = 0; c < n; ++c) {
    const Column own = columns[c];
    const double scale = inverse[c];
    double pivot = own.entry[0] + shift;
    if (!(pivot > kRelativePivot * scale)) {
      not_positive += c < size ? 1 : 0;
      if (!(std::abs(pivot) > kRelativePivot * scale)) pivot = -kRelativePivot * (scale + 1e-300);
    }
    inverse[c] = 1.0 / pivot;
    for (int r = 1; r <= own.rows && c + r < n; ++r) {
      const double l = inverse[c] * own.entry[r];
      double* other = columns[c + r].entry;
      for (int p = r; p <= own.rows; ++p) other[p - r] -= l * own.entry[p];
    }
  }
  return not_positive;
}

void solve_columns(const BandColumns& matrix, const double* inverse, double* x) {
  const Columns columns(matrix);
  const int n = matrix.block * matrix.blocks;
  for (int c = 0; c < n; ++c) {
    const Column own = columns[c];
    x[c] *= inverse[c];
    for (int r = 1; r <= own.rows; ++r) x[c + r] -= x[c] * own.entry[r];
  }
  for (int c = n - 1; c >= 0; --c) {
    const Column own = columns[c];
    double sum = 0.0;
    for (int r = 1; r <= own.rows; ++r) sum += own.entry[r] * x[c + r];
    x[c] -= inverse[c] * sum;
  }
}

void multiply_columns(const BandColumns& matrix, const double* x, double* y) {
  const Columns columns(matrix);
  const int n = matrix.block * matrix.blocks;
  for (int c = 0; c < n; ++c) {
    const Column own = columns[c];
    double sum = own.entry[0] * x[c];
    for (int r = 1; r <= own.rows; ++r) {
      sum += own.entry[r] * x[c + r];
      y[c + r] += own.entry[r] * x[c];
    }
    y[c] += sum;
  }
}

}  // namespace endowire::math
