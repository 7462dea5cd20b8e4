#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/tables/column.h"

namespace floc {

/// Options of the tables of `floc compare`.
struct CompareTableOptions {
  /// Largest relative motion of two grains in contact that belong to one rigid cluster. Two numbers measure the
  /// relative motion: the distance between the two material points that touched each other before, in units of the
  /// largest diameter, and the difference between the rotations of the two grains, in radians.
  double rigid_tolerance = 0.01;
  bool displacements = false;  ///< whether the table with a row for each grain is computed
  bool contacts = false;       ///< whether the table with a row for each contact is computed
};

/// One row of the table of `floc compare`: the changes from one state (before) to another state (after).
struct CompareRow {
  std::string before, after;
  int n_grains = 0;
  /// Reduced pressure and solid fraction; index 0 is the state `before`, index 1 the state `after`.
  double pressure[2] = {}, solid_fraction[2] = {};
  int n_before = 0, n_after = 0, n_kept = 0, n_lost = 0, n_gained = 0, n_parted = 0;
  Eigen::MatrixXd strain;  ///< strain of the cell from `before` to `after`; shortening is positive
  double rms = 0.0, largest = 0.0;
  int n_clusters = 0, n_clustered = 0, largest_cluster = 0;
};

/// Tables that `floc compare` writes to files: displacements of the grains, and contacts kept, lost and gained.
struct CompareTables {
  Table displacements, contacts;
};

/// Compares two states of the same grains. Adds rows to the tables in `side` that the options select.
/// @throws InputError if the two states do not have equal grains
template <int Dim>
CompareRow compare_row(const std::string& old_file, const State<Dim>& before, const std::string& new_file,
                       const State<Dim>& after, const CompareTableOptions& options, CompareTables& side);

/// Returns the columns of the table of `floc compare`. The strain has more columns if any of `rows` is in 3D.
/// @param rows  all rows of the table
std::vector<Column<CompareRow>> compare_columns(const std::vector<CompareRow>& rows);

}  // namespace floc
