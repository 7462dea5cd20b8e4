#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc::test {

/// Every contact law that there is in a dimension, one model or none in each slot, with these numbers by their
/// keys. Found from the declarations of the models: a new one is among them, and needs its numbers here.
inline std::vector<LawParameters> all_laws(int dimension, const std::map<std::string, double>& numbers) {
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
  for (LawParameters& law : laws)
    for (const LawNumber& number : numbers_of(law)) *number.value = numbers.at(number.key);
  return laws;
}

}  // namespace floc::test
