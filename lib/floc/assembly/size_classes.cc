#include "floc/assembly/size_classes.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Returns the size classes between given diameters.
/// @param limits  ends of the intervals, increasing (length); if it is empty, there are no classes
std::vector<SizeClass> classes_between(const std::vector<double>& limits,
                                       const DiameterDistribution& distribution, std::vector<double> diameters,
                                       int dimension) {
  if (limits.empty()) return {};
  // The diameters are sorted so that rounding errors of the sums do not depend on the order of the grains.
  std::sort(diameters.begin(), diameters.end());
  std::vector<SizeClass> classes(limits.size() - 1);
  double all = 0.0;
  for (const double d : diameters) {
    const auto above = std::lower_bound(limits.begin() + 1, limits.end() - 1, d);
    SizeClass& found = classes[static_cast<std::size_t>(above - limits.begin()) - 1];
    const double volume = std::pow(d / limits.back(), dimension);
    ++found.n_grains;
    found.share += volume;
  }
  for (const SizeClass& c : classes) all += c.share;
  double below = 0.0;
  std::optional<double> asked_below = 0.0;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    SizeClass& c = classes[k];
    c.from = limits[k];
    c.to = limits[k + 1];
    below += c.share;
    c.passing = below / all;
    c.share /= all;
    c.passing_asked = volume_share_below(distribution, dimension, c.to);
    if (c.passing_asked && asked_below) c.share_asked = *c.passing_asked - *asked_below;
    asked_below = c.passing_asked;
  }
  return classes;
}

/// Returns the ends of the four equal parts of the range of diameters; the result is empty if there is only one
/// diameter.
std::vector<double> quarters_of(const DiameterDistribution& d) {
  constexpr int kQuarters = 4;
  if (!(d.min < d.max)) return {};
  std::vector<double> limits(kQuarters + 1, d.max);
  for (int k = 0; k < kQuarters; ++k)
    limits[static_cast<std::size_t>(k)] = d.min + (d.max - d.min) * k / kQuarters;
  return limits;
}

/// Returns the smallest diameter and all sieve sizes above it.
std::vector<double> sieves_of(const DiameterDistribution& d) {
  std::vector<double> limits{d.min};
  for (const double size : d.curve.sizes)
    if (size > d.min && size <= d.max) limits.push_back(size);
  return limits;
}

}  // namespace

std::vector<SizeClass> size_classes(const DiameterDistribution& d, const std::vector<double>& diameters,
                                    int dimension) {
  const bool is_sieved = d.kind == DiameterDistribution::Kind::sieve;
  return classes_between(is_sieved ? sieves_of(d) : quarters_of(d), d, diameters, dimension);
}

std::vector<SizeClass> size_classes(const GrainOptions& grains, int dimension) {
  return size_classes(grains.diameter, equally_spaced_diameters(grains.diameter, grains.count), dimension);
}

std::vector<SizeClass> size_quarters(const GrainOptions& grains, int dimension) {
  return classes_between(quarters_of(grains.diameter), grains.diameter,
                         equally_spaced_diameters(grains.diameter, grains.count), dimension);
}

}  // namespace floc
