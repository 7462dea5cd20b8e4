#include "floc/structure/force_moments.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

template <int Dim>
void add_mobilisation(const Packing<Dim>& packing, double mean, ForceMoments& out) {
  int n_above = 0, n_below = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant || !(c.elastic_force > 0.0)) continue;
    const double mobilised = c.shear_force.norm() / c.elastic_force;
    if (c.elastic_force > mean)
      out.M1 += mobilised, ++n_above;
    else
      out.M2 += mobilised, ++n_below;
  }
  if (n_above > 0) out.M1 /= n_above;
  if (n_below > 0) out.M2 /= n_below;
}

}  // namespace

template <int Dim>
ForceMoments force_moments(const Packing<Dim>& packing) {
  ForceMoments out;
  double mean = 0.0;
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant) continue;
    ++n;
    mean += c.elastic_force;
    out.mean_normal += c.normal_force;
    out.largest = std::max(out.largest, std::abs(c.normal_force));
  }
  if (n == 0) return out;
  mean /= n;
  out.mean_normal /= n;
  if (!(mean > 0.0)) return out;
  for (const Contact<Dim>& c : packing.contacts)
    for (int q = 2; q <= 4 && !c.distant; ++q) out.Z[q - 2] += std::pow(c.elastic_force / mean, q) / n;
  add_mobilisation(packing, mean, out);
  return out;
}

template ForceMoments force_moments(const Packing<2>&);
template ForceMoments force_moments(const Packing<3>&);

}  // namespace floc
