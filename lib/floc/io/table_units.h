#pragma once

#include <string>
#include <utility>
#include <vector>

namespace floc {

/// A header of a table in parts: "sigma' [kPa]" or "sigma' (kPa)" -> name and unit. The unit is empty without
/// brackets at the end, and where they say that there is none, as in "P [-]" and "P [1]".
std::pair<std::string, std::string> name_and_unit(const std::string& header);

/// What a number in one unit is multiplied by to be in another: 1 of the same text, the ratio of two known units of
/// pressure, of force per length, of force or of length, SI prefixes included.
/// @param place  what has the unit, for messages   @param other  what has the unit that is wanted
/// @throws InputError where only one of the two is given, where one is unknown and they differ, or where they measure
/// different things
double unit_factor(const std::string& place, const std::string& unit, const std::string& other,
                   const std::string& wanted);

/// Units that unit_factor() knows by name, SI prefixes left out, for messages and tests.
std::vector<std::string> known_units();

}  // namespace floc
