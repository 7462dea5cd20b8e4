#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/listed_packing.h"
#include "floc/io/table_columns.h"

namespace floc {

/// Returns the name among `names` that is `name` but for capital letters; `name` itself if there is none, or if it is a
/// single letter.
std::string any_case(const std::string& name, const std::vector<std::string>& names);

/// A column that gives the size of grains: a radius or a diameter.
struct SizeColumn {
  const char* name;
  /// Radius of a grain for which this column contains 1, so 1 for radii and 0.5 for diameters.
  double radius_of_one;
};

/// Returns the columns of a table that give the size of grains: those of the columns radius, r and diameter that the
/// table has or, if the user renamed some of these, only the renamed columns. The first column sets the radius; the
/// others have to agree with it (require_same_size()).
/// @param has  function that returns whether the table has a column with a given name
/// @param given  map from names that floc uses to names of columns, given by the user
std::vector<SizeColumn> size_columns(const std::function<bool(const std::string&)>& has,
                                     const std::map<std::string, std::string>& given);

/// Checks that two columns, `one` and `other`, give the same radius for a grain, `radius` and `other_radius`.
/// @param place  place of the grain in messages
/// @throws InputError if the two radii differ by more than rounding to six digits, which many files have
void require_same_size(const FileLine& place, const SizeColumn& one, double radius, const SizeColumn& other,
                       double other_radius);

/// Reads grains from a table, one per row. The columns are x, y[, z] and radius (or r, or diameter). Optional columns
/// are mass, id (default: number of the row, from 0) and x_low, y_low[, z_low], small numbers that are added to x, y, z
/// to give the position with more digits than one double has.
/// Lengths whose columns have units, as in "radius [um]", are converted to the unit of the column x or, in SI units, to
/// metres. In SI units a mass with a unit has to be in kg.
/// @param units  unit system of the packing, "reduced" or "SI"
/// @throws InputError naming file, line and column for a missing column, a value that is not a number, a radius or mass
/// that is not positive, a radius and a diameter that contradict each other, or units that contradict each other
std::vector<ListedGrain> read_grains(const NamedColumns& columns, const std::string& units = "reduced");

/// Reads contacts from a table, one per row. The columns id1 and id2 are the identifiers of the two grains, or of a grain
/// and the name of a wall, such as "x-". The columns
/// below are optional. Names that end in 1.. are those of several columns, the components of a vector: image1, image2
/// and, in 3D, image3.
///   image1..         numbers of cells by which grain id2 is displaced along the lattice vectors
///   force1..         force on grain id1; the normal force alone if the table also has shear_force1..
///   normal_force     normal force, instead of force1..
///   shear_force1..   tangential force on grain id1, in addition to normal_force or force1..
///   rolling_moment   rolling moment on grain id1 in 2D; in 3D the columns rolling_moment1..3
///   twisting_moment  (3D) twisting moment on grain id1 about the normal from id1 to id2
///   kn, kt, kr, ktw  normal, tangential, rolling and twisting stiffness
///   bridge_volume    volume of the liquid bridge (length^3)
///   point1..         place of the contact point of grains with corners (length)
///   normal1..        contact normal from id1 to id2 at this point; without it that of the shapes
///   gap              gap at this point (length); without it that of the shapes
/// Units in the headers are not converted: all forces have to be in one unit, in SI units in N.
/// @param units  unit system of the packing, "reduced" or "SI"
/// @throws InputError naming file, line and column
std::vector<ListedContact> read_contacts(const NamedColumns& columns, int dimension,
                                         const std::string& units = "reduced");

/// Names of the columns that every table of grains and every table of contacts has, which help to find its header.
std::vector<std::string> grain_names();
std::vector<std::string> contact_names();

/// Check that the user renamed only columns that floc reads: columns of grains or, in the second function, of contacts.
/// @param option  name of the option with which the user renamed columns, for messages
/// @param given  map from names that floc uses to names of columns, as the user gave it
/// @throws InputError naming `option` if a key of `given` is not the name of such a column
void check_grain_columns(const std::string& option, const std::map<std::string, std::string>& given);
void check_contact_columns(const std::string& option, const std::map<std::string, std::string>& given);

/// Splits a line into its words, which are separated by white space.
std::vector<std::string> tokenize(std::string_view line);

}  // namespace floc
