#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/contact/law.h"
#include "floc/io/listed_space.h"
#include "floc/io/state_file.h"

namespace floc {

/// Options for reading a file of another program. The options give data that may be missing in the file.
struct ImportOptions {
  std::optional<Law> law;
  /// Lattice vectors of the periodic cell (length), one per row. The number of vectors is the dimension. If empty, the
  /// file gives the cell.
  std::vector<std::vector<double>> cell;
  std::optional<Law> wall_law;  ///< contact law between grains and walls; if absent, `law` applies to them
  /// Axes that are not periodic (see parse_walls()) and names of files that describe walls (see read_wall_file()),
  /// separated by commas. If empty, the file of the packing gives the boundary.
  std::string walls;
  /// Masses of the walls that forces move. A wall that is not in this list stays where it is.
  std::vector<std::pair<WallSide, double>> wall_masses;
  /// acceleration due to gravity, one component per axis; if empty, the file gives it
  std::vector<double> gravity;
  /// walls among the bodies in the file of contacts: the key is the identifier of the body, the value is the wall
  std::map<std::int64_t, WallSide> wall_ids;
  /// Maps a name that floc uses for a column of grains to the name of this column in the file, such as "x" to "X". A
  /// column that is not in this map has the name that floc uses. For a LAMMPS dump, the name of a wall such as "x-" is
  /// mapped to the columns with the forces of this wall: see read_lammps_dump().
  std::map<std::string, std::string> columns;
  /// Path of a file that lists the contacts. If empty, contacts are found from the positions and radii.
  std::string contacts;
  /// Path of a file that lists bonds. A bond is a contact that acts across gaps and has its own stiffnesses. If empty,
  /// the packing has no bonds.
  std::string bonds;
  /// Names of the columns in the file `contacts`: the key is the name that floc uses, the value is the name in the
  /// file. A column that is not in this map has the name that floc uses.
  std::map<std::string, std::string> contact_columns;
  std::optional<int> dimension;  ///< dimension, 2 or 3; if absent, settle_space() decides
  /// Number (from 0) of the packing or frame that is read if the file has several. If absent, the format determines
  /// whether the first or the last packing is read.
  std::optional<int> index;
  std::string units = "reduced";  ///< unit system of the file, "reduced" or "SI"
  /// Whether contacts with a tensile force are left out if the law has no adhesion. If false, such a contact is an
  /// error.
  bool drop_tensile = false;
  /// Largest gap (length) of grains that count as touching, if contacts are found from the geometry. The force across a
  /// gap is zero.
  double touch_gap = 0.0;
  /// whether the file of contacts lists each pair of grains twice, once for each of the two grains: see merge_pairs()
  bool pairs_twice = false;
};

/// Counts of the contacts in a file: the number of all contacts, the numbers of contacts that are left out for
/// different reasons, and the numbers of contacts that are kept but need a remark.
struct ListedContactCounts {
  int n_read = 0;
  /// Number of contacts that were left out because they have no force and the gap between the grains exceeds the range
  /// of the law.
  int n_neighbors = 0;
  /// Number of contacts that were left out because they have a tensile force and the law has no adhesion.
  int n_tensile = 0;
  /// Number of contacts whose listed image contradicts the positions. These contacts were kept, with the nearest
  /// periodic image of grain id2.
  int n_other_image = 0;
  /// Number of contacts across a boundary at which grains are rotated when they cross it. No lattice translation brings
  /// the two grains of such a contact together. These contacts keep the listed forces and have no stiffness.
  int n_across_no_lattice = 0;
  int n_bonds = 0;  ///< number of contacts that act across a gap, each with its own stiffnesses
  /// Sentences about listed stiffnesses that differ from the stiffnesses that the contact law gives at the listed
  /// forces.
  std::vector<std::string> stiffness_differences;
  /// Sentence about contact points of grains with corners that do not fit the shapes; empty if all points fit.
  std::string misfit;
};

/// A packing that was read from a file of another program.
struct Imported {
  /// State of the packing; its residuals are not computed yet, and `provenance.source` is the path of the file.
  AnyState state;
  /// Sentences for the user about how the file was interpreted.
  std::vector<std::string> remarks;
  /// Sentences for the user about data that seem wrong or that contradict other data.
  std::vector<std::string> inconsistencies;
  /// Whether the file is a state file of floc, in which no data are missing.
  bool complete = false;
  /// Whether the file lists contacts. If not, contacts are found from the positions and radii.
  bool contacts_known = false;
  /// Whether the packing has walls, but the file lists no contacts with them. If true, these contacts are found from
  /// the geometry.
  bool lacks_wall_contacts = false;
  /// Whether the stiffnesses of the contact law were computed as means of the listed stiffnesses.
  bool law_of_contacts = false;
  ListedContactCounts listed_contacts;  ///< counts of the listed contacts; set only if contacts_known is true
  /// Whether the file gives the volumes of the liquid bridges.
  bool liquid_known = false;
  bool target_stress_known = false;  ///< whether the file gives the imposed stress
};

/// A file format from which floc can read a packing.
struct ImportFormat {
  std::string keyword;
  std::string description;
  /// Whether the file `path` probably has this format.
  bool (*recognises)(const std::string& path);
  Imported (*read)(const std::string& path, const ImportOptions& options);
};

/// Whether the content of the file `path` begins with `text`, possibly after a byte order mark. The file may be in any
/// encoding that decoded_table() recognises.
bool begins_with(const std::string& path, const std::string& text);

/// All file formats from which floc can read a packing. To add a format, add a reader with its own source and header
/// file, an entry in this list, a test that reads back a written file, and a test with malformed input.
const std::vector<ImportFormat>& import_formats();

/// Returns the format with the keyword `keyword`. If `keyword` is empty, returns the format that recognises the file
/// `path`. Standard input ("-") is recognised by its content; if no format recognises it, it is read as csv.
/// @throws InputError listing all formats if no format matches
const ImportFormat& find_import_format(const std::string& keyword, const std::string& path);

}  // namespace floc
