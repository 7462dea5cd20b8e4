#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/tables/column.h"

namespace floc {

/// Options of the rows of `floc compare`.
struct CompareTableOptions {
  /// Largest motion within a contact that counts as rigid: distance between its two contact points, in largest
  /// diameters, and difference of the rotations of its grains, in radians.
  double rigid_tolerance = 0.01;
  bool displacements = false;  ///< adds a table with a row for each grain
  bool contacts = false;       ///< adds a table with a row for each contact
};

/// One row: the changes between two states.
struct CompareRow {
  std::string before, after;
  int n_grains = 0;
  double pressure[2] = {}, solid_fraction[2] = {};  ///< before and after; the pressures are reduced
  int n_before = 0, n_after = 0, n_kept = 0, n_lost = 0, n_gained = 0, n_parted = 0;
  Eigen::MatrixXd strain;  ///< of the cell, shortening positive
  double rms = 0.0, largest = 0.0;
  int n_clusters = 0, n_clustered = 0, largest_cluster = 0;
};

/// Tables beside the main one.
struct CompareTables {
  Table displacements, contacts;
};

/// Compares two states. The rows of the other tables are added to `side`.
/// @throws InputError if the states are not of the same grains
template <int Dim>
CompareRow compare_row(const std::string& old_file, const State<Dim>& before, const std::string& new_file,
                       const State<Dim>& after, const CompareTableOptions& options, CompareTables& side);

/// Returns the columns of a table of these rows.
std::vector<Column<CompareRow>> compare_columns(const std::vector<CompareRow>& rows);

}  // namespace floc
