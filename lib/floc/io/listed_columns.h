#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Finds the columns of a table by the names that floc uses, although the table may have other names.
class NamedColumns {
 public:
  /// @param names  maps names of floc to names of columns of the table; a name not in the map is the same in the table
  NamedColumns(const CsvTable& table, std::map<std::string, std::string> names)
      : table_(table), names_(std::move(names)) {}

  const CsvTable& table() const { return table_; }
  const std::map<std::string, std::string>& names() const { return names_; }
  bool has(const std::string& name) const { return names_.contains(name) || table_.has(name); }

  /// Returns the index of a column. @throws InputError listing the columns of the table if this column is missing
  int column(const std::string& name) const {
    return table_.column(names_.contains(name) ? names_.at(name) : name);
  }

 private:
  const CsvTable& table_;
  std::map<std::string, std::string> names_;
};

/// A column that gives the size of grains.
struct SizeColumn {
  const char* name;
  double radius_of_one;  ///< radius of a grain with the value 1 in this column
};

/// Returns the columns of a table that give the size of grains. They are those of the columns radius, r and diameter
/// that the table has or, if `given` has some of these names as keys, only the columns that it names. The first column
/// sets the radius; the others have to agree with it (require_same_size()).
std::vector<SizeColumn> size_columns(const std::function<bool(const std::string&)>& has,
                                     const std::map<std::string, std::string>& given);

/// Checks that two size columns give a grain the same radius.
/// @throws InputError if the radii differ by more than the rounding to six digits, which many files have
void require_same_size(const FileLine& place, const SizeColumn& one, double radius, const SizeColumn& other,
                       double other_radius);

/// Reads grains from a table, one per row. The columns are x, y[, z] and radius (or r, or diameter). Optional columns
/// are x_low, y_low[, z_low] (offsets that are added to x, y, z and are below the precision of a double), mass, and id
/// (default: number of the row, from 0).
/// @throws InputError naming file, line and column: a missing column, a value that is not a number, a radius or mass
/// that is not positive, a radius and a diameter that contradict each other
std::vector<ListedGrain> read_grains(const NamedColumns& columns);

/// Reads contacts from a table, one per row. The columns are id1 and id2, the identifiers of the two grains, and these
/// optional columns. Columns with the numbers 1.. are the components of a vector, as many as the dimension.
///   image1..         numbers of cells by which grain id2 is displaced along the lattice vectors
///   force1..         force on grain id1; the normal force alone if the table also has shear_force1..
///   normal_force     normal force, instead of force1..
///   shear_force1..   tangential force on grain id1, in addition to normal_force or force1..
///   rolling_moment   rolling moment on grain id1 in 2D; in 3D the columns rolling_moment1..3
///   twisting_moment  (3D) twisting moment on grain id1 about the normal from id1 to id2
///   kn, kt, kr, ktw  normal, tangential, rolling and twisting stiffness
///   bridge_volume    volume of the liquid bridge (length^3)
/// @throws InputError naming file, line and column
std::vector<ListedContact> read_contacts(const NamedColumns& columns, int dimension);

/// Check the keys of `given`, a map of column names that the user gave with the option `option`.
/// @throws InputError naming `option` if a key is not the name of a column of grains (of contacts) that floc reads
void check_grain_columns(const std::string& option, const std::map<std::string, std::string>& given);
void check_contact_columns(const std::string& option, const std::map<std::string, std::string>& given);

/// Splits a line at white space.
std::vector<std::string> tokenize(std::string_view line);

}  // namespace floc
