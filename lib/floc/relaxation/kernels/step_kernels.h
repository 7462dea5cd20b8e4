#pragma once

#include <cstddef>

#include "floc/base/vec.h"
#include "floc/contact/history.h"
#include "floc/relaxation/instruction_set.h"

/// Data of the passes of a time step over all grains or pairs. They are plain arrays, since code compiled for
/// one instruction set must not share inline functions with the rest of the program.
namespace floc {

/// Number of grains in a block. All arrays of grains are padded to whole blocks.
inline constexpr int kGrainBlock = 64;
/// The pairs of a group of blocks are padded to a multiple of this.
inline constexpr int kPairPadding = 8;
/// Number of grains of a block that are summed side by side.
inline constexpr int kSumGroup = 8;

/// A dashpot acts with this share of its present force, and one minus this share of its force one step before.
/// Its velocities are those of half a step earlier, so that the force lags by kDashpotLag steps;
/// lagging_damping() corrects for that. In return it is stable up to a longer step: for (w dt)^2 + 2 (2 share -
/// 1) g dt < 4, if grains vibrate at the frequency w and are damped at the rate g.
inline constexpr double kDashpotShare = 0.8;
inline constexpr double kDashpotLag = 0.5 + (1.0 - kDashpotShare);

/// Content of the row of a pair besides the force on j.
enum class RowKind {
  forces,  ///< no moments: grains do not rotate
  levers,  ///< for spheres without rolling and twisting resistance: the moment of a unit arm and the lengths of
           ///< both arms, whose products are the moments on i and on j
  moments,  ///< the moments on i and on j
};

/// Layout of the row that a pair writes. Places are in doubles from the beginning of the row.
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
/// Place of the force in a row (in doubles).
template <int Dim>
constexpr int force_in_row(RowKind kind) {
  return kind == RowKind::moments ? RowLayout<Dim, RowKind::moments>::kForce : 0;
}
/// Doubles in the sum of a grain's rows: forces and moments, padded to whole vectors.
template <int Dim>
constexpr int row_sum_size(RowKind kind) {
  return (Dim == 2 ? 2 : 4) * (kind == RowKind::forces ? 1 : 2);
}

/// Count of numbers of an orientation: an angle in 2D, a quaternion (w, x, y, z) of any length in 3D.
template <int Dim>
inline constexpr int kOrientationNumbers = Dim == 2 ? 1 : 4;

/// Grains as kernels read them: pointers to the arrays of all grains.
template <int Dim>
struct GrainView {
  double *x[Dim], *v[Dim], *force[Dim];
  double *spin[kRotations<Dim>], *torque[kRotations<Dim>];
  double* orientation[kOrientationNumbers<Dim>];
  /// Bit mask of indices of `mass` to `inverse_inertia`: -1 if grains differ in mass or inertia; 0 if all are
  /// equal, so that every block reads the numbers of the first.
  int own_masses;
  const double *mass, *inverse_mass, *inertia, *inverse_inertia;
  const double* x_list[Dim];  ///< positions when the list was built
  const double*
      inverse_skin_squared;  ///< one over the squared distance that a grain may move before the next list
};

/// Pairs of all blocks as kernels read them: pointers to the arrays of all pairs, padded with pairs that do not
/// interact.
template <int Dim>
struct PairView {
  /// Indices of the grains. Those of i ascend, by less than kWindow within kPairPadding pairs. For pairs with
  /// walls, j is the index of the wall, and i may ascend by more.
  const int *i, *j;
  const float* image[Dim];  ///< image of j, in sides of the cell
  /// Bit mask of indices of `radii` to `reduced_mass`: -1 if every pair has its own numbers; 0 if all pairs
  /// have equal numbers, which are stored for one pack.
  int own_numbers;
  const double* radii;    ///< Ri + Rj
  const double* share_i;  ///< Ri/(Ri + Rj), lever arm of grain i over the branch
  const double* damping;
  /// Ri Rj/(Ri + Rj) and mi mj/(mi + mj), null where the law does not need them.
  const double *reduced_radius, *reduced_mass;
  const double *strength, *decay,
      *reach;       ///< parameters of liquid bridges (Bridge); null where the law has none
  double* viscous;  ///< dashpot forces of the step before; null without damping
  double* history[HistoryLayout<Dim>::kSize];  ///< history; null at places that the law does not use
  double* row;                                 ///< row of the pair `with_row`, followed by those of later pairs
  int with_row;
  RowKind rows;  ///< kind of the rows of pairs of grains, also used by pairs with walls
};

/// Rows that each grain of a block sums as the first, or as the second, grain of a pair. Rows are given by
/// their places from BlockSumsPlan::rows on, for each grain in ascending order of its pairs. Grains with
/// similar numbers of rows form groups of kSumGroup grains, which are summed side by side without branches to a
/// depth of the group: depth x kSumGroup places, where grains with fewer rows are filled up with a row that
/// stays zero. The rows of a grain beyond the depth of its group are summed alone.
struct SideSumsPlan {
  static constexpr int kGroups = kGrainBlock / kSumGroup;
  int grain[kGrainBlock];     ///< grains of the block (from its first), by falling number of rows
  int depth[kGroups];         ///< depth of each group
  int n_beyond[kGrainBlock];  ///< rows of the k-th of `grain` beyond the depth of its group
  int n_deep;                 ///< number of leading entries of `grain` that may have rows beyond
  const int* row;             ///< places of the rows group by group, then of the rows beyond grain by grain
};

struct BlockSumsPlan {
  SideSumsPlan as_i, as_j;
  const double* rows;
  int n_crossing;
  const int* crossing;  ///< pairs of the block whose branch crosses the boundary, ascending
};

/// Contribution of one block of grains to the sums over the packing.
template <int Dim>
struct alignas(64) BlockSums {
  double virial[Dim][Dim] = {};  ///< sum of force on j times branch; a triangular lattice has its upper part,
                                 ///< a rectangular one its diagonal
  double momentum_flux[Dim][Dim] = {};  ///< sum m v_a v_b, at the same places
  double rotation = 0.0;                ///< sum I w^2
  double next_speed_squared = 0.0;  ///< bound of the largest (|v| + |F half_step/m|)^2, in skins of the grain
};

/// Acceleration over half a step: v <- keep v + gain (half_step/m) F. The matrices here are upper triangular
/// (row, column), and diagonal for a rectangular lattice, whose kernels read only their diagonals.
template <int Dim>
struct Kick {
  double half_step;
  double keep[Dim][Dim], gain[Dim][Dim];
};

/// Stage of the rotation of the grains between two steps. Unlike velocities, spins do not depend on the motion
/// of the boundary. If no spins are needed at the end of a step, the half kick and the turn of the next step
/// are therefore made at once, so that each torque and spin is read only once.
enum class Rotation {
  at_end,    ///< at the end of the step, like positions and forces
  in_middle  ///< in the middle of the next step: the grains have been turned already
};

/// Drift over the whole step, after the kick: x <- stretch x + drift v.
template <int Dim>
struct Drift {
  double stretch[Dim][Dim], drift[Dim][Dim];
};

/// Walls as the kernels of pairs read them, one array entry per wall: the plane n . x = level, with n the unit
/// normal from the grains to the wall.
template <int Dim>
struct WallView {
  const double* normal[Dim];
  const double *level, *level_rate;
};

/// Boundary as the kernels of pairs read it.
template <int Dim>
struct PairCell {
  double lattice[Dim][Dim];      ///< columns are the lattice vectors
  double strain_rate[Dim][Dim];  ///< velocity gradient
  double slip_time;              ///< time over which the present velocities are added to the springs
  WallView<Dim> walls;           ///< null without walls
};

/// Passes of a time step, for one kernel law (kernel_law.h) and one instruction set.
template <int Dim>
struct StepKernels {
  /// Kicks a block of grains over half a step and moves it over a step.
  /// @param stands  stage of the rotation; at Rotation::in_middle, the grains are not turned again
  void (*kick_and_drift)(const GrainView<Dim>&, int first_grain, const Kick<Dim>&, const Drift<Dim>&,
                         Rotation stands);
  /// Square of the largest displacement of a block since the list was built, in skins of the grain.
  /// @param list_stretch  deformation of the lattice since then
  double (*motion_squared)(const GrainView<Dim>&, int first_grain, const double (&list_stretch)[Dim][Dim]);
  /// Computes rows and springs of the pairs [first, last).
  /// @param law  the kernel law, of the type of this table entry
  void (*compute_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                        const PairCell<Dim>&);
  /// Computes rows and springs of the pairs [first, last) of grains with walls; null where the kernel law is
  /// for pairs of grains only.
  void (*compute_wall_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                             const PairCell<Dim>&);
  /// Sums the rows of a block of grains and kicks it over half a step.
  /// @param to  stage at which the rotation is left; at Rotation::at_end the torques are stored, too
  void (*sum_and_kick)(const GrainView<Dim>&, const PairView<Dim>&, const BlockSumsPlan&, int first_grain,
                       const PairCell<Dim>&, const Kick<Dim>&, Rotation to, BlockSums<Dim>&);
};

/// Shape of the lattices that a kernel is for, chosen once per run. The general shape slows down laws without
/// friction by a tenth.
enum class LatticeShape { rectangular, triangular };

/// Returns the kernels of alternative `law_index` of AnyKernelLaw.
/// @pre supported(set)
template <int Dim>
const StepKernels<Dim>& step_kernels(InstructionSet set, LatticeShape shape, std::size_t law_index);

/// Tables of step_kernels(), one per translation unit of an instruction set and dimension.
template <int Dim>
const StepKernels<Dim>* step_kernels_portable(LatticeShape shape);
template <int Dim>
const StepKernels<Dim>* step_kernels_avx2(LatticeShape shape);
template <int Dim>
const StepKernels<Dim>* step_kernels_avx512(LatticeShape shape);

}  // namespace floc
