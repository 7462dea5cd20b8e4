#include "floc/structure/force_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "floc/base/range.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"

namespace floc {
namespace {

/// Forces up to this share of the largest force in the packing count as zero, because they may be rounding errors.
constexpr double kRoundedForce = 1e-12;
/// A pressure counts as zero if it is at most this share of the pressure that would result if all contact forces were
/// compressive.
constexpr double kNoPressure = 1e-8;

/// Returns the largest magnitude of all elastic and all total normal forces in a packing (force).
template <int Dim>
double largest_part(const Packing<Dim>& packing) {
  double largest = 0.0;
  for (const Contact<Dim>& c : packing.contacts)
    largest = std::max({largest, std::abs(c.elastic_force), std::abs(c.normal_force)});
  return largest;
}

/// Returns the index of the histogram bin that contains a value.
/// @return no value for NaN, or if the value is more than kMaxBins bins away from zero
std::optional<int> bin_of(double value, double width) {
  const double bin = std::floor(value / width);
  if (!(bin >= -kMaxBins && bin < kMaxBins)) return std::nullopt;
  return static_cast<int>(bin);
}

}  // namespace

std::string name_of(ForceKind kind) {
  switch (kind) {
    case ForceKind::normal:
      return "normal";
    case ForceKind::tangential:
      return "tangential";
    case ForceKind::rolling:
      return "rolling";
  }
  return {};
}

template <int Dim>
std::vector<double> contact_forces(const Packing<Dim>& packing, ForceKind kind) {
  std::vector<double> forces;
  for (const Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j)) continue;
    if (kind == ForceKind::normal) {
      forces.push_back(c.normal_force);
    } else if (!c.distant) {
      forces.push_back(kind == ForceKind::tangential ? c.shear_force.norm() : c.rolling_moment.norm());
    }
  }
  return forces;
}

std::vector<double> sizes_of(const std::vector<double>& values, double sign) {
  std::vector<double> sizes;
  for (const double x : values)
    if (sign * x > 0.0) sizes.push_back(sign * x);
  return sizes;
}

double mean_size(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += std::abs(x);
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

void ForceDistribution::add(const ForceDistribution& other) {
  if (other.n == 0) return;
  if (n == 0) {
    *this = other;
    return;
  }
  assert(width == other.width);
  const auto end = [](const ForceDistribution& d) { return d.first + static_cast<int>(d.counts.size()); };
  if (counts.empty()) first = other.first;
  const int low_end = other.counts.empty() ? first : std::min(first, other.first);
  std::vector<std::int64_t> sum(std::max({low_end, end(*this), end(other)}) - low_end, 0);
  for (const ForceDistribution* d : {static_cast<const ForceDistribution*>(this), &other})
    for (std::size_t b = 0; b < d->counts.size(); ++b)
      sum[d->first - low_end + static_cast<int>(b)] += d->counts[b];
  unit = (unit * static_cast<double>(n) + other.unit * static_cast<double>(other.n)) /
         static_cast<double>(n + other.n);
  n += other.n;
  n_outside += other.n_outside;
  first = low_end;
  counts = std::move(sum);
}

ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width) {
  require_in_range("bin_width", width, kPositiveNumber);
  ForceDistribution out;
  out.unit = unit;
  out.width = width;
  if (unit == 0.0) return out;
  std::vector<int> bins;
  for (const double x : values)
    if (const auto bin = bin_of(x, unit * width)) bins.push_back(*bin);
  out.n = static_cast<std::int64_t>(values.size());
  out.n_outside = out.n - static_cast<std::int64_t>(bins.size());
  if (bins.empty()) return out;
  const auto [low, high] = std::minmax_element(bins.begin(), bins.end());
  out.first = *low;
  out.counts.assign(*high - *low + 1, 0);
  for (const int bin : bins) ++out.counts[bin - out.first];
  return out;
}

std::string outside_bins(const ForceDistribution& d, const std::string& what, const std::string& remedy) {
  return fmt::format(
      "{} of {} {} are in no bin of their distribution, which ends {} bins of width {:g} from zero: "
      "choose a larger {}",
      d.n_outside, d.n, what, kMaxBins, d.width, remedy);
}

template <int Dim>
double pressure_force(const Packing<Dim>& packing) {
  return static_stress(packing).trace() / Dim * std::pow(largest_diameter(packing.grains), Dim - 1);
}

template <int Dim>
bool pressure_is_noise(const Packing<Dim>& packing) {
  double virial = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    const double other = packing.is_wall(c.j) ? 0.0 : packing.grains.radius[c.j];
    virial += std::abs(c.normal_force) * (packing.grains.radius[c.i] + other);
  }
  return std::abs(static_stress(packing).trace()) * packing.cell.volume() <= kNoPressure * virial;
}

template <int Dim>
double force_unit(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit) {
  const double length = kind == ForceKind::rolling ? largest_diameter(packing.grains) : 1.0;
  if (unit == ForceUnit::pull_off) return pull_off_force(packing) * length;
  if (unit == ForceUnit::pressure)
    return pressure_is_noise(packing) ? 0.0 : std::max(0.0, pressure_force(packing)) * length;
  const double mean = mean_size(contact_forces(packing, kind));
  return mean > kRoundedForce * largest_part(packing) * length ? mean : 0.0;
}

template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit,
                                     double width) {
  return distribution_of(contact_forces(packing, kind), force_unit(packing, kind, unit), width);
}

#define FLOC_INSTANTIATE(Dim)                                                  \
  template double pressure_force(const Packing<Dim>&);                         \
  template bool pressure_is_noise(const Packing<Dim>&);                        \
  template double force_unit(const Packing<Dim>&, ForceKind, ForceUnit);       \
  template std::vector<double> contact_forces(const Packing<Dim>&, ForceKind); \
  template ForceDistribution force_distribution(const Packing<Dim>&, ForceKind, ForceUnit, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
