#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace floc {

/// Columns of a triangular factor that have the same rows below their triangle, supernode by supernode, as CHOLMOD
/// lays them out: column-major blocks, whose first rows are their own columns.
struct Supernodes {
  std::span<const std::int64_t> first_column;  ///< first column of each supernode, and the number of columns
  std::span<const std::int64_t> first_row;     ///< beginning of each supernode in `row`, and the end
  std::span<const std::int64_t> first_value;   ///< beginning of each supernode in `value`, and the end
  std::span<const std::int64_t> row;           ///< ascending in each
  double* value = nullptr;
};

/// Lower triangle of a symmetric matrix by columns. The supernodes have a place for each of its entries.
struct LowerColumns {
  std::span<const std::int64_t> first;  ///< entry of each column, and their number
  const std::int64_t* row = nullptr;
  const double* value = nullptr;
};

/// Factorizes a symmetric matrix A + shift * 1, whatever its signs, as L S L^T, where S is diagonal with entries
/// of 1 and -1, without pivoting. All but the smallest blocks are products of dense matrices, which makes it as
/// fast as a Cholesky factorization by supernodes. The number of negative entries of S is that of the negative
/// eigenvalues (Sylvester).
/// @param smallest_pivot  replaces pivots closer to zero, so that the elimination goes on
/// @return S, or nothing where A is not finite
std::vector<double> factorize_signed(const LowerColumns& matrix, double shift, double smallest_pivot,
                                     const Supernodes& factor);

}  // namespace floc
