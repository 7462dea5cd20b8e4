#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/contact/law.h"

namespace floc::test {

/// Returns every contact law of a dimension, with one model or none in each slot. The list follows from the
/// declarations of the models, so it includes new ones. @param numbers  values by key; a number that is not
/// given gets a value from another one of its unit
std::vector<Law> all_laws(int dimension, const std::map<std::string, double>& numbers);

}  // namespace floc::test
