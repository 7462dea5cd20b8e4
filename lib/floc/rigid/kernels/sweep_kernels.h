#pragma once

#include "floc/base/instruction_set.h"
#include "floc/rigid/kernels/contact_groups.h"

/// Kernels: the loops of a sweep over groups of contacts, compiled for several instruction sets. All instruction sets
/// give bitwise identical results. The data are plain arrays and not containers: code compiled for one instruction set
/// must not share inline functions with the rest of the program.
namespace floc {

/// Values that a sweep reads.
struct SweepStart {
  const double* stretch;  ///< rate of stretch of the cell, one component for each axis (1/time)
  double share;           ///< share of the last change that is added to the impulses before they are solved
  /// Whether the sweep goes over all groups, also over idle ones. It then finds which groups are idle.
  bool over_all;
};

/// Sums over the contacts of some groups in a sweep.
struct GroupSums {
  /// for each axis a of space, the sum of r_a (F p)_a with the branch vector r, the frame F and the change p of the
  /// impulse
  double gain[3];
  double change;  ///< sum of the squares of the changes of the impulses
};

/// For the contacts of some groups: the largest contact_error(), the sum of the normal impulses, and the number of
/// nonzero normal impulses. The error is computed with the response that the sweeps use.
struct GroupErrors {
  double worst, sum, n;
};

/// Kernels for the groups of one model. The argument `bodies` points to the rows of all bodies (BodyRow).
template <class Group>
struct SweepKernels {
  /// Extrapolates the impulses of n groups and solves their contacts. Adds the changes of the impulses to the motion of
  /// the bodies.
  void (*solve)(Group* groups, int n, double* bodies, const SweepStart& start, GroupSums& sums);
  GroupErrors (*errors)(const Group* groups, int n, const double* bodies, const double* stretch);
  /// Extrapolates the motion of n bodies. The arrays `start` and `earlier_start` contain the first BodyRow::kMotion
  /// doubles of the row of each body at the start of the last sweep and of the sweep before.
  void (*extrapolate)(double* bodies, double* start, double* earlier_start, int n, double share);
};

/// Returns the kernels for an instruction set.
/// @pre supported(set)
template <class Group>
const SweepKernels<Group>& sweep_kernels(InstructionSet set);

template <class Group>
const SweepKernels<Group>& sweep_kernels_portable();
template <class Group>
const SweepKernels<Group>& sweep_kernels_avx2();
template <class Group>
const SweepKernels<Group>& sweep_kernels_avx512();

}  // namespace floc
