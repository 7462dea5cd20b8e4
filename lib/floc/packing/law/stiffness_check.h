#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Normal, tangential, rolling and twisting stiffness of a contact (kn, kt, kr and ktw), in this order.
using Stiffnesses = std::array<double, 4>;
inline constexpr std::array<const char*, 4> kStiffnessNames = {"kn", "kt", "kr", "ktw"};

/// Relative tolerance when stiffnesses from another program are compared with the stiffnesses of the contact
/// law. Files print six digits or more of a stiffness, and of the force from which the law computes its
/// stiffness.
inline constexpr double kForeignStiffness = 1e-5;

template <int Dim>
Stiffnesses stiffnesses(const Contact<Dim>& contact) {
  return {contact.kn, contact.kt, contact.kr, contact.ktw};
}

/// Returns the stiffnesses of a contact by the contact law of the packing: at its gap if it is a distant
/// attraction, at its elastic force otherwise. A stiffness that varies with the load is accurate to rounding if
/// it is computed from the force, but not from the overlap, which is a small difference of positions.
template <int Dim>
Stiffnesses law_stiffnesses(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns whether a stiffness differs from the stiffness by the law by more than `tolerance` times the latter.
bool differ(double found, double by_law, double tolerance);

/// Comparison of the stiffnesses of contacts with the stiffnesses of their contact law.
class StiffnessComparison {
 public:
  /// Adds a contact to the comparison.
  /// @param names  names of its two grains in messages, such as "0-4"
  void add(const Stiffnesses& found, const Stiffnesses& by_law, const std::string& names);

  /// Returns one message for each of the four stiffnesses that differs, with the number of contacts, the factor
  /// and the contact of the largest difference: "kn of 24 contacts is 10 times the value of the contact law
  /// (grains 0-4: 1.2e+07, by the law 1.2e+06)".
  /// @param force_exponent  exponent of the overlap in the elastic force of the law. If it is not 1, messages
  /// name the common mistake that a stiffness kn is the normal force N divided by the overlap delta, which is
  /// two thirds of the stiffness of Hertz contacts.
  std::vector<std::string> differences(double force_exponent) const;

 private:
  struct Kind {
    int n = 0;
    /// Smallest and largest factor found/by_law of all contacts; infinite if by_law is 0.
    double least = 0.0, largest = 0.0;
    double worst = 0.0;  ///< largest relative difference; the members below belong to its contact
    double found = 0.0, by_law = 0.0;
    std::string names;
  };
  std::array<Kind, 4> kinds_;
};

/// Returns messages about the stiffnesses of all contacts of a packing that differ from its contact law; empty
/// if there are none.
template <int Dim>
std::string stiffness_differences(const Packing<Dim>& packing);

}  // namespace floc
