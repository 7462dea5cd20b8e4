#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "floc/fitting/scattering_fit.h"
#include "floc/io/table.h"
#include "floc/packing/state.h"
#include "floc/structure/affine_prediction.h"
#include "floc/structure/scattering.h"
#include "floc/tables/remarks.h"

namespace floc {

/// Options of the tables of `floc structure`.
struct StructureTableOptions {
  ScatteringOptions scattering;
  /// Range of wave numbers k in which a law is fitted to the scattered intensity I(k), in units of 2 pi/a with the
  /// largest diameter a.
  std::vector<double> fit_range = {0.0, 1.0};
  /// Whether a row with averages over all states is added. The states are treated as samples of one ensemble.
  bool average = false;
  /// Whether each of these tables in Series is computed in addition to the table of states.
  bool intensity = false, pairs = false, gaps = false, pores = false, map = false, prediction = false;
  bool porosity = false, profile = false;
  /// Number of cubes in which the porosity is computed. The cubes have different sizes, and are all centred at the
  /// centre of the cell.
  int n_probes = 40;
  std::optional<int> profile_axis;  ///< axis of the profile, from 0; if absent, the last axis
  int n_slices = 20;                ///< number of slices of the profile
  /// Largest distance r of the pair correlation g(r), in units of the largest diameter.
  double reach = 5.0;
  std::vector<int> map_size = {32, 32};  ///< number of mesh cells of the map along each lattice vector

  /// Returns the faults of the options as texts "name of the option: requirement". Empty if there are no faults.
  std::vector<std::string> validate() const;
};

/// Local structure of a packing of spheres: the solid fractions of the Voronoi cells of the grains, and the largest
/// balls that fit in the voids between the grains.
struct LocalStructure {
  /// Mean and standard deviation of the solid fraction of a Voronoi cell, over all grains.
  double mean = 0.0, deviation = 0.0;
  std::int64_t n_voids = 0;
  double mean_void = 0.0, largest_void = 0.0;  ///< mean and largest radius of the balls in the voids (length)
};

/// One row of the table of `floc structure`: the structure of a state, or the average over all states.
struct StructureRow {
  std::string file;
  int dimension = 0;
  std::int64_t n_grains = 0;
  double reduced_pressure = 0.0, reduced_driven_stress = 0.0, solid_fraction = 0.0;
  std::optional<double> mesh_spacing;
  Vec<2, int> mesh = Vec<2, int>::Zero();
  std::optional<ScatteringFit> fit;
  std::optional<std::int64_t> n_pores;
  std::optional<double> pore_size, pore_mean_area;
  bool unbounded = false;
  std::optional<LocalStructure> local;
  double seconds = 0.0;
};

/// Columns of two tables for states in 2D: the table of pores, and the map of the local solid fraction. The tables for
/// states in 3D have other columns.
inline const std::vector<std::string> kPoreColumns = {"file",    "x1", "x2", "area", "gyration_radius",
                                                      "n_grains"};
inline const std::vector<std::string> kMapColumns = {"file", "k1", "k2", "x1", "x2", "solid_fraction"};

/// Tables that `floc structure` writes to files, in addition to the table of states, and the sums from which the
/// average over the states is computed.
struct Series {
  Table intensity{{"file", "k", "I", "n_vectors", "I_fit"}, {}};
  Table pairs{{"file", "r", "g", "n_pairs", "r_rescaled"}, {}};
  Table gaps{{"file", "gap", "z", "z_pushed", "gap_rescaled"}, {}};
  Table pores{kPoreColumns, {}};
  Table map{kMapColumns, {}};
  Table prediction{{"reference", "file", "phi", "P", "z", "P_predicted", "z_predicted", "z_pushed_predicted"},
                   {}};
  Table porosity{{"file", "half_side", "void_ratio", "porosity", "void_ratio_cell", "porosity_cell"}, {}};
  Table profile{{"file", "low", "high", "phi", "void_ratio", "n_grains", "z", "pressure", "sigma_1", "sigma_2",
                 "sigma_3"},
                {}};
  int dimension = 0;                    ///< dimension of the first state
  std::string reference;                ///< file of the first state
  std::optional<double> reference_phi;  ///< solid fraction of the first state
  /// First state, from which coordination and pressure at other solid fractions are predicted; empty if the options do
  /// not select the table `prediction`.
  std::variant<std::monostate, AffineReference<2>, AffineReference<3>> affine;
  std::optional<ScatteringAverage> average;
  double diameter = 0.0;  ///< largest diameter of the first state (length)
  double pore_area = 0.0, pore_second_moment = 0.0;
  StructureRow mean;  ///< sums over the states, from which averaged() computes the row of means
};

/// Computes the row of one state, and adds rows to the tables in `series` that the options select. For a state with
/// walls, only the tables `pairs` (g(r)), `porosity` and `profile` are possible.
/// @throws InputError if the state has walls and the options select another table
template <int Dim>
StructureRow structure_row(const std::string& file, const State<Dim>& state,
                           const StructureTableOptions& options, Series& series, const Remarks& remarks = {});

/// Returns a row with averages over all states, which are treated as samples of one ensemble. Also adds the average
/// scattered intensity to `series.intensity`.
/// @param rows  rows of the states
StructureRow averaged(const std::vector<StructureRow>& rows, const StructureTableOptions& options,
                      Series& series, const Remarks& remarks = {});

}  // namespace floc
