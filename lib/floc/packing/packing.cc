#include "floc/packing/packing.h"

#include <algorithm>
#include <cmath>

#include "floc/packing/grain_sizes.h"

namespace floc {

template <int Dim>
void Grains<Dim>::set_centres(const std::vector<DoubleDoubleVec<Dim>>& centres) {
  position.resize(centres.size());
  position_low.resize(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (int a = 0; a < Dim; ++a) position[i][a] = centres[i][a].high, position_low[i][a] = centres[i][a].low;
  if (std::all_of(position_low.begin(), position_low.end(),
                  [](const Vec<Dim>& low) { return low.isZero(0.0); }))
    position_low.clear();
}

template <int Dim>
void Grains<Dim>::set_names(std::vector<std::int64_t> names) {
  bool indices = true;
  for (std::size_t i = 0; i < names.size(); ++i) indices = indices && names[i] == static_cast<std::int64_t>(i);
  id = indices ? std::vector<std::int64_t>{} : std::move(names);
}

template <int Dim>
PlacedShape<Dim> Grains<Dim>::placed(int i) const {
  return {&(*shapes)[shape[i]], scale[i], position[i], rotation_matrix(orientation[i])};
}

template <int Dim>
double Grains<Dim>::volume(int i) const {
  if (are_round()) return Ball<Dim>{radius[i]}.volume();
  return std::pow(scale[i], Dim) * (*shapes)[shape[i]].volume;
}

template <int Dim>
Mat<kRotations<Dim>> Grains<Dim>::inertia_tensor(int i) const {
  if (are_round()) return inertia(i) * Mat<kRotations<Dim>>::Identity();
  const Shape<Dim>& own = (*shapes)[shape[i]];
  const RotationVector<Dim> principal = mass[i] * scale[i] * scale[i] / own.volume * own.inertia;
  if constexpr (Dim == 2) {
    return principal;
  } else {
    const Mat<3> axes = rotation_matrix(orientation[i]);
    return axes * principal.asDiagonal() * axes.transpose();
  }
}

template <int Dim>
void stop_grains(Packing<Dim>& packing) {
  for (Vec<Dim>& v : packing.grains.velocity) v.setZero();
  for (RotationVector<Dim>& w : packing.grains.angular_velocity) w.setZero();
  packing.cell.velocity.setZero();
}

template <int Dim>
void stop_all_bodies(Packing<Dim>& packing) {
  stop_grains(packing);
  for (Wall<Dim>& wall : packing.walls) wall.velocity = 0.0;
}

template <int Dim>
double solid_fraction(const Packing<Dim>& packing) {
  return total_volume(packing.grains) / packing.cell.volume();
}

template <int Dim>
Cell<Dim> search_cell(Cell<Dim> cell, const std::vector<Wall<Dim>>& walls, double reach) {
  for (int a = 0; a < Dim; ++a)
    if (between_walls(walls, a)) cell.matrix(a, a) += 2.0 * reach;
  return cell;
}

template <int Dim>
DoubleDoubleVec<Dim> exact_branch(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  if (packing.is_wall(contact.j)) {
    const Wall<Dim>& wall = packing.wall(contact.j);
    DoubleDoubleVec<Dim> foot = packing.grains.centre(contact.i);
    foot[wall.axis] = exact_sum(wall.position, 0.0);
    return difference<Dim>(foot, packing.grains.centre(contact.i));
  }
  return difference<Dim>(displaced<Dim>(packing.grains.centre(contact.j), packing.cell, contact.image),
                         packing.grains.centre(contact.i));
}

template <int Dim>
Vec<Dim> branch(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return rounded<Dim>(exact_branch(packing, contact));
}

template <int Dim>
Vec<Dim> stress_lever(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  Vec<Dim> lever = branch(packing, contact);
  if (!packing.is_wall(contact.j) || packing.grains.are_round()) return lever;
  const int axis = packing.wall(contact.j).axis;
  for (int b = 0; b < Dim; ++b)
    if (b != axis) lever[b] = contact.arm_i[b];
  return lever;
}

template struct Grains<2>;
template struct Grains<3>;
template void stop_grains(Packing<2>&);
template void stop_grains(Packing<3>&);
template void stop_all_bodies(Packing<2>&);
template void stop_all_bodies(Packing<3>&);
template double solid_fraction(const Packing<2>&);
template double solid_fraction(const Packing<3>&);
template Cell<2> search_cell(Cell<2>, const std::vector<Wall<2>>&, double);
template Cell<3> search_cell(Cell<3>, const std::vector<Wall<3>>&, double);
template DoubleDoubleVec<2> exact_branch(const Packing<2>&, const Contact<2>&);
template DoubleDoubleVec<3> exact_branch(const Packing<3>&, const Contact<3>&);
template Vec<2> branch(const Packing<2>&, const Contact<2>&);
template Vec<2> stress_lever(const Packing<2>&, const Contact<2>&);
template Vec<3> branch(const Packing<3>&, const Contact<3>&);
template Vec<3> stress_lever(const Packing<3>&, const Contact<3>&);

}  // namespace floc
