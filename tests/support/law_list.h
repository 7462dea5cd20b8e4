#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc::test {

/// For a number of a model that came later. A second stiffness is larger than the first, as unloading has it.
inline double number_like(Unit unit, const std::map<std::string, double>& numbers) {
  switch (unit) {
    case Unit::stiffness:
      return 1.5 * numbers.at("normal.stiffness");
    case Unit::force:
      return numbers.at("adhesion.force");
    case Unit::length:
      return numbers.at("adhesion.range");
    case Unit::pressure:
      return numbers.at("normal.modulus");
    case Unit::rolling_stiffness:
      return numbers.at("rolling.stiffness");
    default:
      return 0.3;
  }
}

/// Every contact law that there is in a dimension, one model or none in each slot, with these numbers by their
/// keys. Found from the declarations of the models: a new one is among them, and has numbers like those of its kind
/// where none is given.
inline std::vector<Law> all_laws(int dimension, const std::map<std::string, double>& numbers) {
  std::vector<LawParameters> laws = {{}};
  for (const DeclaredSlot& slot : declared_slots()) {
    std::vector<LawParameters> longer;
    for (const LawParameters& law : laws) {
      if (slot.optional) longer.push_back(law);
      for (const DeclaredModel& model : slot.models) {
        longer.push_back(law);
        model.choose(longer.back());
      }
    }
    laws = std::move(longer);
  }
  std::erase_if(laws, [&](const LawParameters& law) {
    return !law.faults_between_slots().empty() || !law.faults_in_dimension(dimension).empty();
  });
  std::vector<Law> filled;
  for (LawParameters& law : laws) {
    for (const LawNumber& n : numbers_of(law))
      *n.value = numbers.count(n.key) > 0 ? numbers.at(n.key) : number_like(n.declared->unit, numbers);
    filled.emplace_back(law);
  }
  return filled;
}

}  // namespace floc::test
