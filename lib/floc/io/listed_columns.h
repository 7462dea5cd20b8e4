#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// A table whose columns are found by our names.
class NamedColumns {
 public:
  /// @param names  column of the table for each of our names; a name left out is its own column
  NamedColumns(const CsvTable& table, std::map<std::string, std::string> names)
      : table_(table), names_(std::move(names)) {}

  const CsvTable& table() const { return table_; }
  const std::map<std::string, std::string>& names() const { return names_; }
  bool has(const std::string& name) const { return names_.contains(name) || table_.has(name); }

  /// @throws InputError listing the columns there are.
  int column(const std::string& name) const {
    return table_.column(names_.contains(name) ? names_.at(name) : name);
  }

 private:
  const CsvTable& table_;
  std::map<std::string, std::string> names_;
};

/// A column that says how large grains are.
struct SizeColumn {
  const char* name;
  double radius_of_one;  ///< radius of a grain of which it says 1
};

/// Those of radius, r and diameter that there are, or of these the ones that `given` names, if it names any. Of
/// several, the first counts; the others may not contradict it.
std::vector<SizeColumn> size_columns(const std::function<bool(const std::string&)>& has,
                                     const std::map<std::string, std::string>& given);

/// @throws InputError unless two columns say the same of a grain, to the digits that files print
void require_same_size(const FileLine& place, const SizeColumn& one, double radius, const SizeColumn& other,
                       double other_radius);

/// Grains of a table with columns x, y[, z] and radius (or r, or diameter) and, if present, x_low, y_low[,
/// z_low] (offsets of the centres from those doubles), mass and id (else the row, counted from 0).
/// @throws InputError naming file, line and column: a missing column, a value that is not a number, a radius or
/// mass that is not positive, a radius and a diameter that contradict each other.
std::vector<ListedGrain> read_grains(const NamedColumns& columns);

/// Contacts of a table with columns id1, id2 and, if present,
///   image1..      cells by which id2 is displaced; with `dimension` components like everything numbered here
///   force1..      force on id1; if shear_force1.. is there too, the normal part alone
///   normal_force, shear_force1..  instead of it, or the tangential force on id1 besides force1..
///   rolling_moment (2D) or rolling_moment1..3, on id1
///   twisting_moment (3D), on id1 about the normal from id1 to id2
///   kn, kt, kr, ktw  stiffnesses
///   bridge_volume of the liquid at it
/// @throws InputError naming file, line and column.
std::vector<ListedContact> read_contacts(const NamedColumns& columns, int dimension);

/// @throws InputError naming `option` if a key of `given` is not a column of a grain, or of a contact.
void check_grain_columns(const std::string& option, const std::map<std::string, std::string>& given);
void check_contact_columns(const std::string& option, const std::map<std::string, std::string>& given);

/// Splits a line at white space.
std::vector<std::string> tokenize(std::string_view line);

}  // namespace floc
