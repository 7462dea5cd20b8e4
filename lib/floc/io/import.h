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
  /// Column of the grain table for each name used here ("x" -> "X"). A name that is not listed is read from the
  /// column of that name.
  std::map<std::string, std::string> columns;
  std::string contacts;  ///< file of contacts; empty: contacts follow from the geometry
  /// Column of the contact table for each name used here, as in `columns`.
  std::map<std::string, std::string> contact_columns;
  std::optional<int> dimension;  ///< 2 or 3; none: see settle_space()
  std::optional<int> index;      ///< number of the packing in its file, from 0; none: the default of the format
  std::string units = "reduced";  ///< "reduced" or "SI"
  bool drop_tensile = false;      ///< drops tensile contacts under a law without adhesion; else an error
};

/// Numbers of contacts that a file lists, by their treatment.
struct ListedContactCounts {
  int n_read = 0;
  int n_neighbors = 0;    ///< dropped: a gap, no force, and outside the range of the law
  int n_tensile = 0;      ///< dropped: tensile force under a law without adhesion
  int n_other_image = 0;  ///< kept at the nearest image, as the listed one contradicts the positions
  /// Contacts whose listed stiffnesses differ from those that the law gives at the listed forces, in words.
  std::vector<std::string> stiffness_differences;
};

/// A packing as another program left it.
struct Imported {
  AnyState state;                            ///< without residuals; `provenance.source` is set
  std::vector<std::string> remarks;          ///< choices of the reader, in words for the user
  std::vector<std::string> inconsistencies;  ///< choices that may be wrong
  bool complete = false;                     ///< a state of floc, which needs no completion
  bool contacts_known = false;               ///< the file lists contacts; else they follow from the geometry
  bool law_of_contacts = false;              ///< the law has the mean of the stiffnesses of the contacts
  ListedContactCounts listed_contacts;       ///< set if contacts_known
  bool liquid_known = false;                 ///< the file gives the volumes of liquid bridges
  bool target_stress_known = false;          ///< the file gives the imposed stress
};

/// A format that can be read.
struct ImportFormat {
  std::string keyword;
  std::string description;
  /// Whether a file with this name is probably of the format.
  bool (*recognises)(const std::string& path);
  Imported (*read)(const std::string& path, const ImportOptions& options);
};

/// Whether a file can be read and its first bytes, after a byte order mark, are `text`.
bool begins_with(const std::string& path, const std::string& text);

/// All formats that can be read. To add one: a reader in its own pair of files, a row in this list, a round-trip test
/// and a test with malformed input.
const std::vector<ImportFormat>& import_formats();

/// Returns the format with this keyword or, if `keyword` is empty, the format that recognises the file.
/// @throws InputError listing the formats if there is none
const ImportFormat& find_import_format(const std::string& keyword, const std::string& path);

}  // namespace floc
