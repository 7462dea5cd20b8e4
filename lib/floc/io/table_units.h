#pragma once

#include <string>
#include <utility>
#include <vector>

namespace floc {

/// Splits a header of a table into name and unit: "sigma' [kPa]" or "sigma' (kPa)". The unit is empty if no brackets
/// end the header, or if they denote a pure number, as in "P [-]" and "P [1]".
std::pair<std::string, std::string> name_and_unit(const std::string& header);

/// Returns the factor that converts a number from `unit` to `wanted`: 1 for the same text, or the ratio of two known
/// units of pressure, of force per length, of force or of length, with SI prefixes.
/// @param place  item that has `unit`, for messages   @param other  item that has `wanted`, for messages
/// @throws InputError if only one of the two units is given, if one is unknown and they differ, or if they measure
/// different quantities
double unit_factor(const std::string& place, const std::string& unit, const std::string& other,
                   const std::string& wanted);

/// Returns the units that unit_factor() accepts, without SI prefixes, for messages and tests.
std::vector<std::string> known_units();

}  // namespace floc
