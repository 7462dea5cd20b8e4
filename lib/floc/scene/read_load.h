#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

inline constexpr NumberRule kCellMass{positive,
                                      "a positive number (mass of the cell's sides over that of all grains)"};
inline constexpr NumberRule kInertialNumberCap{positive, "a positive number (|L'/L| sqrt(m/P))"};
inline constexpr NumberRule kStrainRateCapRule{
    positive, "a positive number (|L'/L| in units of 1/T0, T0 = sqrt(a m/F0))"};

/// Reads the caps on the strain rate of the cell: strain_rate_cap, for grains that adhere, or
/// inertial_number_cap, or none.
CellResponse read_rate_caps(TableReader& t);

/// Reads the response of the cell, or of the walls of a box, to their load in one part of a run.
/// @param boxed  whether the scene has a [box]
CellResponse read_cell_response(TableReader& t, bool boxed);

/// Reads [[load]], the stages of the load path. @pre law, assembly and box of the scene have been read
/// @param unsaid  cell response of stages that give none, if the rest of the scene gives none either
void read_load(TableReader& root, const CellResponse& unsaid, Scene& scene);

}  // namespace floc
