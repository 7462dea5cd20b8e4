#pragma once

#include <vector>

#include "floc/rigid/step_contact.h"

namespace floc {

/// Order of the contacts of a time step by colours. Contacts of one colour share no body that moves, so the result of
/// solving them does not depend on their order. Only the last of kMostColours colours may contain contacts that share a
/// body: it takes all contacts that fit no other colour.
struct ContactColours {
  std::vector<int> contacts;  ///< indices of the contacts, in the order of their colours
  /// position in `contacts` of the first contact of each colour, then the number of contacts
  std::vector<int> start;

  int n_colours() const { return static_cast<int>(start.size()) - 1; }
};

/// Largest number of colours. The set of the colours used at a body is stored in a number of 64 bits.
inline constexpr int kMostColours = 64;

/// Returns true for each body that an impulse can move along an axis or turn.
template <int Dim>
std::vector<bool> moving_bodies(const BodyMotion<Dim>& bodies);

/// Assigns colours to some contacts of a time step. One after another, each contact takes the smallest colour that no
/// earlier contact of its moving bodies has.
/// @param chosen  indices of the contacts to which colours are assigned
template <int Dim>
ContactColours colour_contacts(const std::vector<bool>& moving, const std::vector<StepContact<Dim>>& contacts,
                               const std::vector<int>& chosen);

}  // namespace floc
