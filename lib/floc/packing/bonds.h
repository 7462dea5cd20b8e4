#pragma once

#include <algorithm>

#include "floc/packing/packing.h"

namespace floc {

/// Returns whether a packing has bonds, contacts that act at any gap (Contact::bonded).
template <int Dim>
bool has_bonds(const Packing<Dim>& packing) {
  return std::ranges::any_of(packing.contacts, [](const Contact<Dim>& c) { return c.bonded; });
}

}  // namespace floc
