#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

inline constexpr NumberRule kCellMass{[](double x) { return x > 0; },
                                      "a positive number (mass of the cell's sides over that of all grains)"};
inline constexpr NumberRule kInertialNumberCap{[](double x) { return x > 0; },
                                               "a positive number (|L'/L| sqrt(m/P))"};

/// How the cell answers to its load in one part of a run, or the walls of a box.
/// @param boxed  the grains stand in a [box]
CellResponse read_cell_response(TableReader& t, bool boxed);

/// Reads [[load]], the stages of the load path. @pre the scene has its law, its assembly and its box
void read_load(TableReader& root, Scene& scene);

}  // namespace floc
