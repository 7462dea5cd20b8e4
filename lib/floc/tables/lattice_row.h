#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/table.h"
#include "floc/lattice/fracture.h"
#include "floc/lattice/node_stress.h"
#include "floc/lattice/phase_bounds.h"

namespace floc {

/// The row of the table of `floc lattice`: a cemented packing that is modelled as a lattice of springs, its load, and
/// its response to the load.
struct LatticeRow {
  std::string file;
  int dimension = 2;
  std::int64_t n_grains = 0, n_nodes = 0, n_unknowns = 0, n_elements = 0;
  double spacing = 0.0, nodes_a_diameter = 0.0, fit_strain = 0.0;
  double grain_content = 0.0, matrix_content = 0.0, bridge_width = 0.0;
  int n_bridges = 0, n_removed = 0, n_islands = 0;
  double k_grain = 0.0, k_matrix = 0.0, k_interface = 0.0, k_contact = 0.0;
  std::string load, boundary;
  int axis = 1;  ///< number (from 0) of the axis of the load
  int n_bare = 0, n_open = 0;
  SpringRelaxationReport report;
  std::vector<double> strain,
      stress;  ///< stress components in the order 11, 22, 12 (2D) or 11, 22, 33, 23, 13, 12 (3D)
  /// whether the load has a normal component along the axis; otherwise E is undefined
  bool loaded_along_axis = true;
  StressDistribution all, grain, matrix, forces;
  int n_pairs = 0;  ///< number of pairs of grains that exert forces on each other
  /// number of pairs of grains whose forces are compared with those of another state; absent without such a state
  std::optional<int> n_compared;
  std::optional<double> pearson_bonded, pearson_state;
  std::optional<Eigen::MatrixXd> moduli;
  std::optional<CompositeBounds> bounds;
  BoundsThatHold bounds_hold;
  std::optional<FracturePath> fracture;
  double seconds_lattice = 0.0, seconds_solve = 0.0, seconds = 0.0;
};

/// Returns the table of `floc lattice`, which has a single row.
Table table_of(const LatticeRow& row);

}  // namespace floc
