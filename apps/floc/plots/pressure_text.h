#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Returns the reduced pressure of a state, imposed or carried, for captions and legends: one number or, if the load
/// path drives one axis of the state, the mean over the axes and the stress on that axis, each with its name.
template <int Dim>
std::string pressure_value(const State<Dim>& state);

/// Returns pressure_value() after the sign "P* = ".
template <int Dim>
std::string pressure_text(const State<Dim>& state) {
  return "P* = " + pressure_value(state);
}

/// Returns the label of an axis with the reduced pressure of states, which is that of the mean stress.
/// @param some_are_driven  whether the load path drives one axis of some states
std::string mean_pressure_label(bool some_are_driven);

}  // namespace floc
