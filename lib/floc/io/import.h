#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/contact/law.h"
#include "floc/io/state_file.h"

namespace floc {

/// Options for reading a file of another program: data that the file may lack and the user supplies.
struct ImportOptions {
  std::optional<Law> law;
  /// Lattice vectors, one per row (length); their number is the dimension.
  std::vector<std::vector<double>> cell;
  /// Maps the names that floc uses for columns of grains to the names in the file ("x" -> "X"). Columns that are not in
  /// this map have the same name in the file.
  std::map<std::string, std::string> columns;
  std::string contacts;  ///< file of contacts; empty: contacts are found from the geometry
  /// Maps the names that floc uses for columns of contacts to the names in the file, like `columns`.
  std::map<std::string, std::string> contact_columns;
  std::optional<int> dimension;  ///< 2 or 3; if absent, settle_space() decides
  /// Number of the packing in its file, from 0; if absent, the default of the format.
  std::optional<int> index;
  std::string units = "reduced";  ///< "reduced" or "SI"
  /// If the law has no adhesion, tensile contacts are dropped (true) or an error (false).
  bool drop_tensile = false;
};

/// Counts of the contacts that a file lists, by their treatment.
struct ListedContactCounts {
  int n_read = 0;
  int n_neighbors = 0;    ///< dropped, because they have no force and a gap beyond the range of the law
  int n_tensile = 0;      ///< dropped, because they have a tensile force and the law has no adhesion
  int n_other_image = 0;  ///< kept with the nearest image, because the listed image contradicts the positions
  /// Sentences about contacts whose listed stiffnesses differ from the stiffnesses of the law at the listed forces.
  std::vector<std::string> stiffness_differences;
};

/// Packing that was read from a file of another program.
struct Imported {
  AnyState state;  ///< state of the packing, without residuals; `provenance.source` is the file
  std::vector<std::string> remarks;          ///< sentences for the user about choices of the reader
  std::vector<std::string> inconsistencies;  ///< sentences for the user about choices that may be wrong
  bool complete = false;         ///< whether the file is a state of floc, to which nothing has to be added
  bool contacts_known = false;   ///< whether the file lists contacts; if not, they are found from the geometry
  bool law_of_contacts = false;  ///< whether the stiffnesses of the law are the means over the listed contacts
  ListedContactCounts listed_contacts;  ///< set if contacts_known
  bool liquid_known = false;            ///< whether the file gives the volumes of liquid bridges
  bool target_stress_known = false;     ///< whether the file gives the imposed stress
};

/// A format that can be read.
struct ImportFormat {
  std::string keyword;
  std::string description;
  /// Whether the file `path` probably has this format.
  bool (*recognises)(const std::string& path);
  Imported (*read)(const std::string& path, const ImportOptions& options);
};

/// Whether the content of a file begins with `text`, after a byte order mark if there is one.
bool begins_with(const std::string& path, const std::string& text);

/// All formats that can be read. To add a format, add a reader in a source and a header file of its own, an entry in
/// this list, a test that reads back a written file, and a test with malformed input.
const std::vector<ImportFormat>& import_formats();

/// Returns the format with this keyword or, if `keyword` is empty, the format that recognises the file.
/// @throws InputError listing all formats if no format matches
const ImportFormat& find_import_format(const std::string& keyword, const std::string& path);

}  // namespace floc
