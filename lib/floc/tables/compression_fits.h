#pragma once

#include <string>
#include <vector>

#include "floc/fitting/compression_laws.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"

namespace floc {

/// Options of `floc fit compression`. The members of type string contain keywords of the command.
struct CompressionFitOptions {
  std::string law = "all";             ///< name of a compression law, or "all"
  std::string density = "out-of-die";  ///< "out-of-die", or "in-die" for densities measured under load
  CompressionOptions fit;

  /// Returns the upper bound of solid fractions: infinity for densities measured in a die, otherwise the bound in
  /// `fit`.
  double phi_limit() const;
};

/// Compression laws fitted to the first loading of a load path, sorted by Akaike's criterion, the best law first.
struct CompressedPath {
  Loading loading;
  std::vector<CompressionFit> fits;
};

/// Fits compression laws to the first loading of a load path.
CompressedPath compression_fits(const PathTable& path, const CompressionFitOptions& asked);

/// Returns the name of a compression law.
const char* name_of(CompressionLaw law);

/// Returns the table of `floc fit compression`, with its columns and without rows.
Table compression_table();
/// Adds a row for each parameter of each law to the table of `floc fit compression`.
void add_rows(const PathTable& path, const CompressedPath& compressed, Table& table);
/// Returns a fit as a json object that `floc fit compression --format json` prints.
Json as_json(const PathTable& path, const CompressedPath& compressed, const CompressionFit& fit,
             const CompressionFitOptions& asked);

}  // namespace floc
