#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"
#include "floc/io/table_columns.h"

namespace floc {

/// Returns the element of `names` that equals `name` up to the case of the letters. Returns `name` itself if there is
/// no such element, or if `name` is a single letter.
std::string any_case(const std::string& name, const std::vector<std::string>& names);

/// A column that gives the size of grains: a radius or a diameter.
struct SizeColumn {
  const char* name;
  /// Factor that converts a value in this column to a radius: 1 for radii, 0.5 for diameters.
  double radius_of_one;
};

/// Returns the columns of a table that give the size of grains: radius, r and diameter. If the user renamed some of
/// these columns, only the renamed columns are returned. The first returned column sets the radius; the others must
/// agree with it (require_same_size()).
/// @param has  function that returns whether the table has a column with a given name
/// @param given  names of columns that the user gave; the key is the name that floc uses
std::vector<SizeColumn> size_columns(const std::function<bool(const std::string&)>& has,
                                     const std::map<std::string, std::string>& given);

/// Checks that two columns agree about the size of a grain. According to the column `one`, the radius of the grain is
/// `radius`; according to the column `other`, it is `other_radius`.
/// @param place  place of the grain in messages
/// @throws InputError if the two radii differ by more than the rounding error of six digits
void require_same_size(const FileLine& place, const SizeColumn& one, double radius, const SizeColumn& other,
                       double other_radius);

/// Reads grains from a table, one per row. The columns are x, y[, z] and radius (or r, or diameter). Optional columns
/// are mass and id (default: number of the row, from 0), and x_low, y_low[, z_low]. The numbers x_low, y_low and z_low
/// are added to x, y and z; the sums have more digits than one double. Lengths in columns with a unit, such as "radius
/// [um]", are converted to metres in SI units, else to the unit of the column x. In SI units a mass with a unit must be
/// in kg.
/// @param units  unit system of the packing, "reduced" or "SI"
/// @throws InputError naming file, line and column if a column is missing, a value is not a number, a radius or mass is
/// not positive, a radius and a diameter contradict each other, or units contradict each other
std::vector<ListedGrain> read_grains(const NamedColumns& columns, const std::string& units = "reduced");

/// Reads contacts from a table, one per row. The columns id1 and id2 contain the identifiers of the two grains, or the
/// identifier of a grain and the name of a wall, such as "x-". The columns below are optional. A name that ends in 1..
/// denotes several columns, the components of a vector. For example, image1.. denotes image1, image2 and, in 3D,
/// image3.
///   image1..         displacement of grain id2 along the lattice vectors, in numbers of cells
///   force1..         total force on grain id1; if the table also has shear_force1.., normal force on grain id1
///   normal_force     normal force; replaces force1..
///   shear_force1..   tangential force on grain id1, in addition to normal_force or force1..
///   rolling_moment   rolling moment on grain id1 in 2D; in 3D the columns rolling_moment1..3
///   twisting_moment  (3D) twisting moment on grain id1 about the normal from id1 to id2
///   kn, kt, kr, ktw  normal, tangential, rolling and twisting stiffness
///   bridge_volume    volume of the liquid bridge (length^3)
///   bonded           1 for a bond, which acts at any gap with its own stiffnesses; 0 for other contacts
///   point1..         place of the contact point of grains with corners (length)
///   normal1..        contact normal from id1 to id2 at this point; default: computed from the shapes
///   gap              gap at this point (length); default: computed from the shapes
/// In 2D the third component of a force, normal or image must be zero if the table has it. Units in the headers are not
/// converted. All forces must have the same unit, which must be N in SI units.
/// @param units  unit system of the packing, "reduced" or "SI"
/// @throws InputError naming file, line and column
std::vector<ListedContact> read_contacts(const NamedColumns& columns, int dimension,
                                         const std::string& units = "reduced");

/// Return the names of the columns in a table of grains (grain_names()) or contacts (contact_names()). These names help
/// to find the header of a table.
std::vector<std::string> grain_names();
std::vector<std::string> contact_names();

/// Returns the names of the columns that read_contacts() reads from a table in a given dimension. A scalar `force` is
/// read as the normal force if the table has neither normal_force nor force1...
std::vector<std::string> contact_names_in(const NamedColumns& columns, int dimension);

/// Adds a sentence to `remarks` that names the columns of a table that are not read; adds nothing if all are read.
/// @param names  names of the columns that are read, such as grain_names()
void add_unread_columns(const NamedColumns& columns, const std::vector<std::string>& names,
                        std::vector<std::string>& remarks);

/// Check that the user renamed only columns that floc reads: check_grain_columns() in tables of grains,
/// check_contact_columns() in tables of contacts.
/// @param option  name of the option with which the user renamed columns, for messages
/// @param given  names of columns that the user gave; the key is the name that floc uses
/// @throws InputError naming `option` if a key of `given` is not the name of a column that floc reads
void check_grain_columns(const std::string& option, const std::map<std::string, std::string>& given);
void check_contact_columns(const std::string& option, const std::map<std::string, std::string>& given);

/// Splits a line into its words, which are separated by white space.
std::vector<std::string> tokenize(std::string_view line);

}  // namespace floc
