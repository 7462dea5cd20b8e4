#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "floc/packing/contact.h"
#include "floc/packing/contact_order.h"

namespace floc {

/// Strengths of a contact: the largest tension and tangential force (force), and the largest rolling and twisting
/// moment (force * length), that the contact resists without breaking. A strength that is not given is 0.
using Strengths = std::array<double, 4>;

/// Names of the strengths in files and tables.
inline constexpr std::array<const char*, 4> kStrengthNames = {"tensile_strength", "shear_strength",
                                                              "rolling_strength", "twisting_strength"};

/// Strengths of one contact or bond, read from a file of another program. floc stores them with the state, but no
/// contact law of floc uses them.
template <int Dim>
struct BondStrength {
  int i = 0, j = 0;  ///< the two bodies of the contact, as in Contact
  Vec<Dim, int> image = Vec<Dim, int>::Zero();
  Strengths strengths{};
};

/// Returns the strengths of each contact; these are zero for a contact that is not in `strengths`. The result is empty
/// if `strengths` is empty.
/// @param strengths  sorted by precedes()
template <int Dim>
std::vector<Strengths> strengths_by_contact(const std::vector<Contact<Dim>>& contacts,
                                            const std::vector<BondStrength<Dim>>& strengths) {
  std::vector<Strengths> out(strengths.empty() ? 0 : contacts.size());
  for (std::size_t c = 0; c < out.size(); ++c) {
    const BondStrength<Dim> key{contacts[c].i, contacts[c].j, contacts[c].image, {}};
    const auto found = std::lower_bound(strengths.begin(), strengths.end(), key, precedes<BondStrength<Dim>>);
    if (found != strengths.end() && same_pair(*found, key)) out[c] = found->strengths;
  }
  return out;
}

}  // namespace floc
