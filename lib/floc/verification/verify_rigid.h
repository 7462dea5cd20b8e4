#pragma once

#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Tests a state of rigid grains in motion (State::motion): whether the recorded forces are the forces of the time
/// step that begins at this state. The criteria that differ from the criteria of verify_rigid() are
///   geometry     as in verify_rigid(), but for the contact points within reach of the step
///   step         error of the recorded forces in Signorini's and Coulomb's conditions for the velocities at the end of
///                the step, divided by the mean normal force; these velocities are computed from the recorded velocities
///                and forces
///   overlap      deepest overlap divided by the diameter of the smaller grain
/// @pre state.motion
template <int Dim>
std::vector<Criterion> verify_motion(const State<Dim>& state);

/// Tests whether a state of rigid grains is in equilibrium; for a state in motion, calls verify_motion(). The forces of
/// rigid contacts do not follow from positions, so the recorded forces are tested. In general, more than one set of
/// forces satisfies the criteria. The criteria, with the unit of their values, are
///   geometry     largest difference between the stored gaps, normals and contact points and the values that follow from
///                positions and shapes (length)
///   list         number of pairs of surfaces that overlap by more than `gap_tolerance` and are missing in the contact
///                list, plus number of contacts that are listed twice or out of order
///   law          largest difference between the elastic force of a contact and its normal force plus adhesion, divided
///                by the mean normal force; rigid contacts must have no stiffness and no moment, and their shear forces
///                must be tangential
///   cone         largest violation of F_N + F_a >= 0 and abs(F_T) <= mu (F_N + F_a), divided by the mean normal force,
///                with the normal force F_N, the tangential force F_T, the adhesion F_a and the friction coefficient mu
///   gap          largest gap or overlap of a contact whose force is not zero, and largest overlap of any two surfaces,
///                divided by the diameter of the smaller grain
///   force, moment, stress, energy, mean_stress, length, boundary_balance, recorded   as in verify_equilibrium()
///   power        power of the contact forces on the recorded motion, divided by N F1 a/T, with the number N of grains,
///                the force scale F1, the largest diameter a and the time T = sqrt(m a/F1), where m is the largest
///                mass. The value is 0 at rest, and if the forces dissipate energy
/// The stability is not tested, because rigid contacts have no stiffness.
/// @param gap_tolerance  limit of the criterion gap
template <int Dim>
std::vector<Criterion> verify_rigid(const State<Dim>& state, double gap_tolerance);

}  // namespace floc
