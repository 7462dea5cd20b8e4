#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing at another solid fraction, with its cell and all positions scaled by one factor while the
/// grains keep their size: the result of an affine compression or expansion.
template <int Dim>
Packing<Dim> scaled_to(const Packing<Dim>& packing, double solid_fraction);

/// Coordination and pressure of a packing after affine scaling, before any grain has moved otherwise.
struct AffinePrediction {
  double z = 0.0;         ///< z_I(a/s - a): coordination number with rattlers where they are
  double z_pushed = 0.0;  ///< z_II: coordination number with rattlers first pushed against other grains
  /// Mean normal stress of the law's normal forces at the overlaps (force/length^(Dim-1)): over pairs with
  /// s r < a, the sum of N(a - s r) s r over Dim times the volume.
  double pressure = 0.0;
};

/// State from which predictions are made for several solid fractions.
template <int Dim>
class AffineReference {
 public:
  /// @param rattler  one entry per grain
  AffineReference(const Packing<Dim>& packing, const std::vector<bool>& rattler);

  /// @throws InputError as find_contacts()
  AffinePrediction at(double solid_fraction) const;

 private:
  Packing<Dim> packing_, pushed_;
};

}  // namespace floc
