#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace endowire::math {

/// Symmetric band matrix, lower part, with its LDLᵀ factorisation and inertia.
///
///   A = L D Lᵀ,  L unit lower triangular with the band of A, D diagonal; no pivoting.
///
/// Without pivoting the factorisation is stable when A is positive definite, which is the only case whose
/// solution is used; the number of negative entries of D equals the number of negative eigenvalues (Sylvester)
/// and says when it is not.
/// Cost      n·w² multiplications for half-bandwidth w.
/// Storage   column c holds rows c … c + w, the diagonal first; w columns of padding end the matrix.
class BandMatrix {
 public:
  /// Unknowns of one joint: x, y, z and the turn of the rod behind it.
  static constexpr int kBlock = 4;
  /// A joint's bending couples x, θ of the joint before it to x of the joint after it.
  static constexpr int kHalfBandwidth = 10;

  /// Keeps its memory when it shrinks, so that a step allocates nothing after warm-up.
  void resize(int size) {
    size_ = size;
    columns_.resize(padded(size));
    pivots_.resize(static_cast<std::size_t>(size));
  }
  void reserve(int size) {
    columns_.reserve(padded(size));
    pivots_.reserve(static_cast<std::size_t>(size));
  }
  void set_zero() { std::fill(columns_.begin(), columns_.end(), Column{}); }
  [[nodiscard]] int size() const { return size_; }

  /// Entry (row, column) of the lower part: 0 ≤ row − column ≤ kHalfBandwidth.
  [[nodiscard]] double& lower(int row, int column) {
    return columns_[static_cast<std::size_t>(column)][static_cast<std::size_t>(row - column)];
  }
  [[nodiscard]] double lower(int row, int column) const {
    return columns_[static_cast<std::size_t>(column)][static_cast<std::size_t>(row - column)];
  }
  /// Adds to the symmetric pair (a, b), (b, a).
  void add(int a, int b, double value) { a >= b ? lower(a, b) += value : lower(b, a) += value; }

  /// Makes `index` an identity row: its unknown stays where it is.
  void fix(int index);

  /// Factorises A + shift·I in place: A is gone until it is filled anew.
  /// @return the number of pivots that are not positive: 0 means positive definite.
  int factorise(double shift = 0.0);

  /// Solves with the factorisation, in place.
  void solve(std::vector<double>& x) const;

  /// y = A x, for a matrix that is not factorised.
  void multiply(const std::vector<double>& x, std::vector<double>& y) const;

 private:
  /// One entry more than the band holds: columns stay on even addresses for two-wide arithmetic.
  using Column = std::array<double, kHalfBandwidth + 2>;
  static std::size_t padded(int size) { return static_cast<std::size_t>(size + kHalfBandwidth); }

  int size_ = 0;
  std::vector<Column> columns_;
  std::vector<double> pivots_;  ///< the diagonal of A while factorising, then the inverse pivots
};

}  // namespace endowire::math
