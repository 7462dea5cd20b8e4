#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/tables/column.h"

namespace floc {

/// Options of the tables of `floc compare`.
struct CompareTableOptions {
  /// Largest relative motion of two grains in contact that counts as rigid: distance between the material
  /// points that touched, in largest diameters, and difference of the rotations of the grains, in radians.
  double rigid_tolerance = 0.01;
  bool displacements = false;  ///< adds a table with a row for each grain
  bool contacts = false;       ///< adds a table with a row for each contact
};

/// One row of `floc compare`: the changes from a state before to a state after.
struct CompareRow {
  std::string before, after;
  int n_grains = 0;
  /// Reduced pressure and solid fraction, before [0] and after [1].
  double pressure[2] = {}, solid_fraction[2] = {};
  int n_before = 0, n_after = 0, n_kept = 0, n_lost = 0, n_gained = 0, n_parted = 0;
  Eigen::MatrixXd strain;  ///< strain of the cell, shortening positive
  double rms = 0.0, largest = 0.0;
  int n_clusters = 0, n_clustered = 0, largest_cluster = 0;
};

/// Further tables of `floc compare`: displacements of the grains, and contacts kept, lost and gained.
struct CompareTables {
  Table displacements, contacts;
};

/// Compares two states. Adds the rows of the further tables that the options select to `side`.
/// @throws InputError if the two states do not have equal grains
template <int Dim>
CompareRow compare_row(const std::string& old_file, const State<Dim>& before, const std::string& new_file,
                       const State<Dim>& after, const CompareTableOptions& options, CompareTables& side);

/// Returns the columns of the table of `floc compare` for these rows.
std::vector<Column<CompareRow>> compare_columns(const std::vector<CompareRow>& rows);

}  // namespace floc
