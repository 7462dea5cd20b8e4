#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing after affine compression or expansion to the given solid fraction: the cell and all positions are
/// scaled by one factor, but the grains keep their sizes.
template <int Dim>
Packing<Dim> scaled_to(const Packing<Dim>& packing, double solid_fraction);

/// Coordination numbers and pressure of a packing directly after affine scaling, before its grains move to a new
/// equilibrium.
struct AffinePrediction {
  /// Coordination number, including rattlers, after all distances are scaled by a factor s: twice the number of pairs
  /// of grains that overlap, divided by the number of grains. For equal grains of diameter a, this is z_I(a/s - a),
  /// where z_I(h) is the coordination number of neighbours at gaps up to h before the scaling.
  double z = 0.0;
  /// Coordination number like `z`, but with the rattlers (grains that carry no force) pushed against other grains
  /// before the scaling.
  double z_pushed = 0.0;
  /// Mean normal stress (force/length^(Dim-1)) after all distances are scaled by a factor s. For equal grains of
  /// diameter a, this is the sum of N(a - s r) s r over all pairs of grains with a distance s r < a, divided by Dim
  /// times the volume of the scaled cell. Here, r is the distance before the scaling, and N(h) is the normal force that
  /// the contact law gives for the overlap h.
  double pressure = 0.0;
};

/// A packing from which coordination numbers and pressure at other solid fractions are predicted.
template <int Dim>
class AffineReference {
 public:
  /// @param rattler  whether each grain is a rattler (a grain that carries no force)
  AffineReference(const Packing<Dim>& packing, const std::vector<bool>& rattler);

  /// Returns the prediction for the packing scaled to a solid fraction.
  /// @throws InputError if find_contacts() throws it
  AffinePrediction at(double solid_fraction) const;

 private:
  Packing<Dim> packing_, pushed_;
};

}  // namespace floc
