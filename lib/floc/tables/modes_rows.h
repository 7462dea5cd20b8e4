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

/// One row of the table of `floc modes`. It describes one of three things: the number of free motions of one kind; a
/// strain of the cell that costs no energy (a mechanism); or a mode, that is, an eigenvector of the stiffness matrix.
/// Free motions, such as the motions of rattlers, are determined by the structure of the contact network alone.
struct ModeRow {
  std::string file;
  std::string kind;
  std::int64_t count = 1;
  std::optional<double> eigenvalue, with_prestress, participation, softens_B, softens_G;
  /// Stress per unit amplitude of a mode, times the volume of the cell; empty in rows that do not describe a mode.
  Eigen::VectorXd coupling;
  /// Strain of the cell that costs no energy; empty in rows that do not describe such a strain.
  Eigen::VectorXd strain;
  std::vector<std::int64_t> grains;
};

/// Adds the rows of one state to the table of `floc modes`: its free motions by kind, the strains of its cell that cost
/// no energy, and its softest modes.
/// @param count  number of modes to add. If absent, all modes are added whose eigenvalues are below the largest |F_N|/r
/// of a contact (F_N: normal force, r: distance between the centres of the two grains), but at least 10 and at most 100
/// modes
/// @return messages, for stderr, about the mechanisms and about the modes with eigenvalues below the largest |F_N|/r
/// @throws InputError if the state has walls
template <int Dim>
std::vector<std::string> add_modes_rows(const std::string& file, const State<Dim>& state,
                                        std::optional<int> count, std::vector<ModeRow>& rows,
                                        const Remarks& remarks = {});

/// Returns the columns of the table of `floc modes`. The couplings and strains have more columns if any of `rows` is in
/// 3D.
/// @param rows  all rows of the table
std::vector<Column<ModeRow>> modes_columns(const std::vector<ModeRow>& rows);

}  // namespace floc
