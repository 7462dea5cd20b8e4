#pragma once

#include "floc/io/import.h"

namespace floc {

/// Reads a packing from a csv file with one grain per line: columns x, y[, z] and radius (or diameter), and if
/// present mass (else unit mass at unit diameter) and id (else the grain's line, counted from 0);
/// `options.columns` renames them. `options.law` and `options.cell` are required.
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). Forces that are given are kept as
/// they are; the rest follows from the law, and the springs from the forces.
/// @throws InputError naming file, line and column.
Imported read_csv_packing(const std::string& path, const ImportOptions& options);

}  // namespace floc
