#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// The force-carrying structure of a packing (docs/physics.md, "Force-carrying structure"): the interactions
/// that carry a normal force, pull or push, between grains that are held.
struct CarryingStructure {
  std::vector<bool> rattler;  ///< one entry per grain: whether it is not held
  std::vector<int> contacts;  ///< indices in the contact list, ascending
  std::vector<int> degree;    ///< one entry per grain: how many of these contacts it has
  int n_rattlers = 0;

  int n_held() const { return static_cast<int>(rattler.size()) - n_rattlers; }
};

/// Fewest contacts that hold a grain: two where some contact carries a tangential force, else Dim + 1, the
/// number that forces along the normals take to balance.
template <int Dim>
int least_contacts(const Packing<Dim>& packing);

inline constexpr WholeRange kLeastContacts{.least = 1, .most = 100};

/// Grains with fewer than `least` carrying contacts are removed, and their contacts with them, until no such
/// grain is left. Contacts with walls hold their grains like others. Unlike in find_rattlers(), contacts below
/// `smallest_force` hold nothing.
/// @param smallest_force  |F_N| of a carrying contact exceeds it (force), >= 0   @param least  in kLeastContacts
/// @throws InputError for other numbers
template <int Dim>
CarryingStructure carrying_structure(const Packing<Dim>& packing, double smallest_force, int least);

/// The network of these contacts alone. Unknowns keep their numbers.
template <int Dim>
ContactNetwork<Dim> carrying_network(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
