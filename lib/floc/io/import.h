#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/contact/law.h"
#include "floc/io/state_file.h"

namespace floc {

/// What a file of another program may leave out, and the user supplies.
struct ImportOptions {
  std::optional<Law> law;
  /// Lattice vectors, one per row (length); their number is the dimension.
  std::vector<std::vector<double>> cell;
  /// Column of the grains for each of our names ("x" -> "X"); a name left out is its own column.
  std::map<std::string, std::string> columns;
  std::string contacts;  ///< file of contacts; empty: they follow from the geometry
  /// The same as `columns` for the contacts.
  std::map<std::string, std::string> contact_columns;
  std::optional<int> dimension;  ///< 2 or 3; none: see settle_space()
  std::optional<int> index;  ///< which packing of a file that holds several, from 0; none: the format's choice
  std::string units = "reduced";  ///< "reduced" or "SI"
  bool drop_tensile = false;      ///< leaves out contacts that pull under a law without adhesion, else refused
};

/// What became of the contacts that a file lists.
struct ListedContactCounts {
  int n_read = 0;
  int n_neighbors = 0;    ///< left out: they have a gap and no force, and the law attracts nothing there
  int n_tensile = 0;      ///< left out: they pull, and the law has no adhesion
  int n_other_image = 0;  ///< kept, at the nearest image: the one listed contradicts the positions
  /// Where the stiffnesses listed are not those that the law gives at the forces listed, in words.
  std::vector<std::string> stiffness_differences;
};

/// A packing as another program left it.
struct Imported {
  AnyState state;                            ///< without residuals; `provenance.source` is set
  std::vector<std::string> remarks;          ///< choices the reader made, in words for the user
  std::vector<std::string> inconsistencies;  ///< choices that may be wrong
  bool complete = false;                     ///< a state of floc: nothing to add to it
  bool contacts_known = false;               ///< the file listed them; otherwise they follow from the geometry
  bool law_of_contacts = false;  ///< the law has the mean of the stiffnesses that contacts have of their own
  ListedContactCounts listed_contacts;  ///< where contacts_known
  bool liquid_known = false;            ///< the file says which contacts hold how much liquid
  bool target_stress_known = false;     ///< the file says which stress it was loaded with
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

/// THE list of formats. To add one: a reader in its own file pair, a row here, a round-trip and a
/// malformed-input test.
const std::vector<ImportFormat>& import_formats();

/// The format of `keyword`, or, if that is empty, the one that recognises the file.
/// @throws InputError listing the formats if there is none.
const ImportFormat& find_import_format(const std::string& keyword, const std::string& path);

}  // namespace floc
