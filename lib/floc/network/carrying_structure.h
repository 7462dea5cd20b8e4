#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Force-carrying structure of a packing (docs/physics.md, "Force-carrying structure"): the interactions that
/// carry a normal force, compressive or tensile, between grains that are not rattlers.
struct CarryingStructure {
  std::vector<bool> rattler;  ///< one entry per grain: whether it is a rattler
  std::vector<int> contacts;  ///< indices of the carrying contacts in the contact list, ascending
  std::vector<int> degree;    ///< one entry per grain: its number of carrying contacts
  int n_rattlers = 0;

  int n_held() const { return static_cast<int>(rattler.size()) - n_rattlers; }
};

/// Returns the fewest contacts that hold a grain: two where some contact carries a tangential force, else Dim +
/// 1, the least number of normal forces that can balance.
template <int Dim>
int least_contacts(const Packing<Dim>& packing);

inline constexpr WholeRange kLeastContacts{.least = 1, .most = 100};

/// Finds the force-carrying structure. Grains with fewer than `least` carrying contacts are removed, and their
/// contacts with them, until no such grain is left. Contacts with walls count. Unlike in find_rattlers(),
/// contacts below `smallest_force` hold no grain.
/// @param smallest_force  |F_N| of a carrying contact exceeds it (force), >= 0
/// @param least           fewest carrying contacts of a grain, in kLeastContacts
/// @throws InputError for other numbers
template <int Dim>
CarryingStructure carrying_structure(const Packing<Dim>& packing, double smallest_force, int least);

/// Returns the network of the carrying contacts alone. Unknowns keep their numbers.
template <int Dim>
ContactNetwork<Dim> carrying_network(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
