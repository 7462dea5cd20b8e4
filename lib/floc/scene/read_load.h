#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

inline constexpr NumberRule kCellMass{
    positive, "a positive number (mass of the cell's sides over the mass of all grains)"};
inline constexpr NumberRule kInertialNumberCap{
    positive, "a positive number (inertial number |L'/L| sqrt(m/P) of the sides L)"};
inline constexpr NumberRule kStrainRateCapRule{
    positive, "a positive number (strain rate |L'/L| of the sides L, in units of 1/T0 with T0 = sqrt(a m/F0))"};

/// Reads the cap on the strain rate of the cell: strain_rate_cap for grains that adhere, inertial_number_cap for
/// others, or neither.
CellResponse read_rate_caps(TableReader& t);

/// Reads how the cell, or the walls of a box, respond to their load in one part of a run: caps on the strain rate and
/// mass of the cell, or speed of the walls.
/// @param boxed  whether the scene has walls (table [box])
CellResponse read_cell_response(TableReader& t, bool boxed);

/// Reads the tables [[load]], which are the stages of the load path.
/// @param unsaid  default caps on the strain rate and default mass of the cell, for stages that do not give them, if
/// the rest of the scene does not give them either
/// @pre the tables [contact], [assembly] and [box] have been read
void read_load(TableReader& root, const CellResponse& unsaid, Scene& scene);

}  // namespace floc
