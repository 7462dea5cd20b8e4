#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace floc {

/// Splits the header of a column of a table into name and unit. The unit is either in brackets, as in "sigma' [kPa]"
/// and "sigma' (kPa)", or a known unit after the name, as in "sigma', kPa", "sigma' in kPa", "sigma'/kPa", "sigma' kPa"
/// and "sigma_kPa". After a blank or an underscore, units such as "bar" and "N" are not recognised, because they may be
/// part of the name. The unit is empty if the header has none, or if brackets mark pure numbers, as in "P [-]" and "P
/// [1]". A text in round brackets that is not a known unit is part of the name.
std::pair<std::string, std::string> name_and_unit(const std::string& header);

/// Returns the unit in a cell of a row of units, such as "kPa" or "[kPa]". A unit is a known unit, or any text in
/// brackets. Returns an empty text if the cell contains no unit.
std::string unit_in_cell(std::string_view cell);

/// Whether a cell of a row of units is "-", "[-]" or "[1]": the numbers of the column are then pure numbers.
bool states_no_unit(std::string_view unit);

/// Returns the quantity that a unit measures, such as "pressure", "length" or "density". The quantity of percent is
/// "share". Returns an empty text if the unit is unknown.
std::string quantity_of_unit(const std::string& unit);

/// Returns the factor that converts a ratio with the unit `unit`, such as %, to a plain ratio. The factor is 1 if the
/// unit is empty.
/// @param place  column whose unit is `unit`, for messages
/// @throws InputError if the unit is not a unit of ratios
double share_of_one(const std::string& place, const std::string& unit);

/// Returns the factor that converts a number from the unit `unit` to the unit `wanted`. If the two texts are equal, the
/// factor is 1. If not, both must be known units of the same quantity (pressure, force per length, force, length or
/// density), with or without SI prefixes.
/// @param place  column (or other data) whose unit is `unit`, for messages
/// @param other  column (or other data) whose unit is `wanted`, for messages
/// @throws InputError if the two texts differ and one is empty or not a known unit, or if the units measure different
/// quantities
double unit_factor(const std::string& place, const std::string& unit, const std::string& other,
                   const std::string& wanted);

/// Returns the units (without SI prefixes) that unit_factor() accepts; for messages and tests.
std::vector<std::string> known_units();

}  // namespace floc
