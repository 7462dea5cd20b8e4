#include "floc/structure/contact_directions.h"

#include <cmath>
#include <numbers>

namespace floc {

ContactDirections contact_directions(const Packing<2>& packing, int n_bins) {
  ContactDirections out;
  out.n_bins = n_bins;
  out.all.assign(static_cast<std::size_t>(n_bins), 0.0);
  out.strong = out.all;
  const auto counts = [](const Contact<2>& c) { return !c.distant && c.normal_force > 0.0; };
  double sum = 0.0;
  for (const Contact<2>& c : packing.contacts)
    if (counts(c)) sum += c.normal_force, ++out.n_contacts;
  if (out.n_contacts == 0) return out;
  const double mean = sum / out.n_contacts;
  const double weight = n_bins / (std::numbers::pi * out.n_contacts);
  for (const Contact<2>& c : packing.contacts) {
    if (!counts(c)) continue;
    double angle = std::atan2(c.normal[1], c.normal[0]);
    if (angle < 0.0) angle += std::numbers::pi;
    // The directions pi and 0 are equal.
    const int bin = static_cast<int>(angle / std::numbers::pi * n_bins) % n_bins;
    out.all[static_cast<std::size_t>(bin)] += weight;
    if (c.normal_force > mean) out.strong[static_cast<std::size_t>(bin)] += weight;
  }
  return out;
}

}  // namespace floc
