#include "floc/packing/overlaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"

namespace floc {

template <int Dim>
Overlaps measure_overlaps(const Packing<Dim>& packing) {
  Overlaps out;
  int n_touching = 0, n_deep = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant) continue;
    const double radius = packing.grains.radius[c.i];
    const double smaller = packing.is_wall(c.j) ? radius : std::min(radius, packing.grains.radius[c.j]);
    const double overlap = -c.gap / smaller;
    ++n_touching;
    n_deep += overlap > kDeepOverlap;
    out.mean += overlap;
    out.largest = std::max(out.largest, overlap);
  }
  if (n_touching == 0) return out;
  out.mean /= n_touching;
  out.deep_share = static_cast<double>(n_deep) / n_touching;
  return out;
}

template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing) {
  if (!packing.law.stiffness_varies()) return {};
  const Overlaps found = measure_overlaps(packing);
  if (found.deep_share == 0.0) return {};
  return fmt::format(
      "{:.2g} % of the contacts overlap by more than a tenth of a radius, the deepest by {:.3g} of it: Hertz's "
      "law is for small overlaps",
      100.0 * found.deep_share, found.largest);
}

template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing) {
  if (!packing.law.stiffness_varies()) return;
  const Overlaps found = measure_overlaps(packing);
  if (found.mean > kDeepestMean)
    throw InputError(place, fmt::format("contacts overlap by {:.3g} of a radius in the mean, expected at most "
                                        "{}: Hertz's law is for small overlaps",
                                        found.mean, kDeepestMean));
}

#define FLOC_INSTANTIATE(Dim)                                \
  template Overlaps measure_overlaps(const Packing<Dim>&);   \
  template std::string overlap_warning(const Packing<Dim>&); \
  template void require_small_overlaps(const std::string&, const Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
