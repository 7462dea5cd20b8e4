#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/contact/law_parameters.h"
#include "floc/io/state_file.h"

namespace floc {

/// What a file of another program may leave unsaid, and the user says.
struct ImportOptions {
  std::optional<LawParameters> law;
  /// Lattice vectors, one a row (length); their number is the dimension.
  std::vector<std::vector<double>> cell;
  /// Column of a csv file for each of our names ("x" -> "X"); a name left out is its own column.
  std::map<std::string, std::string> columns;
  std::string contacts;           ///< csv file of contacts; empty: they follow from the geometry
  int index = 0;                  ///< which packing of a file that holds several
  std::string units = "reduced";  ///< "reduced" or "SI"
};

/// A packing as another program left it.
struct Imported {
  AnyState state;                    ///< without residuals; `provenance.source` is set
  bool contacts_known = false;       ///< the file listed them; otherwise the geometry has to tell
  bool target_stress_known = false;  ///< the file says which stress it was loaded with
};

/// A format that can be read.
struct ImportFormat {
  std::string keyword;
  std::string description;
  /// Whether a file with this name is probably of the format.
  bool (*recognises)(const std::string& path);
  Imported (*read)(const std::string& path, const ImportOptions& options);
};

/// THE list of formats. To add one: a reader in its own file pair, a row here, a round-trip and a
/// malformed-input test.
const std::vector<ImportFormat>& import_formats();

/// The format of `keyword`, or, if that is empty, the one that recognises the file.
/// @throws InputError listing the formats if there is none.
const ImportFormat& find_import_format(const std::string& keyword, const std::string& path);

}  // namespace floc
