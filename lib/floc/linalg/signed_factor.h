#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace floc {

/// Supernodes of a triangular factor, in the layout of CHOLMOD. A supernode is a group of neighbouring columns with
/// nonzero entries in the same rows. These entries form one column-major block. The first rows of the block have the
/// same numbers as the columns of the group.
struct Supernodes {
  /// number of the first column of each supernode; last entry: number of columns of the matrix
  std::span<const std::int64_t> first_column;
  /// index in `row` at which each supernode begins; last entry: size of `row`
  std::span<const std::int64_t> first_row;
  /// index in `value` at which each supernode begins; last entry: size of `value`
  std::span<const std::int64_t> first_value;
  /// numbers of the rows of all supernodes, ascending within each supernode
  std::span<const std::int64_t> row;
  double* value = nullptr;
};

/// Lower triangle of a symmetric matrix by columns. Each entry of this triangle must have a place in the supernodes of
/// the factor.
struct LowerColumns {
  /// index of the first entry of each column; last entry: number of all entries
  std::span<const std::int64_t> first;
  const std::int64_t* row = nullptr;
  const double* value = nullptr;
};

/// Factorizes a symmetric matrix A + shift * 1, definite or indefinite, as L S L^T without pivoting. S is diagonal with
/// entries of 1 and -1. By Sylvester's law of inertia, A + shift * 1 has as many negative eigenvalues as S has negative
/// entries. The factorization is as fast as a Cholesky factorization by supernodes, because most of the work consists
/// of products of dense matrices.
/// @param matrix          lower triangle of A
/// @param smallest_pivot  value that replaces pivots of smaller absolute value, so that the elimination can continue
/// @param factor          receives L
/// @return diagonal of S; empty if A is not finite
std::vector<double> factorize_signed(const LowerColumns& matrix, double shift, double smallest_pivot,
                                     const Supernodes& factor);

}  // namespace floc
