#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing at another solid fraction after an affine compression or expansion: its cell and all
/// positions are scaled by one factor, and the grains keep their size.
template <int Dim>
Packing<Dim> scaled_to(const Packing<Dim>& packing, double solid_fraction);

/// Coordination and pressure of a packing after affine scaling, before any grain has moved otherwise.
struct AffinePrediction {
  /// Coordination number by the pairs that overlap after all distances are scaled by s, with rattlers at their
  /// places. It is z_I(a/s - a), with z_I(h) the coordination number of neighbours at gaps up to h and a the
  /// diameter.
  double z = 0.0;
  /// Coordination number z_II(a/s - a) of the scaled packing if rattlers are first pushed against other grains.
  double z_pushed = 0.0;
  /// Mean normal stress by the normal forces N of the contact law at the overlaps after scaling by s
  /// (force/length^(Dim-1)): the sum of N(a - s r) s r over pairs at distances s r < a, divided by Dim times
  /// the volume.
  double pressure = 0.0;
};

/// Packing from which coordination and pressure are predicted at several solid fractions.
template <int Dim>
class AffineReference {
 public:
  /// @param rattler  whether each grain is a rattler (a grain that carries no force)
  AffineReference(const Packing<Dim>& packing, const std::vector<bool>& rattler);

  /// Returns the prediction at a solid fraction. @throws InputError if find_contacts() throws it
  AffinePrediction at(double solid_fraction) const;

 private:
  Packing<Dim> packing_, pushed_;
};

}  // namespace floc
