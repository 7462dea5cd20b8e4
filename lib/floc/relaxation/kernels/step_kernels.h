#pragma once

#include <cstddef>

#include "floc/base/vec.h"
#include "floc/contact/history.h"
#include "floc/relaxation/instruction_set.h"

/// Data of the kernels, the compiled loops over all grains or all pairs in a time step. The data are plain arrays,
/// because code compiled for one instruction set must not share inline functions with the rest of the program.
namespace floc {

/// Number of grains in a block, the unit of work of the passes over grains. All arrays of grains are padded to whole
/// blocks.
inline constexpr int kGrainBlock = 64;
/// The pairs of each group of blocks of grains are padded to a multiple of this number, so that they fill whole vector
/// registers.
inline constexpr int kPairPadding = 8;
/// Number of grains for which a kernel sums the forces side by side, in independent chains of additions.
inline constexpr int kSumGroup = 8;

/// The dashpot force that acts in a time step is a weighted mean of the dashpot forces computed in this step (weight
/// kDashpotShare) and in the previous step (weight 1 - kDashpotShare). If grains vibrate at the frequency w and are
/// damped at the rate g, time steps dt with (w dt)^2 + 2 (2 kDashpotShare - 1) g dt < 4 are stable. The weighted mean
/// thus allows longer steps. The dashpot force of a step is computed with the velocities of half a step earlier. The
/// acting force therefore lags by kDashpotLag steps in total; lagging_damping() corrects the damping coefficient for
/// this lag.
inline constexpr double kDashpotShare = 0.8;
inline constexpr double kDashpotLag = 0.5 + (1.0 - kDashpotShare);

/// Kind of the row that the force kernel writes for each pair. A row consists of the force on the second grain j and,
/// depending on the kind, of the moments on both grains i and j, as consecutive doubles.
enum class RowKind {
  forces,  ///< the row of a pair holds no moments: grains do not rotate
  /// The row of a pair of spheres without rolling and twisting resistance: it holds the moment of the tangential force
  /// for a lever arm of unit length, and the lengths of the lever arms of i and j, by which that moment is multiplied.
  levers,
  moments,  ///< the row of a pair holds the moments on i and on j
};

/// Layout of the row of a pair (force and moments): its size and the places of its components, in doubles from the
/// beginning of the row.
template <int Dim, RowKind kKind>
struct RowLayout;
template <>
struct RowLayout<2, RowKind::forces> {
  static constexpr int kSize = 2, kForce = 0;
};
template <>
struct RowLayout<2, RowKind::moments> {
  static constexpr int kSize = 4, kForce = 0, kMomentI = 2, kMomentJ = 3;
};
template <>
struct RowLayout<3, RowKind::forces> {
  static constexpr int kSize = 4, kForce = 0;
};
template <>
struct RowLayout<3, RowKind::levers> {
  static constexpr int kSize = 8, kForce = 0, kArmI = 3, kUnitMoment = 4, kArmJ = 7;
};
template <>
struct RowLayout<3, RowKind::moments> {
  static constexpr int kSize = 10, kMomentI = 0, kForce = 3, kMomentJ = 6;
};

template <class Law, int Dim>
inline constexpr RowKind kRowKind = !Law::kHasFriction                                    ? RowKind::forces
                                    : Dim == 3 && !Law::kHasRolling && !Law::kHasTwisting ? RowKind::levers
                                                                                          : RowKind::moments;
template <int Dim>
constexpr int row_size(RowKind kind) {
  if (kind == RowKind::levers) return RowLayout<3, RowKind::levers>::kSize;
  return kind == RowKind::forces ? RowLayout<Dim, RowKind::forces>::kSize
                                 : RowLayout<Dim, RowKind::moments>::kSize;
}
/// Returns the place of the force in the row of a pair, in doubles from the beginning of the row.
template <int Dim>
constexpr int force_in_row(RowKind kind) {
  return kind == RowKind::moments ? RowLayout<Dim, RowKind::moments>::kForce : 0;
}
/// Returns the number of doubles in the sum of the rows of all pairs of a grain: forces and moments, padded to whole
/// vector registers.
template <int Dim>
constexpr int row_sum_size(RowKind kind) {
  return (Dim == 2 ? 2 : 4) * (kind == RowKind::forces ? 1 : 2);
}

/// Number of components of an orientation: one in 2D (an angle), four in 3D (a quaternion (w, x, y, z) of any length).
template <int Dim>
inline constexpr int kOrientationNumbers = Dim == 2 ? 1 : 4;

/// Grains in the form that kernels read: pointers to the arrays of all grains.
template <int Dim>
struct GrainView {
  double *x[Dim], *v[Dim], *force[Dim];
  double *spin[kRotations<Dim>], *torque[kRotations<Dim>];
  double* orientation[kOrientationNumbers<Dim>];
  /// Bit mask applied to the index of a block before `mass`, `inverse_mass`, `inertia` and `inverse_inertia` are read:
  /// -1 if grains differ in mass or moment of inertia; 0 if all grains are equal, so that every block reads the numbers
  /// of the first block.
  int own_masses;
  const double *mass, *inverse_mass, *inertia, *inverse_inertia;
  const double* x_list[Dim];  ///< positions of the grains when the neighbour lists were built (length)
  /// One over the square of the distance (skin) that each grain may move before new neighbour lists are built
  /// (1/length^2).
  const double* inverse_skin_squared;
};

/// Pairs of all blocks in the form that kernels read: pointers to the arrays of all pairs, which are padded with pairs
/// that do not interact.
template <int Dim>
struct PairView {
  /// Indices of the two grains of each pair. The indices i ascend, and within kPairPadding consecutive pairs they
  /// differ by less than kWindow. For pairs with walls, j is the index of the wall, and the indices i may differ by
  /// more.
  const int *i, *j;
  const float* image[Dim];  ///< periodic image of j, as a whole number of each lattice vector
  /// Bit mask applied to the index of a pair before the arrays from `radii` to `reduced_mass` are read: -1 if every
  /// pair has its own entries; 0 if all pairs have equal entries, which are stored only once, for one pack of pairs (as
  /// many as fit a vector register).
  int own_numbers;
  const double* radii;    ///< Ri + Rj, sum of the radii of grains i and j (length)
  const double* share_i;  ///< Ri/(Ri + Rj), lever arm of grain i divided by the distance of the centres
  const double* damping;
  /// Reduced radius Ri Rj/(Ri + Rj) and reduced mass mi mj/(mi + mj) of each pair; null if the contact law does not
  /// need them.
  const double *reduced_radius, *reduced_mass;
  /// Parameters of the liquid bridge of each pair (struct Bridge); null if the contact law has no liquid.
  const double *strength, *decay, *reach;
  double* viscous;  ///< dashpot forces of the previous step (force); null without damping
  /// History variables of the contacts; null for variables that the contact law does not use.
  double* history[HistoryLayout<Dim>::kSize];
  double*
      row;  ///< row (force and moments) of the pair with index `with_row`, followed by the rows of later pairs
  int with_row;
  /// Kind of the rows of all pairs, which follows from the law between grains; pairs with walls write rows of this
  /// kind, too.
  RowKind rows;
};

/// Plan by which rows (force and moments of a pair) are summed for each grain of a block: the rows of the pairs in
/// which it is the first grain, or of the pairs in which it is the second grain. A row is given by its place, in
/// doubles from BlockSumsPlan::rows on; the rows of a grain are in the order of its pairs.
/// 1. Grains with similar numbers of rows form groups of kSumGroup grains. The sums of a group are computed side by
/// side, without branches, up to a number of rows per grain called the depth of the group. The plan lists depth x
/// kSumGroup places for the group; where a grain has too few rows, it lists the place of a row that stays zero.
/// 2. If a grain has more rows than the depth of its group, its remaining rows are added afterwards, one by one.
struct SideSumsPlan {
  static constexpr int kGroups = kGrainBlock / kSumGroup;
  /// Indices of the grains, counted from the first grain of the block, in the order of falling numbers of pairs.
  int grain[kGrainBlock];
  /// Depth of each group: number of pairs per grain whose rows are summed side by side.
  int depth[kGroups];
  /// Number of pairs of grain[k] beyond the depth of its group, whose rows are added one by one.
  int n_beyond[kGrainBlock];
  int n_deep;  ///< number of leading entries of `grain` that may have pairs beyond the depth of their group
  /// Places of the rows (forces and moments) of the pairs up to the depth of each group, group by group, followed by
  /// the places of the rows beyond the depth, grain by grain.
  const int* row;
};

struct BlockSumsPlan {
  SideSumsPlan as_i, as_j;
  const double* rows;
  int n_crossing;
  /// Indices of the pairs of the block whose grains are joined across the periodic boundary, ascending.
  const int* crossing;
};

/// Contribution of one block of grains to sums over the whole packing.
template <int Dim>
struct alignas(64) BlockSums {
  /// Sum over the pairs of the force on the second grain j times the branch vector from i to j (energy). For a
  /// triangular lattice only the upper part of the matrix is set, for a rectangular lattice only the diagonal.
  double virial[Dim][Dim] = {};
  /// Sum over the grains of m v_a v_b, with mass m and velocity v (energy); the components that are set in `virial` are
  /// set here, too.
  double momentum_flux[Dim][Dim] = {};
  double rotation = 0.0;  ///< sum over the grains of I w^2, with moment of inertia I and spin w (energy)
  /// Upper bound, over the grains of the block, of the squared speed after the next kick, (|v| + |F half_step/m|)^2,
  /// with the velocity v, force F and mass m of the grain. Each speed is divided by the skin of the grain, the distance
  /// that it may move before new neighbour lists are built.
  double next_speed_squared = 0.0;
};

/// Acceleration of the grains over half a time step: v <- keep v + gain (half_step/m) F, with the velocity v, force F
/// and mass m of a grain. The matrices `keep` and `gain` are upper triangular (indices: row, column). For a rectangular
/// lattice they are diagonal, and kernels for rectangular lattices read only their diagonals.
template <int Dim>
struct Kick {
  double half_step;
  double keep[Dim][Dim], gain[Dim][Dim];
};

/// Stage of the time integration at which the rotation of the grains stands between two time steps. Unlike velocities,
/// spins do not depend on the motion of the boundary, so they may be advanced early: if no spins are needed at the end
/// of a step, the next half kick of the spins and the next rotation of the grains are made in that step. Each torque
/// and spin is then read only once per step.
enum class Rotation {
  at_end,  ///< spins are those at the end of the step, like positions and forces
  /// Spins are those in the middle of the next step: the next half kick of the spins and the next rotation of the
  /// grains have been made already.
  in_middle
};

/// Change of the positions of the grains over a whole time step, after their kick: x <- stretch x + drift v, with the
/// position x and velocity v of a grain. The matrices are upper triangular, and diagonal for a rectangular lattice.
template <int Dim>
struct Drift {
  double stretch[Dim][Dim], drift[Dim][Dim];
};

/// Walls in the form that force kernels read, with one array entry per wall. A wall is the plane n . x = level, where n
/// is its unit normal, which points from the grains to the wall.
template <int Dim>
struct WallView {
  const double* normal[Dim];
  const double *level, *level_rate;
};

/// Boundary of the packing (lattice and walls) in the form that force kernels read.
template <int Dim>
struct PairCell {
  double lattice[Dim][Dim];      ///< lattice matrix, whose columns are the lattice vectors (length)
  double strain_rate[Dim][Dim];  ///< velocity gradient of the lattice (1/time)
  double slip_time;     ///< time over which the present relative velocities stretch contact springs (time)
  WallView<Dim> walls;  ///< pointers to the arrays of the walls; null if there are none
};

/// Kernels (compiled loops over grains or pairs) for one kernel law (contact law for which kernels are compiled,
/// kernel_law.h) and one instruction set.
template <int Dim>
struct StepKernels {
  /// Kicks a block of grains over half a step and moves it over a step.
  /// @param stands  stage (Rotation) at which the previous step has left the rotation of the grains; at
  /// Rotation::in_middle, the grains have been turned already and are not turned again
  void (*kick_and_drift)(const GrainView<Dim>&, int first_grain, const Kick<Dim>&, const Drift<Dim>&,
                         Rotation stands);
  /// Returns the square of the largest displacement of a grain of a block since the neighbour lists were built, where
  /// the displacement of each grain is divided by its skin (distance that it may move before new lists are built).
  /// @param list_stretch  deformation gradient of the lattice since the neighbour lists were built
  double (*motion_squared)(const GrainView<Dim>&, int first_grain, const double (&list_stretch)[Dim][Dim]);
  /// Computes the rows (forces and moments) of the pairs of grains [first, last) and updates their springs.
  /// @param law  address of the contact law of this kernel, which must be of the type for which this kernel is compiled
  void (*compute_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                        const PairCell<Dim>&);
  /// Computes the rows (forces and moments) of the pairs [first, last) of grains with walls and updates their springs;
  /// null if the kernel law (kernel_law.h) serves pairs of grains only.
  void (*compute_wall_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                             const PairCell<Dim>&);
  /// Sums the rows (forces and moments) of the pairs of each grain of a block, and kicks the grains over half a step.
  /// @param to  stage (Rotation) at which the rotation of the grains is left; at Rotation::at_end the torques are
  /// stored, too
  void (*sum_and_kick)(const GrainView<Dim>&, const PairView<Dim>&, const BlockSumsPlan&, int first_grain,
                       const PairCell<Dim>&, const Kick<Dim>&, Rotation to, BlockSums<Dim>&);
};

/// Shape of the lattice for which a kernel is compiled; the shape is chosen once per run. Kernels for the general,
/// triangular shape are slower by a tenth for laws without friction.
enum class LatticeShape { rectangular, triangular };

/// Returns the kernels for the contact law with index `law_index` in AnyKernelLaw.
/// @pre supported(set)
template <int Dim>
const StepKernels<Dim>& step_kernels(InstructionSet set, LatticeShape shape, std::size_t law_index);

/// Functions that return the table of kernels from which step_kernels() chooses, one function for each instruction set.
/// Each function is compiled in one translation unit per dimension.
template <int Dim>
const StepKernels<Dim>* step_kernels_portable(LatticeShape shape);
template <int Dim>
const StepKernels<Dim>* step_kernels_avx2(LatticeShape shape);
template <int Dim>
const StepKernels<Dim>* step_kernels_avx512(LatticeShape shape);

}  // namespace floc
