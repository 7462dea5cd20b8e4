#pragma once

#include <string>

#include "floc/packing/state.h"

namespace floc {

/// Whether a state has a reduced pressure. Rigid grains that do not adhere have no scale of forces but the pressure.
template <int Dim>
bool has_reduced_pressure(const State<Dim>& state);

/// Returns the reduced pressure of a state, imposed or carried, for captions and legends: one number or, if the load
/// path drives one axis of the state, the mean over the axes and the stress on that axis, each with its name. It is the pressure
/// itself where has_reduced_pressure() is false.
template <int Dim>
std::string pressure_value(const State<Dim>& state);

/// Returns pressure_value() after the sign "P* = ", or "P = " where the pressure is not reduced.
template <int Dim>
std::string pressure_text(const State<Dim>& state) {
  return (has_reduced_pressure(state) ? "P* = " : "P = ") + pressure_value(state);
}

/// Returns the label of an axis with the reduced pressure of states, which is that of the mean stress.
/// @param some_are_driven  whether the load path drives one axis of some states
std::string mean_pressure_label(bool some_are_driven);

}  // namespace floc
