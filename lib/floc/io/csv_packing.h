#pragma once

#include "floc/io/import.h"

namespace floc {

/// Reads a packing from a csv file with one grain per line. The columns are x, y[, z] and radius (or diameter) and,
/// if present, mass (otherwise unit mass at unit diameter) and id (otherwise the number of the grain, counted from
/// 0); `options.columns` renames them. `options.law` and `options.cell` are required.
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). Forces that the file gives are kept
/// unchanged; missing forces follow from the law, and the elongations of the springs follow from the forces.
/// @throws InputError naming file, line and column
Imported read_csv_packing(const std::string& path, const ImportOptions& options);

}  // namespace floc
