#pragma once

#include <vector>

#include "floc/rigid/step_contact.h"

namespace floc {

/// Contacts of a time step, sorted by colour. Contacts of one colour share no body that moves, so they can be solved in
/// any order with the same result. The last of kMostColours colours is an exception: it contains all contacts that do
/// not fit into another colour, and these may share a body.
struct ContactColours {
  std::vector<int> contacts;  ///< indices of the contacts, in the order of their colours
  /// for each colour, the position of its first contact in `contacts`; the last element is the number of contacts
  std::vector<int> start;

  int n_colours() const { return static_cast<int>(start.size()) - 1; }
};

/// Largest number of colours. For each body, a number of 64 bits stores which colours its contacts have.
inline constexpr int kMostColours = 64;

/// Returns, for each body, whether impulses can change its velocity or its spin.
template <int Dim>
std::vector<bool> moving_bodies(const BodyMotion<Dim>& bodies);

/// Assigns colours to some contacts of a time step, one contact after the other. Each contact gets the smallest colour
/// that no earlier contact of its moving bodies has.
/// @param chosen  indices of the contacts to which colours are assigned
template <int Dim>
ContactColours colour_contacts(const std::vector<bool>& moving, const std::vector<StepContact<Dim>>& contacts,
                               const std::vector<int>& chosen);

}  // namespace floc
