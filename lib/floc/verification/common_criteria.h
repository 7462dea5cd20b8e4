#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/state.h"
#include "floc/verification/verification.h"

/// Criteria that verify_equilibrium() (for elastic grains) and verify_rigid() (for rigid grains) have in common. The
/// argument `recomputed` is the packing of the state with recomputed contacts, and `stress` is the static_stress() of
/// this packing.
namespace floc {

/// Returns a bound (force) on the error of a contact force due to the rounding of the positions.
template <int Dim>
double force_error(const Packing<Dim>& packing);

/// Adds the criteria force, moment, stress and energy: the residuals must be below the tolerances of the state.
/// @param motion  text about moving grains, which becomes part of the criterion energy if the kinetic energy is too
/// large
template <int Dim>
void add_residuals(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress,
                   const std::string& motion, std::vector<Criterion>& criteria);

/// Adds the criterion length if lengths are imposed. The criterion compares the lengths of the axes of the cell, and
/// the offset of a sheared lattice vector, with the imposed values. Only rounding errors are accepted, because the
/// motion of the cell ends exactly at the imposed values.
template <int Dim>
void add_lengths(const State<Dim>& state, std::vector<Criterion>& criteria);

/// Compares the recorded stress with the stress that follows from the recomputed forces. The difference is divided by
/// the mean stress.
template <int Dim>
Criterion check_recorded_stress(const State<Dim>& state, const Packing<Dim>& recomputed,
                                const Mat<Dim>& stress);

/// Compares the stress computed from the forces across the faces of the cell with the stress of all contacts. Net
/// forces on grains cause a part of the difference (see boundary_stress()). Only the part that net forces within their
/// tolerance can cause is accepted, because a packing with larger net forces is not in equilibrium.
template <int Dim>
Criterion check_boundary(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress);

/// Compares the recorded residuals, number of negative eigenvalues, worst grains, flags, wall forces and orientations
/// with the values that follow from the recomputed forces.
/// @param n_negative  number of negative eigenvalues of the stiffness matrix; absent if it was not computed
template <int Dim>
Criterion check_record(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress,
                       const std::optional<int>& n_negative);

}  // namespace floc
