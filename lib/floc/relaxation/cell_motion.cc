#include "floc/relaxation/cell_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "floc/geometry/upper_triangular.h"
#include "floc/relaxation/kernel_matrix.h"

namespace floc {

template <int Dim>
CellMotion<Dim>::CellMotion(const Cell<Dim>& cell, std::vector<Wall<Dim>> walls,
                            const BoundaryControl<Dim>& control)
    : control_(control),
      walls_(std::move(walls)),
      lattice_(cell.matrix.transpose()),
      lattice_rate_(cell.velocity.transpose()) {
  for (int a = 0; a < Dim; ++a)
    if (walls_.bounds(a)) lattice_rate_(a, a) = 0.0;
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto [a, b] = component_axes<Dim>(k);
    follows_stress_(a, b) = control.imposed[k] == Imposed::stress && belongs_to_lattice(a, b);
  }
  strain_rate_ = right_quotient<Dim>(lattice_rate_, lattice_);
}

/// Returns the sides of the boundary (length): the distance between the walls for an axis between walls, the diagonal
/// component of the lattice matrix for any other axis.
template <int Dim>
Vec<Dim> CellMotion<Dim>::sides() const {
  Vec<Dim> sides = lattice_.diagonal();
  for (int a = 0; a < Dim; ++a)
    if (walls_.bounds(a)) sides[a] = walls_.distance(a);
  return sides;
}

template <int Dim>
Cell<Dim> CellMotion<Dim>::cell() const {
  Cell<Dim> cell{lattice_.transpose(), lattice_rate_.transpose()};
  for (int a = 0; a < Dim; ++a)
    if (walls_.bounds(a)) {
      cell.matrix(a, a) = walls_.distance(a);
      cell.velocity(a, a) = walls_.distance_rate(a);
    }
  return cell;
}

template <int Dim>
bool CellMotion<Dim>::finite() const {
  return lattice_.allFinite() && lattice_rate_.allFinite() && sides().allFinite();
}

template <int Dim>
Vec<Dim> CellMotion<Dim>::image_shift(const Vec<Dim, int>& image) const {
  Vec<Dim> shift;
  for (int a = 0; a < Dim; ++a) {
    shift[a] = image[a] * lattice_(a, a);
    for (int b = a + 1; b < Dim; ++b) shift[a] += image[b] * lattice_(a, b);
  }
  return shift;
}

template <int Dim>
Vec<Dim, int> CellMotion<Dim>::wrap(Vec<Dim>& position) const {
  Vec<Dim, int> image = Vec<Dim, int>::Zero();
  // The last axis comes first, since only the last lattice vector has a component along this axis.
  for (int b = Dim - 1; b >= 0; --b) {
    if (walls_.bounds(b)) continue;
    const double cells = std::floor(position[b] / lattice_(b, b));
    image[b] = -static_cast<int>(cells);
    for (int a = 0; a <= b; ++a)
      if (lattice_(a, b) != 0.0) position[a] -= cells * lattice_(a, b);
  }
  return image;
}

template <int Dim>
PairCell<Dim> CellMotion<Dim>::pair_cell(double slip_time) const {
  PairCell<Dim> cell{{}, {}, slip_time, walls_.view()};
  copy_matrix<Dim>(lattice_, cell.lattice);
  copy_matrix<Dim>(strain_rate_, cell.strain_rate);
  return cell;
}

template <int Dim>
void CellMotion<Dim>::kick(double half_step, const std::vector<BlockSums<Dim>>& sums) {
  kick_lattice(half_step, sums);
  if (!walls_.empty()) kick_walls(half_step);
}

template <int Dim>
void CellMotion<Dim>::kick_walls(double half_step) {
  const Vec<Dim> side = sides();
  Vec<Dim> area;
  for (int a = 0; a < Dim; ++a) {
    area[a] = 1.0;
    for (int b = 0; b < Dim; ++b)
      if (b != a) area[a] *= side[b];
  }
  walls_.kick(half_step, control_, area);
}

/// Returns the generalised forces that accelerate those components of the lattice that follow a stress. In a small
/// strain e of the lattice, the work of these forces is the scalar product of e and the matrix W - V Sigma. Here W is
/// the sum of the momentum flux and the virial (sum of force times branch vector), V the volume and Sigma the imposed
/// stress. If all components follow a stress, the force is the upper part of (W - V Sigma) h^-T, with h the lattice
/// matrix.
template <int Dim>
Mat<Dim> CellMotion<Dim>::lattice_force(const std::vector<BlockSums<Dim>>& sums) const {
  Mat<Dim> work = Mat<Dim>::Zero();
  for (const BlockSums<Dim>& s : sums)
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) work(a, b) += s.virial[a][b] + s.momentum_flux[a][b];
  const double volume = sides().prod();
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto [a, b] = component_axes<Dim>(k);
    if (follows_stress_(a, b)) work(a, b) -= volume * control_.target[k];
  }
  // Solves the equation work = force h^T, with h the lattice matrix, for the components of `force` that follow a
  // stress, starting with the last column.
  Mat<Dim> force = Mat<Dim>::Zero();
  for (int a = 0; a < Dim; ++a)
    for (int b = Dim - 1; b >= a; --b) {
      if (!follows_stress_(a, b)) continue;
      double rest = work(a, b);
      for (int c = b + 1; c < Dim; ++c) rest -= force(a, c) * lattice_(b, c);
      force(a, b) = rest / lattice_(b, b);
    }
  return force;
}

