#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// kn, kt, kr and ktw of a contact, in this order.
using Stiffnesses = std::array<double, 4>;
inline constexpr std::array<const char*, 4> kStiffnessNames = {"kn", "kt", "kr", "ktw"};

/// Stiffnesses of other programs are the law's up to this, relative: files print six digits or more, of a
/// stiffness and of the force that the law finds its own at.
inline constexpr double kForeignStiffness = 1e-5;

template <int Dim>
Stiffnesses stiffnesses(const Contact<Dim>& contact) {
  return {contact.kn, contact.kt, contact.kr, contact.ktw};
}

/// The stiffnesses that the law of a packing gives a contact: at its gap if it is a distant attraction, at its
/// elastic force otherwise. Where the stiffness varies, the force holds it to rounding; an overlap, a small
/// difference of positions, does not.
template <int Dim>
Stiffnesses law_stiffnesses(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Whether two stiffnesses differ by more than a share of the second.
bool differ(double found, double by_law, double tolerance);

/// Compares stiffnesses of contacts with those of their law.
class StiffnessComparison {
 public:
  /// @param names  how messages call the two bodies of the contact
  void add(const Stiffnesses& found, const Stiffnesses& by_law, const std::string& names);

  /// For each of the four whose values differ: of how many contacts, by which factor, and the worst of them.
  /// "kn of 24 contacts is 10 times what the law gives (grains 0-4: 1.2e+07, the law gives 1.2e+06)".
  /// @param force_exponent  of the law: kn = N/delta, two thirds of Hertz's, is named where it is not 1
  std::vector<std::string> differences(double force_exponent) const;

 private:
  struct Kind {
    int n = 0;
    double least = 0.0, largest = 0.0;  ///< factors, of those whose law gives one
    double worst = 0.0;                 ///< the largest relative difference, and the contact it is at:
    double found = 0.0, by_law = 0.0;
    std::string names;
  };
  std::array<Kind, 4> kinds_;
};

/// The differences() of all contacts of a packing, joined; empty if there are none.
template <int Dim>
std::string stiffness_differences(const Packing<Dim>& packing);

}  // namespace floc
