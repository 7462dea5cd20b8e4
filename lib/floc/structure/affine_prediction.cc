#include "floc/structure/affine_prediction.h"

#include <cassert>
#include <cmath>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/structure/gap_coordination.h"
#include "floc/structure/pushed_rattlers.h"

namespace floc {

template <int Dim>
Packing<Dim> scaled_to(const Packing<Dim>& packing, double solid_fraction) {
  assert(packing.walls.empty() && solid_fraction > 0.0);
  const double s = std::pow(floc::solid_fraction(packing) / solid_fraction, 1.0 / Dim);
  Packing<Dim> scaled;
  scaled.law = packing.law;
  scaled.grains = packing.grains;
  scaled.grains.position_low.clear();
  for (Vec<Dim>& x : scaled.grains.position) x *= s;
  scaled.cell = packing.cell;
  scaled.cell.matrix *= s;
  return scaled;
}

template <int Dim>
AffineReference<Dim>::AffineReference(const Packing<Dim>& packing, const std::vector<bool>& rattler)
    : packing_(packing), pushed_(with_pushed_rattlers(packing, rattler)) {}

template <int Dim>
AffinePrediction AffineReference<Dim>::at(double solid_fraction) const {
  Packing<Dim> scaled = scaled_to(packing_, solid_fraction);
  find_contacts(scaled);
  AffinePrediction out;
  out.z = gap_coordination(scaled, {0.0})[0];
  out.z_pushed = gap_coordination(scaled_to(pushed_, solid_fraction), {0.0})[0];
  out.pressure = static_stress(scaled).trace() / Dim;
  return out;
}

#define FLOC_INSTANTIATE(Dim)                                   \
  template Packing<Dim> scaled_to(const Packing<Dim>&, double); \
  template class AffineReference<Dim>;
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
