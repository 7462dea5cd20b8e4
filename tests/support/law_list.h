#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/contact/law.h"

namespace floc::test {

/// Returns every contact law of a dimension, with one model or none in each slot. The list is made from the
/// declarations of the models, so it includes new models.
/// @param numbers  values of parameters by key; a parameter that is not listed gets a value that follows from its unit
std::vector<Law> all_laws(int dimension, const std::map<std::string, double>& numbers);

}  // namespace floc::test
