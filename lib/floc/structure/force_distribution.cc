#include "floc/structure/force_distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "floc/base/range.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid.h"

namespace floc {
namespace {

constexpr double kMaxBins = 1e5;

/// A unit that does not depend on the forces themselves.
template <int Dim>
double given_unit(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit) {
  const double force = unit == ForceUnit::pull_off ? pull_off_force(packing) : pressure_force(packing);
  return kind == ForceKind::rolling ? force * largest_diameter(packing.grains) : force;
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
  const int low_end = std::min(first, other.first);
  std::vector<std::int64_t> sum(std::max(end(*this), end(other)) - low_end, 0);
  for (const ForceDistribution* d : {static_cast<const ForceDistribution*>(this), &other})
    for (std::size_t b = 0; b < d->counts.size(); ++b)
      sum[d->first - low_end + static_cast<int>(b)] += d->counts[b];
  unit = (unit * static_cast<double>(n) + other.unit * static_cast<double>(other.n)) /
         static_cast<double>(n + other.n);
  n += other.n;
  first = low_end;
  counts = std::move(sum);
}

ForceDistribution distribution_of(const std::vector<double>& values, double unit, double width) {
  require_in_range("bin_width", width, kPositiveNumber);
  ForceDistribution out;
  out.unit = unit;
  out.width = width;
  if (values.empty() || !(unit > 0.0)) return out;
  const auto bin_of = [&](double x) {
    return static_cast<int>(std::clamp(std::floor(x / (unit * width)), -kMaxBins, kMaxBins));
  };
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  out.first = bin_of(*low);
  out.counts.assign(bin_of(*high) - out.first + 1, 0);
  for (const double x : values) ++out.counts[bin_of(x) - out.first];
  out.n = static_cast<std::int64_t>(values.size());
  return out;
}

template <int Dim>
double pressure_force(const Packing<Dim>& packing) {
  return static_stress(packing).trace() / Dim * std::pow(largest_diameter(packing.grains), Dim - 1);
}

template <int Dim>
ForceDistribution force_distribution(const Packing<Dim>& packing, ForceKind kind, ForceUnit unit,
                                     double width) {
  const std::vector<double> forces = contact_forces(packing, kind);
  return distribution_of(forces, unit == ForceUnit::mean ? mean_size(forces) : given_unit(packing, kind, unit),
                         width);
}

#define FLOC_INSTANTIATE(Dim)                                                  \
  template double pressure_force(const Packing<Dim>&);                         \
  template std::vector<double> contact_forces(const Packing<Dim>&, ForceKind); \
  template ForceDistribution force_distribution(const Packing<Dim>&, ForceKind, ForceUnit, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
