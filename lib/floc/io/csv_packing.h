#pragma once

#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Reads a packing from a csv file with one grain a line: columns x, y[, z] and radius (or diameter), and if
/// present mass (else unit mass at unit diameter) and id (else the grain's line, counted from 0);
/// `options.columns` renames them. `options.law` and `options.cell` are required.
///
/// `options.contacts` may name a csv file with one contact a line, with the columns of read_contacts();
/// `options.contact_columns` renames them. Forces that are given are kept as they are, the rest follows from
/// the law; springs follow from the forces.
/// @throws InputError naming file, line and column.
Imported read_csv_packing(const std::string& path, const ImportOptions& options);

/// Contacts of the csv file `options.contacts`; nothing if none is named.
std::optional<std::vector<ListedContact>> read_csv_contacts(const ImportOptions& options, int dimension);

}  // namespace floc
