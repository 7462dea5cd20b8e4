#pragma once

#include <cstddef>

#include "floc/base/instruction_set.h"
#include "floc/base/vec.h"
#include "floc/contact/history.h"

/// Data of the kernels, the compiled loops over all grains or all pairs in a time step. The data are plain arrays and
/// not containers: code compiled for one instruction set must not share inline functions with the rest of the program.
namespace floc {

/// Number of grains in a block, the unit of work of the passes over grains. All arrays of grains are padded to whole
/// blocks.
inline constexpr int kGrainBlock = 64;
/// The pairs of each group of blocks of grains are padded to a multiple of this number, so that the pairs fill whole
/// vector registers.
inline constexpr int kPairPadding = 8;
/// Number of grains for which a kernel sums the forces side by side, in independent chains of additions.
inline constexpr int kSumGroup = 8;

/// The dashpot force that acts in a time step is a weighted mean of the dashpot forces computed in this step (weight
/// kDashpotShare) and in the previous step (weight 1 - kDashpotShare). If grains vibrate at the frequency w and are
/// damped at the rate g, time steps dt with (w dt)^2 + 2 (2 kDashpotShare - 1) g dt < 4 are stable, so the weighted
/// mean allows longer steps. The computed dashpot force belongs to the velocities of half a step earlier. With the lag
/// of the weighted mean, the acting force lags by kDashpotLag steps; lagging_damping() corrects the damping coefficient
/// for this lag.
inline constexpr double kDashpotShare = 0.8;
inline constexpr double kDashpotLag = 0.5 + (1.0 - kDashpotShare);

/// Kind of the rows that force kernels write. The row of a pair consists of consecutive doubles: the force on the
/// second grain j and, depending on the kind, the moments on the grains i and j.
enum class RowKind {
  forces,  ///< rows without moments, for grains that do not rotate
  /// rows of spheres without rolling and twisting resistance. Such a row contains the moment that the tangential force
  /// would have with a lever arm of unit length, and the lengths of the lever arms of i and j. The moment on a grain is
  /// the product of this moment and the length of the lever arm of the grain.
  levers,
  moments,  ///< rows with the moment on i and the moment on j
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
/// Returns the offset of the force from the beginning of the row of a pair, counted in doubles.
template <int Dim>
constexpr int force_in_row(RowKind kind) {
  return kind == RowKind::moments ? RowLayout<Dim, RowKind::moments>::kForce : 0;
}
/// Returns the number of doubles in a sum of rows over the pairs of a grain. The sum contains force and moment and is
/// padded to whole vector registers.
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
  /// -1 if grains differ in mass or moment of inertia; 0 if all grains are equal, so that the values of the first block
  /// are read for every block.
  int own_masses;
  const double *mass, *inverse_mass, *inertia, *inverse_inertia;
  const double* x_list[Dim];  ///< positions of the grains when the neighbour lists were built (length)
  /// The number 1/s^2 for each grain, where s is its skin: the distance that the grain may move before new neighbour
  /// lists are built (1/length^2).
  const double* inverse_skin_squared;
};

/// Pairs of all blocks in the form that kernels read: pointers to the arrays of all pairs. The arrays are padded with
/// pairs that do not interact.
template <int Dim>
struct PairView {
  /// Indices of the two grains of each pair. The indices i ascend. Within kPairPadding consecutive pairs of grains, the
  /// indices i differ by less than kWindow; for pairs with walls, the indices i may differ by more. For pairs with
  /// walls, j is the index of the wall.
  const int *i, *j;
  const float* image[Dim];  ///< periodic image of j: number of lattice vectors along each axis (whole numbers)
  /// Bit mask applied to the index of a pair before the arrays from `radii` to `reduced_mass` are read: -1 if every
  /// pair has its own entries; 0 if all pairs have equal entries. Equal entries are stored for one pack of pairs only
  /// (as many as fit a vector register).
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
  /// Kind of the rows of all pairs. The law between grains determines the kind, and the rows of pairs with walls have
  /// this kind, too.
  RowKind rows;
};

/// Plan by which the rows (force and moments) of the pairs of each grain of a block are summed. There is one plan for
/// the pairs in which the grain is the first grain, and one for the pairs in which it is the second grain. A row is
/// given by its place, that is, by the number of doubles from BlockSumsPlan::rows to its beginning. The rows of a grain
/// are in the order of its pairs.
/// 1. Grains with similar numbers of rows form groups of kSumGroup grains. The depth of a group is a number of rows per
/// grain: up to this number, the sums of the group are computed side by side, without branches. The plan lists depth x
/// kSumGroup places for a group; for missing rows of a grain, it lists the place of a row that stays zero.
/// 2. If a grain has more rows than the depth of its group, its remaining rows are added afterwards, one by one.
struct SideSumsPlan {
  static constexpr int kGroups = kGrainBlock / kSumGroup;
  /// Indices of the grains, counted from the first grain of the block. The grain with the most pairs comes first.
  int grain[kGrainBlock];
  /// Depth of each group: number of pairs per grain whose rows are summed side by side.
  int depth[kGroups];
  /// Number of rows of grain[k] beyond the depth of its group; they are added one by one.
  int n_beyond[kGrainBlock];
  /// number of entries of `grain` from the first to the last grain with rows beyond the depth of its group
  int n_deep;
  /// Places of the rows (forces and moments) of the pairs up to the depth of each group, group by group, followed by
  /// the places of the rows beyond the depth, grain by grain.
  const int* row;
};

struct BlockSumsPlan {
  SideSumsPlan as_i, as_j;
  const double* rows;
  int n_crossing;
  /// Indices of the pairs of the block that interact across the periodic boundary, in ascending order.
  const int* crossing;
};

/// Sums over the grains and pairs of one block of grains, from which the sums over the whole packing are computed.
template <int Dim>
struct alignas(64) BlockSums {
  /// Sum over the pairs of the force on the second grain j times the branch vector from i to j (energy). For a
  /// triangular lattice only the upper part of the matrix is set, for a rectangular lattice only the diagonal.
  double virial[Dim][Dim] = {};
  /// Sum over the grains of m v_a v_b, with mass m and velocity v (energy). The components that are not set in
  /// `virial` are not set here either.
  double momentum_flux[Dim][Dim] = {};
  double rotation = 0.0;  ///< sum over the grains of I w^2, with moment of inertia I and spin w (energy)
  /// Upper bound of (|v| + |F half_step/m|)^2/s^2 over the grains of the block, with the velocity v, force F, mass m
  /// and skin s of a grain. This value limits the speeds after the next kick. The skin is the distance that a grain may
  /// move before new neighbour lists are built.
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

/// Stage of the time integration that the rotation of the grains has reached between two time steps. Unlike velocities,
/// spins do not depend on the motion of the boundary, so spins may be advanced early. If no spins are needed at the end
/// of a step, this step also makes the next half kick of the spins and the next rotation of the grains. Each torque and
/// spin is then read only once per step.
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

/// Walls in the form that force kernels read, with one array entry per wall. A wall is the plane n . x = level; its
/// unit normal n points from the grains to the wall.
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
  /// time over which contact springs are stretched at the present relative velocities (time)
  double slip_time;
  WallView<Dim> walls;  ///< pointers to the arrays of the walls; null if there are none
};

/// Kernels, the compiled loops over grains or pairs, for one kernel law (kernel_law.h) and one instruction set.
template <int Dim>
struct StepKernels {
  /// Kicks a block of grains over half a step and moves the grains over a whole step.
  /// @param stands  stage (Rotation) that the rotation of the grains has reached in the previous step; at
  /// Rotation::in_middle, the grains have already been turned and are not turned again
  void (*kick_and_drift)(const GrainView<Dim>&, int first_grain, const Kick<Dim>&, const Drift<Dim>&,
                         Rotation stands);
  /// Returns the largest value of d^2/s^2 over the grains of a block, where d is the displacement of a grain since the
  /// neighbour lists were built, and s its skin (distance that the grain may move before new lists are built).
  /// @param list_stretch  deformation gradient of the lattice since the neighbour lists were built
  double (*motion_squared)(const GrainView<Dim>&, int first_grain, const double (&list_stretch)[Dim][Dim]);
  /// Computes the rows (forces and moments) of the pairs of grains with indices from `first` to `last` - 1, and updates
  /// the springs of these pairs.
  /// @param law  address of a contact law of the type for which this kernel is compiled
  void (*compute_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                        const PairCell<Dim>&);
  /// Like compute_pairs, but for pairs of grains with walls; null if the kernel law (kernel_law.h) is only for pairs of
  /// grains.
  void (*compute_wall_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                             const PairCell<Dim>&);
  /// Sums the rows (forces and moments) of the pairs of each grain of a block, and kicks the grains over half a step.
  /// @param to  stage (Rotation) that the rotation of the grains has to reach; for Rotation::at_end, the torques are
  /// stored, too
  void (*sum_and_kick)(const GrainView<Dim>&, const PairView<Dim>&, const BlockSumsPlan&, int first_grain,
                       const PairCell<Dim>&, const Kick<Dim>&, Rotation to, BlockSums<Dim>&);
};

/// Shape of the lattice for which a kernel is compiled; the shape is chosen once per run. Kernels for the triangular
/// shape work for every lattice, but they are slower by a tenth if the law has no friction.
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
