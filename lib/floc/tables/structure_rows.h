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

/// Options of the rows of `floc structure`.
struct StructureTableOptions {
  ScatteringOptions scattering;
  std::vector<double> fit_range = {0.0, 1.0};  ///< wave numbers fitted, in 2 pi over the largest diameter
  bool average = false;                        ///< adds a row for all states as samples of one ensemble
  /// Tables beside the main one.
  bool intensity = false, pairs = false, gaps = false, pores = false, map = false, prediction = false;
  bool porosity = false, profile = false;
  int n_probes = 40;                     ///< number of boxes about the centre, for the porosity
  std::optional<int> profile_axis;       ///< axis of the profile, from 0; default: the last
  int n_slices = 20;                     ///< slices of the profile
  double reach = 5.0;                    ///< largest r of g(r), in largest diameters
  std::vector<int> map_size = {32, 32};  ///< mesh cells of the map along each lattice vector

  /// Lists every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Local structure of spheres: the solid fraction of their Voronoi cells, and the balls that fit in the voids.
struct LocalStructure {
  double mean = 0.0,
         deviation = 0.0;  ///< mean and standard deviation of the local solid fraction over the grains
  std::int64_t n_voids = 0;
  double mean_void = 0.0, largest_void = 0.0;  ///< radii of the balls (length)
};

/// One row: the structure of a state, or of all states together.
struct StructureRow {
  std::string file;
  int dimension = 0;
  std::int64_t n_grains = 0;
  double reduced_pressure = 0.0, solid_fraction = 0.0;
  std::optional<double> mesh_spacing;
  Vec<2, int> mesh = Vec<2, int>::Zero();
  std::optional<ScatteringFit> fit;
  std::optional<std::int64_t> n_pores;
  std::optional<double> pore_size, pore_mean_area;
  bool unbounded = false;
  std::optional<LocalStructure> local;
  double seconds = 0.0;
};

/// Columns of the pores and of the map of disks; the tables of spheres have other columns.
inline const std::vector<std::string> kPoreColumns = {"file",    "x1", "x2", "area", "gyration_radius",
                                                      "n_grains"};
inline const std::vector<std::string> kMapColumns = {"file", "k1", "k2", "x1", "x2", "solid_fraction"};

/// Tables beside the main one, and sums over the states.
struct Series {
  Table intensity{{"file", "k", "I", "n_vectors", "I_fit"}, {}};
  Table pairs{{"file", "r", "g", "n_pairs", "r_rescaled"}, {}};
  Table gaps{{"file", "gap", "z", "z_pushed", "gap_rescaled"}, {}};
  Table pores{kPoreColumns, {}};
  Table map{kMapColumns, {}};
  Table prediction{{"reference", "file", "phi", "P", "z", "P_predicted", "z_predicted", "z_pushed_predicted"},
                   {}};
  Table porosity{{"file", "half_side", "void_ratio", "porosity", "void_ratio_cell", "porosity_cell"}, {}};
  Table profile{{"file", "low", "high", "phi", "void_ratio", "n_grains", "z", "pressure"}, {}};
  int dimension = 0;                    ///< dimension of the first state
  std::string reference;                ///< file of the first state
  std::optional<double> reference_phi;  ///< solid fraction of the first state
  /// Affine prediction of the first state for other solid fractions, if that table is selected.
  std::variant<std::monostate, AffineReference<2>, AffineReference<3>> affine;
  std::optional<ScatteringAverage> average;
  double diameter = 0.0;  ///< largest diameter of the first state (length)
  double pore_area = 0.0, pore_second_moment = 0.0;
  StructureRow mean;  ///< sums over the states, until they are divided by their number
};

/// Computes the row of one state, and adds the rows of the other tables that the options select to `series`. For a
/// state with walls the tables can be g(r), porosity and profiles.
/// @throws InputError if the state has walls and another table is selected
template <int Dim>
StructureRow structure_row(const std::string& file, const State<Dim>& state,
                           const StructureTableOptions& options, Series& series, const Remarks& remarks = {});

/// Returns the last row, which takes all states as samples of one ensemble.
StructureRow averaged(const std::vector<StructureRow>& rows, const StructureTableOptions& options,
                      Series& series, const Remarks& remarks = {});

}  // namespace floc