/// Accelerates the lattice over half a time step by M h'' = (W - V Sigma) h^-T, and then caps its strain rates. Here h
/// is the lattice matrix, M its inertia, W the sum of the momentum flux and the virial (sum of force times branch
/// vector), V the volume and Sigma the imposed stress.
template <int Dim>
void CellMotion<Dim>::kick_lattice(double half_step, const std::vector<BlockSums<Dim>>& sums) {
  if (control_.any_stress()) {
    const Mat<Dim> force = lattice_force(sums);
    for (int k = 0; k < kSymmetric<Dim>; ++k) {
      const auto [a, b] = component_axes<Dim>(k);
      if (!follows_stress_(a, b)) continue;
      lattice_rate_(a, b) += half_step / control_.mass * force(a, b);
      const double limit = control_.rate_cap * lattice_(b, b);
      lattice_rate_(a, b) = std::max(std::min(lattice_rate_(a, b), limit), -limit);
    }
  }
  impose_rates();
}

template <int Dim>
void CellMotion<Dim>::advance_strain_ramp(double time_step) {
  const StrainRamp<Dim>& ramp = control_.ramp;
  if (!ramp.any()) return;
  const Vec<Dim> side = sides();
  for (int a = 0; a < Dim; ++a) {
    if (control_.imposed[a] == Imposed::stress || ramp.from[a] == ramp.to[a]) continue;
    control_.target[a] =
        ramp.over(time_) ? 0.0 : (1.0 - ramp.length(a, time_ + time_step) / side[a]) / time_step;
  }
  if (!ramp.shears()) return;
  const int axis = ramp.sheared_axis;
  const double missing = ramp.offset(time_ + time_step) - lattice_(0, axis);
  control_.target[shear_component<Dim>(axis)] =
      ramp.over(time_) ? 0.0 : -missing / (time_step * lattice_(axis, axis));
}

/// Sets those components of the velocity gradient h' h^-1 of the lattice whose strain rate is imposed; h is the lattice
/// matrix. A positive imposed strain rate shortens the lattice.
template <int Dim>
void CellMotion<Dim>::impose_rates() {
  if (control_.is_fixed()) return;
  Mat<Dim> gradient = right_quotient<Dim>(lattice_rate_, lattice_);
  bool any = false;
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto [a, b] = component_axes<Dim>(k);
    if (control_.imposed[k] == Imposed::stress || !belongs_to_lattice(a, b) ||
        (control_.target[k] == 0.0 && gradient(a, b) == 0.0))
      continue;
    gradient(a, b) = -control_.target[k];
    any = true;
  }
  if (any) lattice_rate_ = upper_product<Dim>(gradient, lattice_);
}

/// Moves the boundary over a time step. The reduced coordinates s of a grain change at the rate s' = h^-1 v, with the
/// peculiar velocity v and the lattice matrix h. This matrix is taken in the middle of the step, so that the scheme is
/// symmetric in time.
template <int Dim>
Drift<Dim> CellMotion<Dim>::drift(double time_step) {
  const Mat<Dim> middle = lattice_ + 0.5 * time_step * lattice_rate_;
  const Mat<Dim> next = lattice_ + time_step * lattice_rate_;
  strain_rate_ = right_quotient<Dim>(lattice_rate_, middle);
  Drift<Dim> drift;
  copy_matrix<Dim>(right_quotient<Dim>(next, lattice_), drift.stretch);
  copy_matrix<Dim>(time_step * right_quotient<Dim>(next, middle), drift.drift);
  lattice_ = next;
  walls_.drift(time_step);
  time_ += time_step;
  return drift;
}

template <int Dim>
Kick<Dim> CellMotion<Dim>::kick_of_grains(double half_step) const {
  // The acceleration of a grain is v' = F/m - h' h^-1 v, with the force F on the grain, its mass m, its peculiar
  // velocity v and the lattice matrix h. The second term is taken in the middle of the half step.
  const Mat<Dim> drag = 0.5 * half_step * strain_rate_;
  const Mat<Dim> one = Mat<Dim>::Identity();
  const Mat<Dim> gain = right_quotient<Dim>(one, Mat<Dim>(one + drag));
  Kick<Dim> kick{half_step, {}, {}};
  copy_matrix<Dim>(gain, kick.gain);
  copy_matrix<Dim>(upper_product<Dim>(one - drag, gain), kick.keep);
  return kick;
}

template <int Dim>
double CellMotion<Dim>::twice_kinetic_energy_of_lattice() const {
  return control_.any_stress() ? control_.mass * lattice_rate_.squaredNorm() : 0.0;
}

template <int Dim>
void CellMotion<Dim>::stop() {
  lattice_rate_.setZero();
  walls_.stop();
  impose_rates();
}

template class CellMotion<2>;
template class CellMotion<3>;

}  // namespace floc
