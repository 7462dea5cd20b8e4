#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Force-carrying structure of a packing (docs/physics.md, "Force-carrying structure"): the contacts and attractions
/// that carry a normal force, compressive or tensile, between grains that are not rattlers.
struct CarryingStructure {
  std::vector<bool> rattler;  ///< one entry per grain: whether it is a rattler
  std::vector<int> contacts;  ///< indices of the carrying contacts in Packing::contacts, ascending
  std::vector<int> degree;    ///< one entry per grain: its number of carrying contacts
  int n_rattlers = 0;

  int n_held() const { return static_cast<int>(rattler.size()) - n_rattlers; }
};

/// Returns the least number of contacts that can hold a grain in equilibrium: two if some contact carries a tangential
/// force, otherwise Dim + 1, the least number of normal forces that can balance.
template <int Dim>
int least_contacts(const Packing<Dim>& packing);

/// Allowed range of the least number of carrying contacts of a grain.
inline constexpr WholeRange kLeastContacts{.least = 1, .most = 100};

/// Finds the force-carrying structure of a packing. Grains with fewer than `least` carrying contacts are removed
/// together with their contacts, until no such grain is left. Contacts with walls count. Unlike in find_rattlers(),
/// contacts that carry `smallest_force` or less do not hold a grain.
/// @param smallest_force  normal force that |F_N| of a carrying contact must exceed (force), >= 0
/// @param least           least number of carrying contacts of a grain, in kLeastContacts
/// @throws InputError if a parameter is out of range
template <int Dim>
CarryingStructure carrying_structure(const Packing<Dim>& packing, double smallest_force, int least);

/// Returns the contact network of the carrying contacts alone. The unknowns keep their numbers.
template <int Dim>
ContactNetwork<Dim> carrying_network(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
