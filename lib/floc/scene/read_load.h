#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

inline constexpr NumberRule kCellMass{
    positive, "a positive number (mass of the cell's sides divided by the mass of all grains)"};

/// Condition for the factor by which springs are softened while grains rearrange.
inline constexpr NumberRule kSoftening{
    [](double x) { return x >= 1; },
    "a number >= 1 (factor by which the springs of contacts are softened while grains rearrange)"};
inline constexpr NumberRule kTimeStepOfStage{
    [](double x) { return x > 0 && x < kStableStepWithoutFriction; },
    "a number in (0, 0.8) (time step in units of sqrt(m_min/K) with the smallest mass m_min and the contact "
    "stiffness K; larger time steps are unstable)"};
inline constexpr NumberRule kInertialNumberCap{
    positive,
    "a positive number (inertial number |L'/L| sqrt(m/P) of a side L of the cell; largest mass m, pressure P)"};
inline constexpr NumberRule kStrainRateCapRule{positive,
                                               "a positive number (strain rate |L'/L| of a side L of the cell, "
                                               "in units of 1/T0; T0 = sqrt(a m/F0) with the "
                                               "largest diameter a, its mass m and the pull-off force F0)"};

/// Reads the cap on the rate at which the cell deforms: strain_rate_cap (for grains that adhere), inertial_number_cap
/// (for other grains), or neither.
/// @param t  table of the scene that has these keys
CellResponse read_rate_caps(TableReader& t);

/// Reads the keys that determine how the boundary responds to the load during the assembly or a stage of the load path.
/// For a periodic cell, these keys give the mass of the cell and a cap on its strain rate; for walls, they give the
/// speed of the walls.
/// @param t  table of the scene that has these keys
/// @param boxed  whether the scene has walls (table [box])
CellResponse read_cell_response(TableReader& t, bool boxed);

/// Reads the tables [[load]] of a scene; each table is a stage of the load path.
/// @param unsaid  default mass of the cell and default caps on its strain rate, for stages that do not give these
/// values. A value is absent if the table [cell] gives it.
/// @pre the tables [contact], [assembly] and [box] have been read
void read_load(TableReader& root, const CellResponse& unsaid, Scene& scene);

}  // namespace floc
