#pragma once

namespace endowire::math {

/// A pivot this small relative to its diagonal entry carries no correct digit.
inline constexpr double kRelativePivot = 1e-14;

/// Lower part of a symmetric matrix of blocks of any size, as BandMatrix stores it: each column holds the rows of its own block and
/// of the next two; two blocks of padding follow.
struct BandColumns {
  int block = 0;   ///< unknowns of a block
  int blocks = 0;  ///< without the padding
  double* entries = nullptr;
};

/// LDLᵀ in place, one column after another: below the diagonal L D.
/// @param inverse  of D, one a column
/// @param size     unknowns; further ones complete the last block and are not counted
/// @return         number of pivots that are not positive
int factorise_columns(const BandColumns& matrix, double* inverse, int size, double shift);

/// Solves with that, in place. @param x  padded like the columns
void solve_columns(const BandColumns& matrix, const double* inverse, double* x);

/// y += A x. @param x, y  padded like the columns
void multiply_columns(const BandColumns& matrix, const double* x, double* y);

}  // namespace endowire::math
