#pragma once

#include <string>

#include "floc/base/error.h"
#include "floc/packing/packing.h"

namespace floc {

/// Requires a packing without walls.
/// @param what  the computation that needs periodic boundaries, as the subject of a sentence
/// @param place  place of the packing in the message
/// @throws InputError if the packing has walls
template <int Dim>
void require_periodic(const Packing<Dim>& packing, const std::string& what,
                      const std::string& place = "packing") {
  if (!packing.walls.empty()) throw InputError(place, "has walls; " + what + " only with periodic boundaries");
}

}  // namespace floc
