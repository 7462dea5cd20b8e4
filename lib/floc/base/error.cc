#include "floc/base/error.h"

namespace floc {

InputError::InputError(const std::string& place, const std::string& problem)
    : std::runtime_error(place.empty() ? problem : place + ": " + problem) {}

IoError::IoError(const std::string& place, const std::string& problem)
    : std::runtime_error(place + ": " + problem) {}

}  // namespace floc
