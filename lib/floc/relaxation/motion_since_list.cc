#include "floc/relaxation/motion_since_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/geometry/upper_triangular.h"
#include "floc/relaxation/kernel_matrix.h"

namespace floc {
namespace {

/// Upper bound of the rounding error of a displacement in one step, divided by the largest coordinate of any grain.
constexpr double kRoundings = 32.0 * std::numeric_limits<double>::epsilon();

template <std::size_t n>
double furthest(const std::array<AlignedVector<double>, n>& x) {
  double largest = 0.0;
  for (const auto& component : x)
    for (const double coordinate : component) largest = std::max(largest, std::abs(coordinate));
  return largest;
}

/// Returns an upper bound of the factor by which an upper triangular matrix stretches a vector: the largest diagonal
/// component plus the sum of the other components.
template <int Dim>
double stretch_bound(const double (&matrix)[Dim][Dim]) {
  double diagonal = 0.0, others = 0.0;
  for (int a = 0; a < Dim; ++a) {
    diagonal = std::max(diagonal, std::abs(matrix[a][a]));
    for (int b = a + 1; b < Dim; ++b) others += std::abs(matrix[a][b]);
  }
  return diagonal + others;
}

}  // namespace

template <int Dim>
void MotionSinceList<Dim>::begin(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                 const std::vector<double>& skin, double shortest_skin) {
  x_ = grains.x;
  inverse_skin_squared_.assign(grains.x[0].size(), 0.0);
  for (std::size_t k = 0; k < skin.size(); ++k) inverse_skin_squared_[k] = 1.0 / (skin[k] * skin[k]);
  lattice_ = cell.lattice();
  walls_ = cell.walls().walls();
  stretch_.setIdentity();
  of_grains_ = 0.0;
  rounding_ = kRoundings * furthest(x_) / shortest_skin;
}

/// Updates the upper bound of the motion of the grains. Let x be the position of a grain, x_list its position when the
/// lists were built, and L the deformation of the lattice since then. The displacement of the grain is x - L x_list.
/// After one more step (x', L'), in which the lattice is deformed by S and the velocity v' is multiplied by the drift
/// matrix D, the displacement is x' - L' x_list = S (x - L x_list) + D v'. The velocity v' after the kick is bounded by
/// |v'| <= max(|keep|, |gain|) (|v| + |dt F/2m|), with the velocity v before the kick, the force F, the mass m, the
/// time step dt, and the matrices `keep` and `gain` of the kick.
template <int Dim>
void MotionSinceList<Dim>::add_step(const CellMotion<Dim>& cell, const std::vector<BlockSums<Dim>>& sums,
                                    const Kick<Dim>& kick, const Drift<Dim>& drift, double fall) {
  stretch_ = right_quotient<Dim>(cell.lattice(), lattice_);
  double next_speed_squared = 0.0;
  for (const BlockSums<Dim>& s : sums) next_speed_squared = std::max(next_speed_squared, s.next_speed_squared);
  const double speed_gain = std::max(stretch_bound(kick.keep), stretch_bound(kick.gain));
  of_grains_ = stretch_bound(drift.stretch) * of_grains_ + rounding_ +
               stretch_bound(drift.drift) * speed_gain * (std::sqrt(next_speed_squared) + 2.0 * fall);
}

template <int Dim>
void MotionSinceList<Dim>::measure(int block, const StepKernels<Dim>& kernels, const GrainView<Dim>& grains) {
  double stretch[Dim][Dim];
  copy_matrix<Dim>(stretch_, stretch);
  measured_[block] = std::sqrt(kernels.motion_squared(grains, block * kGrainBlock, stretch));
}

template <int Dim>
void MotionSinceList<Dim>::take_measured() {
  of_grains_ = *std::max_element(measured_.begin(), measured_.end());
}

template <int Dim>
void MotionSinceList<Dim>::forget() {
  of_grains_ = std::numeric_limits<double>::infinity();
}

template <int Dim>
double MotionSinceList<Dim>::shrinking() const {
  if (stretch_.isDiagonal(0.0)) return std::max(0.0, 1.0 - stretch_.diagonal().minCoeff());
  // With the deformation gradient F of the lattice, a vector r between two points of the lattice becomes F r, and |F r|
  // >= |r| - |(F - 1) r|. The last term is at most |r| times the Frobenius norm of F - 1.
  return (stretch_ - Mat<Dim>::Identity()).norm();
}

template class MotionSinceList<2>;
template class MotionSinceList<3>;

}  // namespace floc
