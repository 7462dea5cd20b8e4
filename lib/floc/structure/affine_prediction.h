#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// A packing at another solid fraction, with its cell and all places scaled alike while the grains keep their
/// size: the outcome of an affine compression or expansion.
template <int Dim>
Packing<Dim> scaled_to(const Packing<Dim>& packing, double solid_fraction);

/// Coordination and pressure of such a packing, before anything moves.
struct AffinePrediction {
  double z = 0.0;         ///< z_I(a/s - a): surfaces that touch, rattlers where they are
  double z_pushed = 0.0;  ///< z_II: rattlers pushed against the others first
  /// Mean normal stress of the law's normal forces at the overlaps (force/length^(Dim-1)): over pairs with
  /// s r < a, the sum of N(a - s r) s r over Dim times the volume.
  double pressure = 0.0;
};

/// Predictions for one solid fraction after another from one state.
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
