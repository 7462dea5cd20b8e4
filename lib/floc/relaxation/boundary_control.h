#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "floc/packing/load_target.h"

namespace floc {

/// Control of one strain component of the boundary (lattice and walls) of a packing.
enum class Imposed {
  /// the strain component changes under the difference between the stress in the packing and an imposed stress
  stress,
  rate,  ///< the strain component changes at an imposed rate, which is zero for a fixed component
};

/// Strain ramp: smooth change of the lengths of some axes of the cell, with zero rate at the beginning and at the end.
/// With t = time/duration, the logarithmic strain of an axis is proportional to 3 t^2 - 2 t^3 (docs/physics.md,
/// "Boundary control"). The ramp may also shear a lattice vector: the change of its offset (component along the first
/// axis) is then proportional to 3 t^2 - 2 t^3, too.
template <int Dim>
struct StrainRamp {
  static constexpr double kPeak = 1.5;  ///< ratio of the largest strain rate on a ramp to the mean strain rate

  /// Lengths of the axes before and after the ramp (length); equal for axes that do not move.
  Vec<Dim> from = Vec<Dim>::Zero(), to = Vec<Dim>::Zero();
  double begun = 0.0;     ///< time since the ramp began (time)
  double duration = 0.0;  ///< duration of the ramp (time)
  /// Index of the axis whose lattice vector is displaced along the first axis; 0 if there is no shear.
  int sheared_axis = 0;
  /// Offset of the sheared lattice vector (its component along the first axis), before and after the ramp (length).
  double offset_from = 0.0, offset_to = 0.0;
  double height = 1.0;  ///< length of the sheared axis before the ramp (length)

  bool any() const { return from != to || shears(); }
  bool shears() const { return offset_from != offset_to; }
  bool over(double since) const { return begun + since >= duration; }
  /// Returns the length of an axis at the time `begun` + `since` after the beginning of the ramp (length).
  double length(int axis, double since) const {
    if (over(since)) return to[axis];
    return from[axis] * std::pow(to[axis] / from[axis], share(since));
  }
  /// Returns the offset (component along the first axis) of the sheared lattice vector at the time `begun` + `since`
  /// after the beginning of the ramp (length).
  double offset(double since) const {
    return over(since) ? offset_to : offset_from + share(since) * (offset_to - offset_from);
  }
  double shear_strain() const { return (offset_to - offset_from) / height; }
  double largest_strain() const {
    double largest = std::abs(shear_strain());
    for (int a = 0; a < Dim; ++a)
      if (from[a] != to[a]) largest = std::max(largest, std::abs(std::log(to[a] / from[a])));
    return largest;
  }

 private:
  /// Returns the share (0 to 1) of the total strain that is reached at the time `begun` + `since` after the beginning
  /// of the ramp.
  double share(double since) const {
    const double t = (begun + since) / duration;
    return t * t * (3.0 - 2.0 * t);
  }
};

/// Control of the boundary of a packing (docs/physics.md, "Boundary control"): each strain component follows an imposed
/// stress or has an imposed strain rate. The matrix of the lattice vectors stays lower triangular (the first vector is
/// along the first axis), so that the lattice is sheared but not rotated. The components are in the order of
/// StrainSet::full: 11, 22, 12 in 2D, and 11, 22, 33, 23, 13, 12 in 3D.
template <int Dim>
struct BoundaryControl {
  std::array<Imposed, kSymmetric<Dim>> imposed;
  /// Target of each component. For a component that follows a stress: the imposed stress, compression positive
  /// (force/length^(Dim-1)). For a component with an imposed strain rate: this rate, shortening positive (1/time); for
  /// shear the rate of the engineering strain gamma.
  Eigen::Matrix<double, kSymmetric<Dim>, 1> target = Eigen::Matrix<double, kSymmetric<Dim>, 1>::Zero();
  /// inertia M (mass) of each component of the lattice vectors that follows a stress
  double mass = 0.0;
  /// Largest strain rate of components that follow a stress (1/time).
  double rate_cap = std::numeric_limits<double>::infinity();
  StrainRamp<Dim> ramp;  ///< strain ramp of some axes; for these axes it replaces `target`
  /// Mean stress that sets the scale of forces (force/length^(Dim-1)); if absent, the mean of the imposed stresses sets
  /// it.
  std::optional<double> reference_stress;

  /// Returns a control that fixes all components of the boundary.
  static BoundaryControl fixed() {
    BoundaryControl control;
    control.imposed.fill(Imposed::rate);
    return control;
  }
  /// Returns a control that imposes a stress on each axis and fixes the shear components.
  static BoundaryControl normal_stress(const Vec<Dim>& stress, double mass,
                                       double rate_cap = std::numeric_limits<double>::infinity()) {
    BoundaryControl control = fixed();
    for (int a = 0; a < Dim; ++a) control.imposed[a] = Imposed::stress;
    control.target.template head<Dim>() = stress;
    control.mass = mass;
    control.rate_cap = rate_cap;
    return control;
  }

  /// Returns a control that imposes the stresses of a load. The shear components and the axes with an imposed length
  /// are fixed.
  /// @param stress  stress on each axis: the imposed stress or, for an axis with an imposed length, the stress in the
  /// packing
  static BoundaryControl imposing(const LoadTarget<Dim>& load, const Vec<Dim>& stress, double mass,
                                  double rate_cap = std::numeric_limits<double>::infinity()) {
    BoundaryControl control = normal_stress(stress, mass, rate_cap);
    for (int a = 0; a < Dim; ++a) {
      if (!load.strained(a)) continue;
      control.imposed[a] = Imposed::rate;
      control.target[a] = 0.0;
    }
    if (load.any_strained()) control.reference_stress = stress.mean();
    return control;
  }

  bool is_fixed() const {
    if (ramp.any()) return false;
    for (int k = 0; k < kSymmetric<Dim>; ++k)
      if (imposed[k] == Imposed::stress || target[k] != 0.0) return false;
    return true;
  }
  /// Whether a rectangular lattice stays rectangular under this control.
  bool keeps_rectangular() const {
    if (ramp.shears()) return false;
    for (int k = Dim; k < kSymmetric<Dim>; ++k)
      if (imposed[k] == Imposed::stress || target[k] != 0.0) return false;
    return true;
  }
  bool any_stress() const {
    for (const Imposed what : imposed)
      if (what == Imposed::stress) return true;
    return false;
  }
  /// Returns the reference stress if it is set, otherwise the mean of the stresses imposed on axes; zero if no stress
  /// is imposed.
  double mean_stress() const {
    if (reference_stress) return *reference_stress;
    double sum = 0.0;
    int n = 0;
    for (int a = 0; a < Dim; ++a)
      if (imposed[a] == Imposed::stress) sum += target[a], ++n;
    return n == 0 ? 0.0 : sum / n;
  }
};

/// Returns the two axes a <= b of component k of a strain or stress. The order of the components is 11, 22, 12 in 2D,
/// and 11, 22, 33, 23, 13, 12 in 3D.
template <int Dim>
constexpr std::array<int, 2> component_axes(int k) {
  if (k < Dim) return {k, k};
  if (Dim == 2) return {0, 1};
  return k == 3 ? std::array{1, 2} : k == 4 ? std::array{0, 2} : std::array{0, 1};
}

/// Returns the index of the strain component that shears the planes normal to `axis` along the first axis.
/// @pre axis > 0
template <int Dim>
constexpr int shear_component(int axis) {
  return Dim == 2 ? 2 : 6 - axis;
}

}  // namespace floc
