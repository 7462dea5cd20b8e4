#pragma once

#include <vector>

#include "floc/rigid/step_contact.h"

namespace floc {

/// Order of the contacts of a time step in which the contacts of one colour follow each other. Contacts of one colour
/// share no body that moves, so that the result of solving them does not depend on their order. The last of
/// kMostColours colours is an exception: it takes all contacts that no other colour can take.
struct ContactColours {
  std::vector<int> contacts;  ///< contacts in the order of their colours
  std::vector<int>
      start;  ///< number of the first contact of each colour in that order, and the number of contacts

  int n_colours() const { return static_cast<int>(start.size()) - 1; }
};

/// Largest number of colours. A set of colours is a number of 64 bits.
inline constexpr int kMostColours = 64;

/// Returns true for each body that an impulse can move along an axis or turn.
template <int Dim>
std::vector<bool> moving_bodies(const BodyMotion<Dim>& bodies);

/// Colours some contacts of a time step: in their order, each takes the smallest colour that no earlier contact of its
/// moving bodies has.
/// @param chosen  numbers of the contacts to colour
template <int Dim>
ContactColours colour_contacts(const std::vector<bool>& moving, const std::vector<StepContact<Dim>>& contacts,
                               const std::vector<int>& chosen);

}  // namespace floc
