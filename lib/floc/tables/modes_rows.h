#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/tables/column.h"
#include "floc/tables/remarks.h"

namespace floc {

/// One row: the number of free motions of a kind, a strain of the cell that costs no energy, or a mode. Free motions
/// follow from the structure of the network alone.
struct ModeRow {
  std::string file;
  std::string kind;
  std::int64_t count = 1;
  std::optional<double> eigenvalue, with_prestress, participation, softens_B, softens_G;
  Eigen::VectorXd coupling;  // volume times stress per unit amplitude; empty: none
  Eigen::VectorXd strain;    // strain of the cell by a mechanism; empty for other rows
  std::vector<std::int64_t> grains;
};

/// Adds the rows of one state: free motions by kind, strains that cost no energy, and its softest modes.
/// @param count  number of modes. Without it, all modes below max |F_N|/r are added, but at least 10 and at most 100
/// @return remarks on its mechanisms and on its modes below max |F_N|/r, for stderr
/// @throws InputError if the state has walls
template <int Dim>
std::vector<std::string> add_modes_rows(const std::string& file, const State<Dim>& state,
                                        std::optional<int> count, std::vector<ModeRow>& rows,
                                        const Remarks& remarks = {});

/// Returns the columns of a table of these rows.
std::vector<Column<ModeRow>> modes_columns(const std::vector<ModeRow>& rows);

}  // namespace floc
