#pragma once

#include <string>

#include "floc/base/error.h"
#include "floc/packing/packing.h"

namespace floc {

/// @param what   the computation that works with periodic boundaries only, as a subject
/// @param place  that the message names
/// @throws InputError if the packing has walls
template <int Dim>
void require_periodic(const Packing<Dim>& packing, const std::string& what,
                      const std::string& place = "packing") {
  if (!packing.walls.empty()) throw InputError(place, "has walls; " + what + " only with periodic boundaries");
}

}  // namespace floc
