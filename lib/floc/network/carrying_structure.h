#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Force-carrying structure of a packing (docs/physics.md, "Force-carrying structure"): the grains that are not
/// rattlers, and all their contacts and attractions with a compressive or tensile normal force. Contacts with rattlers
/// are not part of the structure.
struct CarryingStructure {
  std::vector<bool> rattler;  ///< for each grain, whether it is a rattler
  std::vector<int> contacts;  ///< indices of the carrying contacts in Packing::contacts, ascending
  std::vector<int> degree;    ///< for each grain, the number of its carrying contacts
  int n_rattlers = 0;

  int n_held() const { return static_cast<int>(rattler.size()) - n_rattlers; }
};

/// Returns the smallest number of contacts that keep a grain in equilibrium: two if any contact of the packing carries
/// a tangential force, otherwise Dim + 1. Without tangential forces, fewer than Dim + 1 normal forces are in balance
/// only for special directions.
template <int Dim>
int least_contacts(const Packing<Dim>& packing);

/// Allowed values of `least` in carrying_structure(): the smallest number of carrying contacts of a grain.
inline constexpr WholeRange kLeastContacts{.least = 1, .most = 100};

/// Finds the force-carrying structure of a packing. Only contacts whose normal force exceeds `smallest_force` in
/// magnitude are counted, including contacts with walls. Grains with fewer than `least` such contacts are rattlers.
/// Rattlers are removed together with their contacts, and the search is repeated until it finds no further rattler. The
/// rattlers may differ from those of find_rattlers(), which also counts contacts with smaller forces.
/// @param smallest_force  a contact is force-carrying if the magnitude of its normal force is above this value (force),
/// >= 0
/// @param least  smallest number of carrying contacts of a grain that is not a rattler, in the range kLeastContacts
/// @throws InputError if a parameter is out of range
template <int Dim>
CarryingStructure carrying_structure(const Packing<Dim>& packing, double smallest_force, int least);

/// Returns the contact network that consists of the carrying contacts alone. The unknowns of the grains have the same
/// numbers as in the network of all contacts.
template <int Dim>
ContactNetwork<Dim> carrying_network(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
