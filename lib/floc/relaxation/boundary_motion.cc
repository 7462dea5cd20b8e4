// The boundary of ExplicitDynamics: its lattice and its walls in motion.

#include <algorithm>
#include <vector>

#include "floc/geometry/upper_triangular.h"
#include "floc/relaxation/explicit_dynamics.h"

namespace floc {

/// Sides of a rectangular boundary: distances of walls where an axis lies between two; else the diagonal of the
/// lattice.
template <int Dim>
Vec<Dim> ExplicitDynamics<Dim>::sides() const {
  Vec<Dim> sides = lattice_.diagonal();
  for (int a = 0; a < Dim; ++a)
    if (walls_.bounds(a)) sides[a] = walls_.distance(a);
  return sides;
}

/// The lattice as packings have it, walls included.
template <int Dim>
Cell<Dim> ExplicitDynamics<Dim>::cell() const {
  Cell<Dim> cell{lattice_.transpose(), lattice_rate_.transpose()};
  for (int a = 0; a < Dim; ++a)
    if (walls_.bounds(a)) {
      cell.matrix(a, a) = walls_.distance(a);
      cell.velocity(a, a) = walls_.distance_rate(a);
    }
  return cell;
}

template <int Dim>
void ExplicitDynamics<Dim>::kick_boundary() {
  kick_lattice();
  if (!walls_.empty()) kick_walls();
}

template <int Dim>
void ExplicitDynamics<Dim>::list_pairs_of_walls() {
  const PairArrays<Dim>& pairs = interactions_.back().pairs();
  pairs_of_wall_.assign(walls_.size(), {});
  for (int p = 0; p < pairs.size(); ++p)
    if (!pairs.padding(p)) pairs_of_wall_[pairs.j(p)].push_back(p);
}

/// Forces with which the grains push the walls outwards, each summed in the order of its pairs.
template <int Dim>
void ExplicitDynamics<Dim>::sum_forces_on_walls() {
  const Interaction<Dim>& interaction = interactions_.back();
  const std::ptrdiff_t size_of_row = row_size<Dim>(interaction.rows());
  for (int w = 0; w < walls_.size(); ++w) {
    const Wall<Dim>& wall = walls_.walls()[w];
    const double* const normal = interaction.view().row + force_in_row<Dim>(interaction.rows()) + wall.axis;
    double sum = 0.0;
    for (const int p : pairs_of_wall_[w]) sum += normal[size_of_row * p];
    force_on_wall_[w] = wall.side * sum;
  }
}

/// Half a step of acceleration of the walls.
template <int Dim>
void ExplicitDynamics<Dim>::kick_walls() {
  const Vec<Dim> side = sides();
  Vec<Dim> area;
  for (int a = 0; a < Dim; ++a) {
    area[a] = 1.0;
    for (int b = 0; b < Dim; ++b)
      if (b != a) area[a] *= side[b];
  }
  walls_.kick(0.5 * dt_, control_, force_on_wall_, area);
}

/// Generalised forces on the components of the lattice under stress: their work in a small strain is that of
/// W - V Sigma, W the sum of momentum fluxes and of forces times branches. Where all are, that is the upper
/// part of (W - V Sigma) h^-T.
template <int Dim>
Mat<Dim> ExplicitDynamics<Dim>::lattice_force() const {
  Mat<Dim> work = Mat<Dim>::Zero();
  for (const BlockSums<Dim>& s : sums_)
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) work(a, b) += s.virial[a][b] + s.momentum_flux[a][b];
  const double volume = sides().prod();
  Mat<Dim, bool> is_free = Mat<Dim, bool>::Constant(false);
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto [a, b] = component_axes<Dim>(k);
    is_free(a, b) = control_.imposed[k] == Imposed::stress && moves_with_lattice(a, b);
    if (is_free(a, b)) work(a, b) -= volume * control_.target[k];
  }
  Mat<Dim> force = Mat<Dim>::Zero();  // work = force h^T on the free components, from the last column on
  for (int a = 0; a < Dim; ++a)
    for (int b = Dim - 1; b >= a; --b) {
      if (!is_free(a, b)) continue;
      double rest = work(a, b);
      for (int c = b + 1; c < Dim; ++c) rest -= force(a, c) * lattice_(b, c);
      force(a, b) = rest / lattice_(b, b);
    }
  return force;
}

/// Half a step of acceleration of the lattice: M h'' = (W - V Sigma) h^-T, the strain rates capped.
template <int Dim>
void ExplicitDynamics<Dim>::kick_lattice() {
  if (control_.any_stress()) {
    const Mat<Dim> force = lattice_force();
    for (int k = 0; k < kSymmetric<Dim>; ++k) {
      const auto [a, b] = component_axes<Dim>(k);
      if (control_.imposed[k] != Imposed::stress || !moves_with_lattice(a, b)) continue;
      lattice_rate_(a, b) += 0.5 * dt_ / control_.mass * force(a, b);
      const double limit = control_.rate_cap * lattice_(b, b);
      lattice_rate_(a, b) = std::max(std::min(lattice_rate_(a, b), limit), -limit);
    }
  }
  impose_rates();
}

/// Rates at which this step's drift brings the axes that have a way to where they are to be at its end.
template <int Dim>
void ExplicitDynamics<Dim>::follow_way() {
  const BoundaryWay<Dim>& way = control_.way;
  if (!way.any()) return;
  const Vec<Dim> side = sides();
  for (int a = 0; a < Dim; ++a) {
    if (control_.imposed[a] == Imposed::stress || way.from[a] == way.to[a]) continue;
    control_.target[a] = way.over(time_) ? 0.0 : (1.0 - way.length(a, time_ + dt_) / side[a]) / dt_;
  }
  if (!way.shears()) return;
  const int axis = way.sheared_axis;
  const double missing = way.offset(time_ + dt_) - lattice_(0, axis);
  control_.target[shear_component<Dim>(axis)] = way.over(time_) ? 0.0 : -missing / (dt_ * lattice_(axis, axis));
}

/// Components of the velocity gradient h' h^-1 that are given. Shortening counts positive.
template <int Dim>
void ExplicitDynamics<Dim>::impose_rates() {
  if (control_.is_fixed()) return;
  Mat<Dim> gradient = right_quotient<Dim>(lattice_rate_, lattice_);
  bool any = false;
  for (int k = 0; k < kSymmetric<Dim>; ++k) {
    const auto [a, b] = component_axes<Dim>(k);
    if (control_.imposed[k] == Imposed::stress || !moves_with_lattice(a, b) ||
        (control_.target[k] == 0.0 && gradient(a, b) == 0.0))
      continue;
    gradient(a, b) = -control_.target[k];
    any = true;
  }
  if (any) lattice_rate_ = upper_product<Dim>(gradient, lattice_);
}

#define FLOC_INSTANTIATE(Dim)                                 \
  template Vec<Dim> ExplicitDynamics<Dim>::sides() const;     \
  template Cell<Dim> ExplicitDynamics<Dim>::cell() const;     \
  template void ExplicitDynamics<Dim>::kick_boundary();       \
  template void ExplicitDynamics<Dim>::list_pairs_of_walls(); \
  template void ExplicitDynamics<Dim>::sum_forces_on_walls(); \
  template void ExplicitDynamics<Dim>::follow_way();          \
  template void ExplicitDynamics<Dim>::impose_rates();
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
