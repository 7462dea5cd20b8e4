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

/// How the cell, or the walls of a box, respond to their load in one part of a run.
/// @param boxed  the grains stand in a [box]
CellResponse read_cell_response(TableReader& t, bool boxed);

/// Reads [[load]], the stages of the load path. @pre the scene has its law, its assembly and its box
/// @param unsaid  cell response of stages that do not give one, where the rest of the scene does not either
void read_load(TableReader& root, const CellResponse& unsaid, Scene& scene);

}  // namespace floc
