#pragma once

#include <cstddef>

#include "floc/base/vec.h"
#include "floc/contact/history.h"
#include "floc/relaxation/instruction_set.h"

/// Data of those parts of a time step that visit every grain or pair, as plain arrays: code compiled for one
/// instruction set must not share inline functions with the rest of the program.
namespace floc {

/// Grains that a block owns; all arrays of grains are padded to whole blocks.
inline constexpr int kGrainBlock = 64;
/// The pairs of a group of blocks are padded to a multiple of this.
inline constexpr int kPairPadding = 8;
/// Grains of a block that are summed side by side.
inline constexpr int kSumGroup = 8;

/// A dashpot acts with this share of its present force and the rest of its force one step before. The
/// velocities it acts on are those of half a step earlier, so that it lags by kDashpotLag steps
/// (lagging_damping() corrects that), but is stable to a longer step: where grains vibrate at w and are damped
/// at g, for (w dt)^2 + 2 (2 share - 1) g dt < 4.
inline constexpr double kDashpotShare = 0.8;
inline constexpr double kDashpotLag = 0.5 + (1.0 - kDashpotShare);

/// What the row of a pair holds besides the force on j.
enum class RowKind {
  forces,   ///< nothing: grains do not rotate
  levers,   ///< of spheres that neither roll nor twist against each other: both moments are that of one arm's
            ///< length times the arm, whose lengths follow
  moments,  ///< the moments on i and on j
};

/// Row that a pair writes. Places are in doubles from its beginning.
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
/// Place of the force in a row.
template <int Dim>
constexpr int force_in_row(RowKind kind) {
  return kind == RowKind::moments ? RowLayout<Dim, RowKind::moments>::kForce : 0;
}
/// Doubles in the sum of a grain's rows: forces, moments and what pads them to whole vectors.
template <int Dim>
constexpr int row_sum_size(RowKind kind) {
  return (Dim == 2 ? 2 : 4) * (kind == RowKind::forces ? 1 : 2);
}

/// Numbers of an orientation: an angle, or a quaternion (w, x, y, z) whose length does not matter.
template <int Dim>
inline constexpr int kOrientationNumbers = Dim == 2 ? 1 : 4;

/// The grains as kernels receive them: pointers to the arrays of all grains.
template <int Dim>
struct GrainView {
  double *x[Dim], *v[Dim], *force[Dim];
  double *spin[kRotations<Dim>], *torque[kRotations<Dim>];
  double* orientation[kOrientationNumbers<Dim>];
  /// -1 where grains differ in mass or inertia; 0 where they do not, and the first block's numbers are those of
  /// all.
  int own_masses;
  const double *mass, *inverse_mass, *inertia, *inverse_inertia;
  const double* x_list[Dim];           ///< positions when the list was built
  const double* inverse_skin_squared;  ///< of the distances that grains may move before the next list
};

/// The pairs of all blocks, likewise, with padding by pairs that do not interact.
template <int Dim>
struct PairView {
  /// Grains; those of i ascend, by less than kWindow in kPairPadding pairs. For pairs with walls, j is the
  /// wall's number, and i may leap.
  const int *i, *j;
  const float* image[Dim];  ///< in sides of the cell
  /// -1 where every pair has numbers of its own from `radii` to `reduced_mass`; 0 where they are the same for all
  /// pairs, and stand there for one pack.
  int own_numbers;
  const double* radii;    ///< Ri + Rj
  const double* share_i;  ///< Ri/(Ri + Rj): share of the branch that is grain i's lever arm
  const double* damping;
  /// Ri Rj/(Ri + Rj) and mi mj/(mi + mj), null where the law does not need them.
  const double *reduced_radius, *reduced_mass;
  const double *strength, *decay, *reach;  ///< of liquid bridges (Bridge), null where the law has none
  double* viscous;                         ///< dashpot forces of the step before, null where the law has none
  double* history[HistoryLayout<Dim>::kSize];  ///< what the law remembers; null at places of which it does not
  double* row;                                 ///< of the pair with_row and of those after it
  int with_row;
  RowKind rows;  ///< of pairs of grains, to which those with walls are added
};

/// The rows that each grain of a block sums as the first, or as the second, grain of a pair: places from
/// BlockSumsPlan::rows on, for each grain in ascending order of its pairs. Grains with similar numbers of rows stand
/// side by side in groups, which are summed without branches to a depth of their own: depth x kSumGroup places,
/// those of a grain with fewer rows filled up with the row that stays zero. The rows of a grain beyond the
/// depth of its group follow on their own.
struct SideSumsPlan {
  static constexpr int kGroups = kGrainBlock / kSumGroup;
  int grain[kGrainBlock];     ///< grains of the block (from its first), by falling number of rows
  int depth[kGroups];         ///< of each group
  int n_beyond[kGrainBlock];  ///< rows of the k-th of `grain` beyond the depth of its group
  int n_deep;                 ///< leading grains of `grain`, after which none has rows beyond
  const int* row;             ///< of group after group, then those beyond of grain after grain
};

struct BlockSumsPlan {
  SideSumsPlan as_i, as_j;
  const double* rows;
  int n_crossing;
  const int* crossing;  ///< pairs of the block whose branch crosses the boundary, ascending
};

/// What one block of grains adds to the sums over the packing.
template <int Dim>
struct alignas(64) BlockSums {
  double virial[Dim][Dim] = {};  ///< sum of force on j times branch; a triangular lattice has its upper part,
                                 ///< a rectangular one its diagonal
  double momentum_flux[Dim][Dim] = {};  ///< sum m v_a v_b, likewise
  double rotation = 0.0;                ///< sum I w^2
  double next_speed_squared = 0.0;      ///< bound of the largest |v| + |F half_step/m|, in skins of the grain
};

/// Half a step of acceleration: v <- keep v + gain (half_step/m) F. The matrices here are upper triangular
/// (row, column), and diagonal for a rectangular lattice, whose kernels read their diagonals alone.
template <int Dim>
struct Kick {
  double half_step;
  double keep[Dim][Dim], gain[Dim][Dim];
};

/// Where the rotation of the grains stands between two steps. Unlike the velocities it does not wait for the
/// boundary: where nothing asks for spins at the end of a step, the next step's half kick and turn follow at once,
/// and each torque and spin is read a single time.
enum class Rotation {
  at_end,    ///< of the step, as positions and forces do
  in_middle  ///< of the next step, which has turned the grains already
};

/// A drift x <- stretch x + drift v of the whole step after the kick.
template <int Dim>
struct Drift {
  double stretch[Dim][Dim], drift[Dim][Dim];
};

/// Walls as pairs see them, one array entry per wall: the plane n x = level, n the unit normal from the grains
/// to it.
template <int Dim>
struct WallView {
  const double* normal[Dim];
  const double *level, *level_rate;
};

/// The boundary as pairs see it.
template <int Dim>
struct PairCell {
  double lattice[Dim][Dim];      ///< columns are the lattice vectors
  double strain_rate[Dim][Dim];  ///< velocity gradient
  double slip_time;              ///< time over which the springs take up the present velocities
  WallView<Dim> walls;           ///< null without walls
};

/// The passes of a time step, for one kernel law (kernel_law.h) and one instruction set.
template <int Dim>
struct StepKernels {
  /// @param stands  of the rotation: where it is in the middle of this step, it stays as it is
  void (*kick_and_drift)(const GrainView<Dim>&, int first_grain, const Kick<Dim>&, const Drift<Dim>&,
                         Rotation stands);
  /// Square of the largest displacement since the list was built, in skins of the grain.
  /// @param list_stretch  deformation since then
  double (*motion_squared)(const GrainView<Dim>&, int first_grain, const double (&list_stretch)[Dim][Dim]);
  /// Rows and springs of the pairs [first, last). @param law  the kernel law, of the alternative chosen
  void (*compute_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                        const PairCell<Dim>&);
  /// The same for pairs of grains with walls; null under a kernel law of other pairs alone.
  void (*compute_wall_pairs)(const void* law, const GrainView<Dim>&, const PairView<Dim>&, int first, int last,
                             const PairCell<Dim>&);
  /// @param to  where to leave the rotation; at the end of the step it leaves the torques, too
  void (*sum_and_kick)(const GrainView<Dim>&, const PairView<Dim>&, const BlockSumsPlan&, int first_grain,
                       const PairCell<Dim>&, const Kick<Dim>&, Rotation to, BlockSums<Dim>&);
};

/// Which lattices a kernel is for; chosen once per run: the general one slows laws without friction by a tenth.
enum class LatticeShape { rectangular, triangular };

/// The kernels of alternative `law_index` of AnyKernelLaw.
/// @pre supported(set)
template <int Dim>
const StepKernels<Dim>& step_kernels(InstructionSet set, LatticeShape shape, std::size_t law_index);

/// The tables behind it, one per translation unit of an instruction set and dimension.
template <int Dim>
const StepKernels<Dim>* step_kernels_portable(LatticeShape shape);
template <int Dim>
const StepKernels<Dim>* step_kernels_avx2(LatticeShape shape);
template <int Dim>
const StepKernels<Dim>* step_kernels_avx512(LatticeShape shape);

}  // namespace floc
