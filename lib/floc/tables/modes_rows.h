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

/// One row: motions that are free by structure (a kind and their number), a strain that costs nothing, or a
/// mode.
struct ModeRow {
  std::string file;
  std::string kind;
  std::int64_t count = 1;
  std::optional<double> eigenvalue, with_prestress, participation, softens_B, softens_G;
  Eigen::VectorXd coupling;  // volume times stress per unit amplitude; empty: none
  Eigen::VectorXd strain;    // of a mechanism that strains the cell
  std::vector<std::int64_t> grains;
};

/// Adds the rows of one state: free motions by kind, strains that cost nothing, and its softest modes.
/// @param count  of modes; without it all below max |F_N|/r, no fewer than 10 and no more than 100
/// @return what there is to say of its mechanisms and of its modes below max |F_N|/r
/// @throws InputError if the state has walls
template <int Dim>
std::vector<std::string> add_modes_rows(const std::string& file, const State<Dim>& state,
                                        std::optional<int> count, std::vector<ModeRow>& rows,
                                        const Remarks& remarks = {});

/// The columns of a table of these rows.
std::vector<Column<ModeRow>> modes_columns(const std::vector<ModeRow>& rows);

}  // namespace floc
