#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Normal, tangential, rolling and twisting stiffness of a contact (kn, kt, kr and ktw), in this order.
using Stiffnesses = std::array<double, 4>;
inline constexpr std::array<const char*, 4> kStiffnessNames = {"kn", "kt", "kr", "ktw"};

/// Relative tolerance for the comparison between stiffnesses from another program and stiffnesses of the contact law.
/// The law computes a stiffness from the contact force. Both the stiffness and the force are rounded in files, to six
/// digits or more; the tolerance allows for this rounding.
inline constexpr double kForeignStiffness = 1e-5;

template <int Dim>
Stiffnesses stiffnesses(const Contact<Dim>& contact) {
  return {contact.kn, contact.kt, contact.kr, contact.ktw};
}

/// Returns the stiffnesses of a contact that follow from the contact law of the packing: from the elastic force if the
/// surfaces touch, from the gap if they attract each other across the gap. A stiffness that varies with the load is
/// computed from the force, because the overlap is a small difference of positions and therefore inaccurate.
template <int Dim>
Stiffnesses law_stiffnesses(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns whether a stiffness differs from the stiffness `by_law` of the contact law by more than `tolerance` times
/// `by_law`.
bool differ(double found, double by_law, double tolerance);

/// Comparison of given stiffnesses of contacts with the stiffnesses that follow from the contact law.
class StiffnessComparison {
 public:
  /// Adds the stiffnesses of one contact to the comparison.
  /// @param names  names of the two grains of the contact in messages, such as "0-4"
  void add(const Stiffnesses& found, const Stiffnesses& by_law, const std::string& names);

  /// Returns one message for each of the four kinds of stiffness that differs from the contact law. The message
  /// contains the number of contacts, the ratio to the stiffness of the law, and the contact with the largest
  /// difference: "kn of 24 contacts is 10 times the value of the contact law (grains 0-4: 1.2e+07, by the law
  /// 1.2e+06)".
  /// @param force_exponent  exponent of the overlap in the elastic force of the law. If the exponent is not 1, messages
  /// point out a common mistake: the given kn is the normal force N divided by the overlap delta, which for Hertz
  /// contacts is only two thirds of the stiffness.
  std::vector<std::string> differences(double force_exponent) const;

 private:
  struct Kind {
    int n = 0;
    /// Smallest and largest ratio, over all contacts, of the given stiffness to the stiffness of the law. The ratio is
    /// infinite if the stiffness of the law is 0.
    double least = 0.0, largest = 0.0;
    /// largest relative difference; the following members describe the contact with this difference
    double worst = 0.0;
    double found = 0.0, by_law = 0.0;
    std::string names;
  };
  std::array<Kind, 4> kinds_;
};

/// Compares the stiffnesses of all contacts of a packing with its contact law, and returns messages about differences;
/// empty if there are none.
template <int Dim>
std::string stiffness_differences(const Packing<Dim>& packing);

}  // namespace floc
