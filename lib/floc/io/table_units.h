#pragma once

#include <string>
#include <utility>
#include <vector>

namespace floc {

/// Splits the header of a column of a table, such as "sigma' [kPa]" or "sigma' (kPa)", into name and unit. The unit is
/// empty if the header does not end with brackets, or if the brackets say that the column contains pure numbers, as in
/// "P [-]" and "P [1]".
std::pair<std::string, std::string> name_and_unit(const std::string& header);

/// Returns the factor that converts a number from the unit `unit` to the unit `wanted`. It is 1 if the two texts are
/// equal. Otherwise both have to be known units of pressure, force per length, force or length, with or without SI
/// prefixes.
/// @param place  column (or other data) whose unit is `unit`, for messages
/// @param other  column (or other data) whose unit is `wanted`, for messages
/// @throws InputError if the two texts differ and one is empty or not a known unit, or if the units measure different
/// quantities
double unit_factor(const std::string& place, const std::string& unit, const std::string& other,
                   const std::string& wanted);

/// Returns the units that unit_factor() accepts, without SI prefixes, for messages and tests.
std::vector<std::string> known_units();

}  // namespace floc
