#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns whether a state has a reduced pressure. A state of rigid grains without adhesion has no reduced pressure,
/// because the pressure is the only scale of its forces.
template <int Dim>
bool has_reduced_pressure(const State<Dim>& state);

/// Returns the imposed pressure of a state as text for captions and legends. If has_reduced_pressure() is true, the
/// text gives the reduced pressure. If the load path drives one axis of the state, the text gives the mean over the
/// axes and the stress on the driven axis, each with its name.
template <int Dim>
std::string pressure_value(const State<Dim>& state);

/// Returns pressure_value() after "P* = " or, if the pressure is not reduced, after "P = ".
template <int Dim>
std::string pressure_text(const State<Dim>& state) {
  return (has_reduced_pressure(state) ? "P* = " : "P = ") + pressure_value(state);
}

/// Returns the label of an axis that shows the reduced pressure of states, computed from the mean stress.
/// @param some_are_driven  whether the load path drives one axis of some states
std::string mean_pressure_label(bool some_are_driven);

}  // namespace floc
