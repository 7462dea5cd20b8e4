#include "floc/relaxation/wall_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "floc/packing/wall_forces.h"

namespace floc {

template <int Dim>
WallMotion<Dim>::WallMotion(std::vector<Wall<Dim>> walls)
    : walls_(std::move(walls)), pairs_of_wall_(walls_.size()), force_(walls_.size(), 0.0) {
  for (const Wall<Dim>& wall : walls_) between_[wall.axis] = true;
  for (int a = 0; a < Dim; ++a)
    for (const Wall<Dim>& wall : walls_) normal_[a].push_back(wall.normal()[a]);
  level_.resize(walls_.size());
  level_rate_.resize(walls_.size());
  set_arrays();
}

template <int Dim>
double WallMotion<Dim>::gap_of(int axis, double Wall<Dim>::*member) const {
  double gap = 0.0;
  for (const Wall<Dim>& wall : walls_)
    if (wall.axis == axis) gap += wall.side * (wall.*member);
  return gap;
}

template <int Dim>
void WallMotion<Dim>::set_arrays() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    level_[w] = walls_[w].side * walls_[w].position;
    level_rate_[w] = walls_[w].side * walls_[w].velocity;
  }
}

template <int Dim>
WallView<Dim> WallMotion<Dim>::view() const {
  WallView<Dim> out;
  for (int a = 0; a < Dim; ++a) out.normal[a] = normal_[a].data();
  out.level = level_.data();
  out.level_rate = level_rate_.data();
  return out;
}

template <int Dim>
void WallMotion<Dim>::list_pairs(const PairArrays<Dim>& pairs) {
  pairs_of_wall_.assign(walls_.size(), {});
  for (int p = 0; p < pairs.size(); ++p)
    if (!pairs.padding(p)) pairs_of_wall_[pairs.j(p)].push_back(p);
}

template <int Dim>
void WallMotion<Dim>::sum_forces(const Interaction<Dim>& interaction) {
  const std::ptrdiff_t size_of_row = row_size<Dim>(interaction.rows());
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Wall<Dim>& wall = walls_[w];
    const double* const normal = interaction.view().row + force_in_row<Dim>(interaction.rows()) + wall.axis;
    double sum = 0.0;
    for (const int p : pairs_of_wall_[w]) sum += normal[size_of_row * p];
    force_[w] = wall.side * sum;
  }
}

template <int Dim>
void WallMotion<Dim>::kick(double half_step, const BoundaryControl<Dim>& control, const Vec<Dim>& area) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    Wall<Dim>& wall = walls_[w];
    const double load = control.target[wall.axis];
    if (control.imposed[wall.axis] == Imposed::stress)
      wall.velocity += half_step / wall.mass * wall.side * (force_[w] - load * area[wall.axis]);
    else
      wall.velocity = -0.5 * wall.side * load * distance(wall.axis);
  }
  set_arrays();
}

template <int Dim>
void WallMotion<Dim>::drift(double time_step) {
  for (Wall<Dim>& wall : walls_) wall.position += time_step * wall.velocity;
  set_arrays();
}

template <int Dim>
void WallMotion<Dim>::stop() {
  for (Wall<Dim>& wall : walls_)
    if (follows_forces(wall)) wall.velocity = 0.0;
  set_arrays();
}

template <int Dim>
double WallMotion<Dim>::twice_kinetic_energy() const {
  double sum = 0.0;
  for (const Wall<Dim>& wall : walls_)
    if (follows_forces(wall)) sum += wall.mass * wall.velocity * wall.velocity;
  return sum;
}

template <int Dim>
double WallMotion<Dim>::largest_displacement(const std::vector<Wall<Dim>>& before) const {
  double largest = 0.0;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    largest = std::max(largest, std::abs(walls_[w].position - before[w].position));
  return largest;
}

template class WallMotion<2>;
template class WallMotion<3>;

}  // namespace floc
