#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/contact/law.h"

namespace floc::test {

/// Every contact law that there is in a dimension, one model or none in each slot, with these numbers by their
/// keys. Found from the declarations of the models: a new one is among them, and has numbers like those of its kind
/// where none is given.
std::vector<Law> all_laws(int dimension, const std::map<std::string, double>& numbers);

}  // namespace floc::test
