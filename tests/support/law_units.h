#pragma once

#include "floc/contact/law.h"

namespace floc::test {

/// Converts a law to other units, according to the declared unit of each of its parameters.
/// @param length, force  old units of length and force, measured in the new units
Law in_units(const Law& law, double length, double force);

}  // namespace floc::test
