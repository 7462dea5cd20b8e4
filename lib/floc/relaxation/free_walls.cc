#include "floc/relaxation/free_walls.h"

#include <algorithm>

#include "floc/packing/wall_forces.h"

namespace floc {

template <int Dim>
FreeWalls<Dim>::FreeWalls(const Packing<Dim>& packing, const LoadTarget<Dim>& load) : pressure_(load.stress) {
  for (int w = 0; w < static_cast<int>(packing.walls.size()); ++w)
    if (follows_forces(packing.walls[w])) walls_.push_back(w);
}

template <int Dim>
Vec<Dim> FreeWalls<Dim>::displacement(const Packing<Dim>& packing, int wall,
                                      const Eigen::VectorXd& step) const {
  const auto place = std::ranges::find(walls_, wall);
  if (place == walls_.end()) return Vec<Dim>::Zero();
  return step[step.size() - (walls_.end() - place)] * Vec<Dim>::Unit(packing.walls[wall].axis);
}

template <int Dim>
void FreeWalls<Dim>::move(const Eigen::VectorXd& step, Packing<Dim>& packing) const {
  for (int w : walls_) {
    Wall<Dim>& wall = packing.walls[w];
    const double along = displacement(packing, w, step)[wall.axis];
    wall.position += along;
    packing.cell.matrix(wall.axis, wall.axis) += wall.side * along;
  }
  fit_open_ends(packing);
}

template <int Dim>
BoundaryColumns<Dim> FreeWalls<Dim>::columns(const NetworkContact<Dim>& c) const {
  BoundaryColumns<Dim> out;
  out.displacement.setZero(Dim, size());
  out.follow.setZero(size(), Dim);
  const auto place = std::ranges::find(walls_, c.wall);
  // The normal of a wall is parallel to its axis, along which the displacement is positive.
  if (place != walls_.end()) out.displacement.col(place - walls_.begin()) = c.normal().cwiseAbs();
  return out;
}

template <int Dim>
Eigen::VectorXd FreeWalls<Dim>::net_forces(const Packing<Dim>& packing) const {
  const std::vector<double> of_grains = wall_forces(packing);
  Eigen::VectorXd out(size());
  for (int k = 0; k < size(); ++k) {
    const Wall<Dim>& wall = packing.walls[walls_[k]];
    out[k] = wall.side * (of_grains[walls_[k]] - pressure_[wall.axis] * wall_area(packing, wall.axis));
  }
  return out;
}

template <int Dim>
Eigen::MatrixXd FreeWalls<Dim>::load_derivatives(const Packing<Dim>& packing) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size(), size());
  for (int p = 0; p < size(); ++p)
    for (int q = 0; q < size(); ++q) {
      const Wall<Dim>&pressed = packing.walls[walls_[p]], &moved = packing.walls[walls_[q]];
      if (pressed.axis == moved.axis) continue;
      const double force = pressure_[pressed.axis] * wall_area(packing, pressed.axis);
      out(p, q) = pressed.side * moved.side * force / packing.cell.matrix(moved.axis, moved.axis);
    }
  return out;
}

template class FreeWalls<2>;
template class FreeWalls<3>;

}  // namespace floc
