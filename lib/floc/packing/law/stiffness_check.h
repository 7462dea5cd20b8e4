#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// kn, kt, kr and ktw of a contact, in this order.
using Stiffnesses = std::array<double, 4>;
inline constexpr std::array<const char*, 4> kStiffnessNames = {"kn", "kt", "kr", "ktw"};

/// Relative tolerance between stiffnesses of another program and those of the law. Files print six digits or
/// more of a stiffness, and of the force at which the law computes its stiffness.
inline constexpr double kForeignStiffness = 1e-5;

template <int Dim>
Stiffnesses stiffnesses(const Contact<Dim>& contact) {
  return {contact.kn, contact.kt, contact.kr, contact.ktw};
}

/// Stiffnesses of a contact by the law of the packing: at its gap if it is a distant attraction, at its elastic
/// force otherwise. A stiffness that varies with the load is accurate to rounding when computed from the force,
/// but not from the overlap, which is a small difference of positions.
template <int Dim>
Stiffnesses law_stiffnesses(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Whether two stiffnesses differ by more than `tolerance` times the second.
bool differ(double found, double by_law, double tolerance);

/// Comparison of the stiffnesses of contacts with those of their law.
class StiffnessComparison {
 public:
  /// Adds a contact.
  /// @param names  names of its two bodies in messages
  void add(const Stiffnesses& found, const Stiffnesses& by_law, const std::string& names);

  /// Describes each of the four stiffnesses that differs, with the number of contacts, the factor and the worst
  /// contact: "kn of 24 contacts is 10 times what the law gives (grains 0-4: 1.2e+07, the law gives 1.2e+06)".
  /// @param force_exponent  of the law; where it is not 1, messages name the common mistake kn = N/delta, two
  /// thirds of the K_N of Hertz contacts
  std::vector<std::string> differences(double force_exponent) const;

 private:
  struct Kind {
    int n = 0;
    double least = 0.0, largest = 0.0;  ///< factors found/by_law, infinite where by_law is 0
    double worst = 0.0;                 ///< the largest relative difference, and the contact it is at:
    double found = 0.0, by_law = 0.0;
    std::string names;
  };
  std::array<Kind, 4> kinds_;
};

/// Differences of the stiffnesses of all contacts of a packing from its law, in words; empty if there are none.
template <int Dim>
std::string stiffness_differences(const Packing<Dim>& packing);

}  // namespace floc
