#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace endowire::math {

/// Symmetric matrix of a chain of joints, lower part, with its LDLᵀ factorisation and inertia.
///
///   A = L D Lᵀ,  L unit lower triangular with the band of A, D diagonal; no pivoting.
///
/// Unknowns come in blocks of one size, one per joint: four for one instrument, one more for each that shares its centreline. A
/// joint is coupled to the two before and the two after it.
/// Without pivoting the factorisation is stable when A is positive definite, which is the only case whose
/// solution is used; the number of negative entries of D equals the number of negative eigenvalues (Sylvester)
/// and says when it is not.
/// Cost      blocks of four: four products of 4 × 4 blocks a joint, four numbers at a time; others: one column after another.
/// Storage   each column holds the rows of its own block and of the next two, the upper half of the diagonal block zero; two
///           blocks of padding end the matrix, and a last block that is not full is.
class BandMatrix {
 public:
  /// Unknowns of a joint of one instrument: x, y, z and the turn of the rod behind it.
  static constexpr int kBlock = 4;
  /// Blocks of a column: a joint's bending couples the joint before it to the joint after it.
  static constexpr int kBlocks = 3;

  /// Keeps its memory when it shrinks, so that a step allocates nothing after warm-up.
  /// @param block  unknowns of a joint, ≥ 1
  void resize(int size, int block = kBlock);
  void reserve(int size, int block = kBlock);
  void set_zero() { std::fill(entries_.begin(), entries_.end(), 0.0); }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int block() const { return block_; }

  /// Whether the matrix has a place for this entry of its lower part.
  [[nodiscard]] bool holds(int row, int column) const {
    return row >= column && row / block_ - column / block_ < kBlocks;
  }
  /// Entry (row, column) of the lower part, where holds() is true.
  [[nodiscard]] double& lower(int row, int column) {
    return entries_[static_cast<std::size_t>(start_[static_cast<std::size_t>(column)] + row)];
  }
  [[nodiscard]] double lower(int row, int column) const {
    return entries_[static_cast<std::size_t>(start_[static_cast<std::size_t>(column)] + row)];
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
  [[nodiscard]] int height() const { return kBlocks * block_; }  ///< rows of a column
  [[nodiscard]] int blocks() const { return (size_ + block_ - 1) / block_; }

  int size_ = 0;
  int block_ = kBlock;
  std::vector<double> entries_;  ///< column by column
  std::vector<int> start_;       ///< where row 0 of each column would be
  std::vector<double> inverse_pivots_;
  std::vector<double> in_, out_;  ///< padded like the columns
};

}  // namespace endowire::math
