#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace endowire::math {

/// Symmetric matrix of a chain of joints, lower part, with its LDLᵀ factorisation and inertia.
///
///   A = L D Lᵀ,  L unit lower triangular with the band of A, D diagonal; no pivoting.
///
/// Unknowns come in blocks of four, one per joint; a joint is coupled to the two before and the two after it.
/// Without pivoting the factorisation is stable when A is positive definite, which is the only case whose
/// solution is used; the number of negative entries of D equals the number of negative eigenvalues (Sylvester)
/// and says when it is not.
/// Cost      four products of 4 × 4 blocks a joint, four numbers at a time.
/// Storage   each column holds the rows of its own block and of the next two, twelve numbers, the upper half of the diagonal
///           block zero; two blocks of padding end the matrix, and a last block that is not full is.
class BandMatrix {
 public:
  /// Unknowns of one joint: x, y, z and the turn of the rod behind it.
  static constexpr int kBlock = 4;
  /// Blocks of a column: a joint's bending couples the joint before it to the joint after it.
  static constexpr int kBlocks = 3;

  /// Column of the lower part.
  using Column = std::array<double, static_cast<std::size_t>(kBlocks* kBlock)>;

  /// Keeps its memory when it shrinks, so that a step allocates nothing after warm-up.
  void resize(int size);
  void reserve(int size);
  void set_zero() { std::fill(columns_.begin(), columns_.end(), Column{}); }
  [[nodiscard]] int size() const { return size_; }

  /// Whether the matrix has a place for this entry of its lower part.
  [[nodiscard]] static constexpr bool holds(int row, int column) {
    return row >= column && row / kBlock - column / kBlock < kBlocks;
  }
  /// Entry (row, column) of the lower part, where holds() is true.
  [[nodiscard]] double& lower(int row, int column) {
    return columns_[static_cast<std::size_t>(column)][place(row, column)];
  }
  [[nodiscard]] double lower(int row, int column) const {
    return columns_[static_cast<std::size_t>(column)][place(row, column)];
  }
  /// Adds to the symmetric pair (a, b), (b, a).
  void add(int a, int b, double value) { a >= b ? lower(a, b) += value : lower(b, a) += value; }

  /// Makes `index` an identity row: its unknown stays where it is.
  void fix(int index);

  /// Factorises A + shift·I in place: A is gone until it is filled anew.
  /// @return the number of pivots that are not positive: 0 means positive definite.
  int factorise(double shift = 0.0);

  /// Solves with the factorisation, in place.
  void solve(std::vector<double>& x);

  /// y = A x, for a matrix that is not factorised.
  void multiply(const std::vector<double>& x, std::vector<double>& y);

 private:
  static std::size_t place(int row, int column) {
    return static_cast<std::size_t>(row - column / kBlock * kBlock);
  }
  [[nodiscard]] int blocks() const { return (size_ + kBlock - 1) / kBlock; }

  int size_ = 0;
  std::vector<Column> columns_;
  std::vector<double> inverse_pivots_;
  std::vector<double> in_, out_;  ///< padded like the columns
};

}  // namespace endowire::math
