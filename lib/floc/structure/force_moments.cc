#include "floc/structure/force_moments.h"

#include <algorithm>
#include <cmath>

#include "floc/structure/mobilisation.h"

namespace floc {
template <int Dim>
ForceMoments force_moments(const Packing<Dim>& packing) {
  const auto counted = [&packing](const Contact<Dim>& c) { return !c.distant && !packing.is_wall(c.j); };
  ForceMoments out;
  double& mean = out.mean_normal;
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (!counted(c)) continue;
    ++n;
    mean += c.elastic_force;
    out.largest = std::max(out.largest, c.elastic_force);
  }
  if (n == 0) return out;
  mean /= n;
  if (!(mean > 0.0)) return out;
  for (const Contact<Dim>& c : packing.contacts)
    for (int q = 2; q <= 4 && counted(c); ++q) out.Z[q - 2] += std::pow(c.elastic_force / mean, q) / n;
  MobilisationByForce mobilisation(mean);
  for (const Contact<Dim>& c : packing.contacts)
    if (counted(c)) mobilisation.add(c);
  out.M1 = mobilisation.M1();
  out.M2 = mobilisation.M2();
  return out;
}

template ForceMoments force_moments(const Packing<2>&);
template ForceMoments force_moments(const Packing<3>&);

}  // namespace floc
