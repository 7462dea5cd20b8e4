#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Strength of the elements of a lattice: tension at which elements of each kind break (force); infinite if they never
/// break.
struct ElementStrength {
  std::array<double, kElementKinds> tension{};  ///< strength of each ElementKind (force)

  /// Returns every invalid strength as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Breakage of one element.
struct Breakage {
  int element;    ///< index of the element in the lattice network
  double strain;  ///< strain along the load when the element broke, shortening positive
  double stress;  ///< stress at which the element broke, compression positive (stress)
};

struct FractureOptions {
  ElementStrength strength;
  /// Share of the largest stress below which the fracture ends, in kShare.
  double end_at = 0.2;
  static constexpr NumberRange kShare{.least = 0.0, .most = 1.0};
  int most_broken = 1'000'000;  ///< largest number of elements that may break
  /// Function that is called after each breakage; if it returns false, the fracture ends.
  std::function<bool(const Breakage&, int n_broken)> observe = {};
};

/// Fracture of a sample, one element at a time.
struct FracturePath {
  std::vector<Breakage> broken;  ///< breakages in the order in which they happened
  double strength =
      0.0;  ///< strength of the sample: largest absolute stress carried; 0 if no element can break
  double strain_at_strength = 0.0;  ///< strain at the largest stress
  std::string end;                  ///< reason why the fracture ended, as a sentence
};

/// Simulates the fracture of a sample. The load is increased in proportion to `load` until the first element reaches
/// its strength; this element is removed, and the lattice is solved again. The load that breaks the next element may be
/// smaller (under constant stress, the sample would fail at once) or larger. Every state is elastic, so that the stress
/// at which the next element breaks follows by scaling.
/// @param load  direction of the load, with any magnitude
/// @param axis  component whose stress and strain are reported
/// @throws InputError if an option is invalid
template <int Dim>
[[nodiscard]] FracturePath fracture(const LatticeNetwork<Dim>& network, LatticeSolver<Dim>& solver,
                                    const LatticeLoad<Dim>& load, int axis, const FractureOptions& options);

}  // namespace floc
