#pragma once

#include <string>
#include <vector>

#include "floc/io/table_columns.h"

namespace floc {

/// Solid fractions of the rows of a table, and a description of the quantity from which they were computed.
struct SolidFractions {
  std::vector<double> phi;
  std::string words;  ///< quantity that was read, such as "void ratio in %"
};

/// Returns the names of the quantities from which solid_fractions() computes solid fractions, and the names of the
/// reference values that some of these quantities need. A user may assign columns to these names.
std::vector<std::string> density_names();

/// Reads the solid fractions Phi of a table. They are computed from a column with one of the following quantities: the
/// quantity that the user named or, otherwise, the first quantity of the list that the table contains.
///
///   phi              solid fraction
///   void_ratio       e, void ratio: Phi = 1/(1 + e)
///   porosity         n, porosity: Phi = 1 - n
///   specific_volume  v, volume of the sample divided by the volume of its grains: Phi = 1/v
///   dry_density      rho, mass of the grains per volume of the sample: Phi = rho/particle_density
///   bulk_density     rho, mass of a dry powder per volume of the sample: Phi = rho/particle_density
///   axial_strain     eps, strain along the axis, positive in compression: Phi = 1/[(1 + initial_void_ratio) (1 - eps)]
///   height           H, height of the sample: Phi = H_s/H. The height of the grains H_s is solid_height, or
///                    initial_height/(1 + initial_void_ratio); default of initial_height: the first height in the table
///
/// Numbers whose unit is % are divided by 100. If the table has the columns phi and void_ratio, and the user named
/// neither of them, the two columns have to agree.
/// @param phi_limit  see largest_solid_fraction()
/// @throws InputError naming file, line and value if there is no such column, if a value is not possible, if numbers
/// without the unit % seem to be in percent, if numbers with the unit % seem not to be in percent, or if two columns
/// contradict each other
SolidFractions solid_fractions(const NamedColumns& columns, double phi_limit = 1.0);

/// Returns the largest solid fraction that a row of a table may have: `phi_limit`, but at least 1 and at most 1.5.
/// Solid fractions above 1 occur for powders in a die, because elastic strain makes the grains denser than the solid
/// without load. Numbers above 1.5 are assumed to be in percent.
double largest_solid_fraction(double phi_limit);

/// Returns the factor that converts the numbers in the column `name` (a void ratio or another ratio) to plain ratios:
/// 0.01 if they are in percent, otherwise 1.
/// @throws InputError with a question for the user in two cases: the unit of the column is not %, but the numbers seem
/// to be in percent; or the unit is %, but the numbers are too small for percentages. No error is thrown if the user
/// gave the unit with `--columns "NAME=COLUMN [%]"` or "[1]"
double factor_of_share(const NamedColumns& columns, const std::string& name);

/// Returns the solid fraction that corresponds to a value, which is either a solid fraction or a void ratio.
/// @param place      place of the value in messages
/// @param phi_limit  see largest_solid_fraction()
/// @throws InputError if the value is not possible
double solid_fraction_of(const std::string& place, double value, bool is_void_ratio, double phi_limit = 1.0);

}  // namespace floc
