#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "columns.h"
#include "floc/packing/state.h"

namespace floc {

/// What `floc compare` is asked.
struct CompareCommand {
  std::vector<std::string> files;
  bool against_first = false;
  double rigid_tolerance = 0.01;
  std::string displacements;  ///< file for a row a grain; empty: none
  std::string contacts;       ///< file for a row a contact; empty: none
  std::string format;
};

/// One row: what happened between two states.
struct CompareRow {
  std::string before, after;
  int n_grains = 0;
  double pressure[2] = {}, solid_fraction[2] = {};  ///< before, after; pressures reduced
  int n_before = 0, n_after = 0, n_kept = 0, n_lost = 0, n_gained = 0, n_parted = 0;
  Eigen::MatrixXd strain;  ///< of the cell, shortening positive
  double rms = 0.0, largest = 0.0;
  int n_clusters = 0, n_clustered = 0, largest_cluster = 0;
};

/// Rows that go to files beside the main table.
struct CompareTables {
  Table displacements, contacts;
};

/// Compares two states; rows of files go to `side`.
/// @throws InputError if they are not of the same grains
template <int Dim>
CompareRow compare_row(const std::string& old_file, const State<Dim>& before, const std::string& new_file,
                       const State<Dim>& after, const CompareCommand& command, CompareTables& side);

/// The columns of a table of these rows.
std::vector<Column<CompareRow>> compare_columns(const std::vector<CompareRow>& rows);

}  // namespace floc
