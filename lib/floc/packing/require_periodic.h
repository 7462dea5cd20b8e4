#pragma once

#include <string>

#include "floc/base/error.h"
#include "floc/packing/packing.h"

namespace floc {

/// Checks that a packing has no walls.
/// @param what  computation that needs periodic boundaries, as the first part of the sentence "... only with
/// periodic boundaries"
/// @param place  name of the packing in the message, such as its file
/// @throws InputError if the packing has walls
template <int Dim>
void require_periodic(const Packing<Dim>& packing, const std::string& what,
                      const std::string& place = "packing") {
  if (!packing.walls.empty())
    throw InputError(place, "this packing has walls; " + what + " only with periodic boundaries");
}

}  // namespace floc
