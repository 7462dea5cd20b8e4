#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// A table whose columns are found by the names that floc uses.
class NamedColumns {
 public:
  /// @param names  column of the table for each name used here; a name that is not listed is its own column
  NamedColumns(const CsvTable& table, std::map<std::string, std::string> names)
      : table_(table), names_(std::move(names)) {}

  const CsvTable& table() const { return table_; }
  const std::map<std::string, std::string>& names() const { return names_; }
  bool has(const std::string& name) const { return names_.contains(name) || table_.has(name); }

  /// Returns the index of a column. @throws InputError listing the columns of the table if it is missing
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

/// Returns the size columns of a table, out of radius, r and diameter: those that exist or, if `given` names some of
/// the three, only these. The first one sets the radius; the others must agree with it (require_same_size()).
std::vector<SizeColumn> size_columns(const std::function<bool(const std::string&)>& has,
                                     const std::map<std::string, std::string>& given);

/// Checks that two size columns give a grain the same radius.
/// @throws InputError if they differ beyond the digits that files print
void require_same_size(const FileLine& place, const SizeColumn& one, double radius, const SizeColumn& other,
                       double other_radius);

/// Reads the grains of a table with columns x, y[, z] and radius (or r, or diameter) and, if present, x_low, y_low[,
/// z_low] (offsets of the centres from the rounded doubles), mass and id (otherwise the row, counted from 0).
/// @throws InputError naming file, line and column: a missing column, a value that is not a number, a radius or mass
/// that is not positive, a radius and a diameter that contradict each other
std::vector<ListedGrain> read_grains(const NamedColumns& columns);

/// Reads the contacts of a table with columns id1, id2 and, if present,
///   image1..      numbers of cells by which id2 is displaced; numbered columns have `dimension` components
///   force1..      force on id1; the normal part alone if the table also has shear_force1..
///   normal_force  normal force, in place of force1..
///   shear_force1..  tangential force on id1, besides normal_force or force1..
///   rolling_moment (2D) or rolling_moment1..3, on id1
///   twisting_moment (3D), on id1 about the normal from id1 to id2
///   kn, kt, kr, ktw  stiffnesses
///   bridge_volume    volume of the liquid bridge (length^3)
/// @throws InputError naming file, line and column
std::vector<ListedContact> read_contacts(const NamedColumns& columns, int dimension);

/// Checks names of columns. @throws InputError naming `option` if a key of `given` is not a column of grains, or of
/// contacts
void check_grain_columns(const std::string& option, const std::map<std::string, std::string>& given);
void check_contact_columns(const std::string& option, const std::map<std::string, std::string>& given);

/// Splits a line at white space.
std::vector<std::string> tokenize(std::string_view line);

}  // namespace floc
