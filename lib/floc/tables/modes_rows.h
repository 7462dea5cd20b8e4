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

/// One row of `floc modes`: the number of free motions of one kind, a strain of the cell that costs no energy,
/// or a mode of vibration. Free motions follow from the structure of the contact network alone.
struct ModeRow {
  std::string file;
  std::string kind;
  std::int64_t count = 1;
  std::optional<double> eigenvalue, with_prestress, participation, softens_B, softens_G;
  Eigen::VectorXd coupling;  // volume times stress per unit amplitude of the mode; empty for other rows
  Eigen::VectorXd strain;    // strain of the cell by a mechanism; empty for other rows
  std::vector<std::int64_t> grains;
};

/// Adds the rows of one state to the table of `floc modes`: free motions by kind, strains of the cell that cost
/// no energy, and its softest modes.
/// @param count  number of modes. If absent, all modes with eigenvalues below max |F_N|/r (normal force over
/// distance of the grains) are added, but at least 10 and at most 100
/// @return remarks on the mechanisms and on the modes below max |F_N|/r, for stderr
/// @throws InputError if the state has walls
template <int Dim>
std::vector<std::string> add_modes_rows(const std::string& file, const State<Dim>& state,
                                        std::optional<int> count, std::vector<ModeRow>& rows,
                                        const Remarks& remarks = {});

/// Returns the columns of the table of `floc modes` for these rows.
std::vector<Column<ModeRow>> modes_columns(const std::vector<ModeRow>& rows);

}  // namespace floc
