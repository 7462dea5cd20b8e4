#include "floc/structure/coordination.h"

#include <algorithm>
#include <cmath>

#include "floc/network/rattlers.h"

namespace floc {

template <int Dim>
Coordination coordination(const Packing<Dim>& packing, double zero_force) {
  Coordination result;
  int positive = 0, negative = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant) {
      ++result.n_distant;
      continue;
    }
    ++result.n_contacts;
    positive += c.normal_force > zero_force;
    negative += c.normal_force < -zero_force;
  }
  const int n = packing.grains.size();
  if (n == 0) return result;
  const double per_contact = 2.0 / n;
  result.z = per_contact * result.n_contacts;
  result.z_plus = per_contact * positive;
  result.z_minus = per_contact * negative;
  result.z_zero = per_contact * (result.n_contacts - positive - negative);
  const std::vector<bool> rattlers = find_rattlers(packing, zero_force);
  result.rattler_fraction = static_cast<double>(std::count(rattlers.begin(), rattlers.end(), true)) / n;
  return result;
}

template Coordination coordination(const Packing<2>&, double);
template Coordination coordination(const Packing<3>&, double);

}  // namespace floc
