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
  std::vector<double> fit_range = {0.0, 1.0};  ///< in 2 pi over the largest diameter
  bool average = false;                        ///< also a row for all states as samples of one
  /// Tables beside the main one.
  bool intensity = false, pairs = false, gaps = false, pores = false, map = false, prediction = false;
  bool porosity = false, profile = false;
  int n_probes = 40;                ///< boxes about the centre
  std::optional<int> profile_axis;  ///< from 0; without it the last
  int n_slices = 20;                ///< of a profile
  double reach = 5.0;               ///< of g(r), in largest diameters
  std::vector<int> map_size = {32, 32};

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Of spheres: how the volume of their Voronoi cells varies, and the balls in the voids.
struct LocalStructure {
  double mean = 0.0, deviation = 0.0;  ///< of the local solid fraction over the grains
  std::int64_t n_voids = 0;
  double mean_void = 0.0, largest_void = 0.0;  ///< radii
};

/// One row: the structure of a state, or of all together.
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

/// Columns of the pores and of the map of disks; those of spheres are others.
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
  int dimension = 0;                    ///< of the first state
  std::string reference;                ///< file of the first state
  std::optional<double> reference_phi;  ///< its solid fraction
  /// What it would be at other solid fractions, where that is asked for.
  std::variant<std::monostate, AffineReference<2>, AffineReference<3>> affine;
  std::optional<ScatteringAverage> average;
  double diameter = 0.0;  ///< largest, of the first state
  double pore_area = 0.0, pore_second_moment = 0.0;
  StructureRow mean;  ///< sums, until they are divided by the number of states
};

/// The row of one state; `series` takes the rows of the other tables that are asked for. Between walls these are g(r), porosity and profiles.
/// @throws InputError if the state has walls and another table is asked for
template <int Dim>
StructureRow structure_row(const std::string& file, const State<Dim>& state,
                           const StructureTableOptions& options, Series& series, const Remarks& remarks = {});

/// The last row: all states as samples of one.
StructureRow averaged(const std::vector<StructureRow>& rows, const StructureTableOptions& options,
                      Series& series, const Remarks& remarks = {});

}  // namespace floc
