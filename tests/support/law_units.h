#pragma once

#include "floc/contact/law.h"

namespace floc::test {

/// The same law in other units, by what its numbers are declared to measure.
/// @param length, force  the old units in the new ones
Law in_units(const Law& law, double length, double force);

}  // namespace floc::test
