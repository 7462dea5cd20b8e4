#pragma once

#include "floc/io/import.h"

namespace floc {

/// Reads a packing from a csv file with one grain per line. The columns x, y[, z] and radius (or diameter) are
/// required; the columns mass (default: diameter^2 in 2D, diameter^3 in 3D) and id (default: position of the grain in
/// the file, counted from 0) are optional. `options.columns` renames the columns. `options.law` and `options.cell` are
/// required.
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). Forces in that file are kept unchanged.
/// Missing forces are computed by the contact law. The elongations of the contact springs are computed from the forces.
/// @throws InputError naming file, line and column
Imported read_csv_packing(const std::string& path, const ImportOptions& options);

}  // namespace floc
