// Member functions of class Relaxer for axes with an imposed length and for a lattice that is sheared.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/relaxer.h"

namespace floc {
namespace {

/// Largest strain rate |L'/L| of the axes with an imposed length L, times sqrt(a m/F1), with a the largest diameter, m
/// the largest mass and F1 the force scale. At this rate, the ramp of a strain of 1e-3 takes less time than the packing
/// needs afterwards to come to rest. If the scene sets a lower cap on the strain rate, that cap applies.
constexpr double kRampInertialNumber = 1e-3;
/// Reduced pressure (reduced_pressure()) below which axes with an imposed length count as free of stress. No packing is
/// in equilibrium at so small a pressure.
constexpr double kNoPressure = 1e-12;
/// A cell counts as closed if a side, divided by the largest diameter, is below this number. Overlaps are small, so
/// grains do not fit into a smaller cell.
constexpr double kClosed = 0.5;

}  // namespace

/// Returns the strain ramp from the lengths of the axes before this relaxation to their imposed lengths.
template <int Dim>
StrainRamp<Dim> Relaxer<Dim>::strain_ramp() const {
  StrainRamp<Dim> ramp;
  for (int a = 0; a < Dim; ++a) {
    if (!load_.strained(a)) continue;
    ramp.from[a] = progress_.side_before[a];
    ramp.to[a] = load_.side[a];
  }
  if (load_.offset) {
    ramp.sheared_axis = load_.offset->axis;
    ramp.offset_from = progress_.offset_before;
    ramp.offset_to = load_.offset->offset;
    ramp.height = progress_.side_before[ramp.sheared_axis];
  }
  ramp.begun = progress_.time;
  ramp.duration = progress_.ramp_duration;
  return ramp;
}

template <int Dim>
void Relaxer<Dim>::begin_strain_ramp() {
  for (int a = 0; a < Dim; ++a) progress_.side_before.push_back(packing_.cell.matrix(a, a));
  if (load_.offset) progress_.offset_before = packing_.cell.matrix(load_.offset->axis, 0);
  double fastest =
      std::min(options_.inertial_number_cap.value_or(kRampInertialNumber), kRampInertialNumber) / time_unit_;
  if (options_.strain_rate_cap) fastest = std::min(fastest, strain_rate_cap(options_, packing_, target_));
  const double strain = strain_ramp().largest_strain();
  if (strain > 0.0) progress_.ramp_duration = StrainRamp<Dim>::kPeak * strain / fastest;
}

/// Whether the packing carries no stress at the imposed lengths. With adhesion, it carries none if no contact is left;
/// without adhesion, it carries none if the pressure is zero.
template <int Dim>
bool Relaxer<Dim>::carries_no_stress() const {
  if (!load_.any_strained()) return false;
  if (packing_.law.adheres()) return packing_.contacts.empty();
  return !(reduced_pressure(packing_, target_.mean()) > kNoPressure);
}

template <int Dim>
double Relaxer<Dim>::mean_carried_stress() const {
  double sum = 0.0;
  int n = 0;
  for (int a = 0; a < Dim; ++a)
    if (load_.strained(a)) sum += stress_(a, a), ++n;
  return sum / n;
}

/// Returns an error message if the imposed lengths are too short for grains with small overlaps; empty if they are long
/// enough.
template <int Dim>
std::string Relaxer<Dim>::overfilled_cell_error() const {
  const double a = largest_diameter(packing_.grains);
  double volume = packing_.cell.volume();
  bool all_strained = true;
  for (int k = 0; k < Dim; ++k) {
    const double side = packing_.cell.matrix(k, k);
    if (!load_.strained(k)) {
      all_strained = false;
      continue;
    }
    if (load_.side[k] < kClosed * a)
      return fmt::format(
          "the cell closes: the imposed length of axis {} is {:.4g}, too short for the largest grain, whose "
          "diameter is {:.4g}; impose a smaller strain",
          k + 1, load_.side[k], a);
    volume *= load_.side[k] / side;
  }
  const double phi = solid_fraction(packing_) * packing_.cell.volume() / volume;
  if (!all_strained || phi <= 1.0) return "";
  return fmt::format(
      "the cell closes: at the imposed lengths the volume of the grains is {:.4g} times that of the cell; "
      "impose a smaller strain",
      phi);
}

#define FLOC_INSTANTIATE(Dim)                                 \
  template StrainRamp<Dim> Relaxer<Dim>::strain_ramp() const; \
  template void Relaxer<Dim>::begin_strain_ramp();            \
  template bool Relaxer<Dim>::carries_no_stress() const;      \
  template double Relaxer<Dim>::mean_carried_stress() const;  \
  template std::string Relaxer<Dim>::overfilled_cell_error() const;
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
