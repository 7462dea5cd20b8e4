#pragma once

#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

namespace floc {

/// Returns the largest gap or overlap of a contact that carries a force, over the diameter of its smaller grain, if the
/// scene does not give one: 1e-4 for disks and spheres, 1e-3 for grains with corners.
template <int Dim>
double default_gap_tolerance(const Packing<Dim>& packing);

/// Tests a state of rigid grains in motion (State::motion): whether the recorded forces are those of the time step that
/// begins at it. The criteria that differ from those of verify_rigid() are
///   geometry     as there, for the contact points within reach of the step
///   step         error of the recorded forces in Signorini's and Coulomb's conditions for the velocities at the end of
///                the step, over the mean normal force; these velocities are computed from the recorded ones and the forces
///   overlap      deepest overlap over the diameter of the smaller grain
/// @pre state.motion
template <int Dim>
std::vector<Criterion> verify_motion(const State<Dim>& state);

/// Tests whether a state of rigid grains is in equilibrium, or, if it is one of motion, calls verify_motion(). The forces of rigid contacts do not follow from positions:
/// the recorded forces are tested. In general they are one of many sets of forces that pass. The criteria, with the
/// unit of their values, are
///   geometry     largest difference between the stored gaps, normals and contact points and those that follow from
///                positions and shapes (length)
///   list         number of pairs of surfaces that overlap by more than `gap_tolerance` and are missing in the contact
///                list, plus number of contacts that are listed twice or out of order
///   law          largest difference between elastic forces and normal forces plus adhesion, over the mean normal
///                force; rigid contacts must have no stiffness and no moment, and forces that are tangential to them
///   cone         largest violation of F_N + F_a >= 0 and abs(F_T) <= mu (F_N + F_a), over the mean normal force, with
///                the adhesion F_a and the friction coefficient mu
///   gap          largest gap or overlap of a contact that carries a force, and largest overlap of any two surfaces,
///                over the diameter of the smaller grain
///   force, moment, stress, energy, mean_stress, length, boundary_balance, recorded   as in verify_equilibrium()
///   power        power that the contact forces feed into the recorded motion, over the unit of the energy criterion
///                for all grains per time T; 0 if they dissipate energy, and at rest. T = sqrt(m a/F1), with the mass m
///                and the diameter a of the largest grain and the force scale F1
/// The stability is not tested: rigid contacts have no stiffness.
/// @param gap_tolerance  limit of the criterion gap
template <int Dim>
std::vector<Criterion> verify_rigid(const State<Dim>& state, double gap_tolerance);

}  // namespace floc
