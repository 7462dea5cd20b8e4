#pragma once

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc::test {

/// The same law in other units, by what its numbers are declared to measure.
/// @param length, force  the old units in the new ones
inline LawParameters in_units(LawParameters law, double length, double force) {
  for (const LawNumber& n : numbers_of(law)) {
    switch (n.declared->unit) {
      case Unit::length:
        *n.value *= length;
        break;
      case Unit::force:
        *n.value *= force;
        break;
      case Unit::stiffness:
        *n.value *= force / length;
        break;
      case Unit::rolling_stiffness:
        *n.value *= force * length;
        break;
      case Unit::pressure:
        *n.value *= force / (length * length);
        break;
      case Unit::ratio:
      case Unit::angle:
      case Unit::degrees:
      case Unit::volume:
        break;
    }
  }
  return law;
}

}  // namespace floc::test
