#include "floc/packing/wall_forces.h"

#include <algorithm>
#include <cmath>

#include "floc/packing/balance.h"

namespace floc {

template <int Dim>
bool follows_forces(const Wall<Dim>& wall) {
  return std::isfinite(wall.mass);
}

template <int Dim>
int n_moving_walls(const Packing<Dim>& packing, int axis) {
  if (is_open_along(packing.walls, axis)) return 0;
  return static_cast<int>(std::ranges::count_if(
      packing.walls, [axis](const Wall<Dim>& wall) { return wall.axis == axis && follows_forces(wall); }));
}

template <int Dim>
Packing<Dim> with_walls_at_cell(Packing<Dim> packing) {
  Vec<Dim> lowest = Vec<Dim>::Zero();
  for (const Wall<Dim>& wall : packing.walls)
    if (wall.side < 0) lowest[wall.axis] = wall.position;
  if (lowest.isZero(0.0)) return packing;
  for (Wall<Dim>& wall : packing.walls) wall.position -= lowest[wall.axis];
  for (Vec<Dim>& x : packing.grains.position) x -= lowest;
  return packing;
}

template <int Dim>
void fit_open_ends(Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  for (std::size_t w = 0; w + 1 < packing.walls.size(); w += 2) {
    const Wall<Dim>& floor = packing.walls[w];
    Wall<Dim>& above = packing.walls[w + 1];
    if (!above.open) continue;
    double highest = g.position[0][above.axis] + g.radius[0];
    for (int i = 1; i < g.size(); ++i) highest = std::max(highest, g.position[i][above.axis] + g.radius[i]);
    above.position = highest;
    packing.cell.matrix(above.axis, above.axis) = highest - floor.position;
  }
}

template <int Dim>
double wall_area(const Packing<Dim>& packing, int axis) {
  double area = 1.0;
  for (int b = 0; b < Dim; ++b)
    if (b != axis) area *= packing.cell.matrix(b, b);
  return area;
}

template <int Dim>
std::vector<double> wall_forces(const Packing<Dim>& packing) {
  std::vector<double> force(packing.walls.size(), 0.0);
  for (const Contact<Dim>& c : packing.contacts)
    if (packing.is_wall(c.j)) force[c.j - packing.grains.size()] += c.normal_force;
  return force;
}

template <int Dim>
Vec<Dim> wall_pressure(const Packing<Dim>& packing) {
  Vec<Dim> pressure = Vec<Dim>::Zero();
  const std::vector<double> force = wall_forces(packing);
  for (std::size_t w = 0; w < force.size(); ++w) {
    const int axis = packing.walls[w].axis;
    const double share = is_open_along(packing.walls, axis) ? 1.0 : 0.5;
    pressure[axis] += share * force[w] / wall_area(packing, axis);
  }
  return pressure;
}

template <int Dim>
std::optional<double> mean_wall_pressure(const Packing<Dim>& packing) {
  int n_axes = 0;
  for (int a = 0; a < Dim; ++a)
    n_axes += std::ranges::any_of(packing.walls, [a](const Wall<Dim>& w) { return w.axis == a && !w.open; });
  if (n_axes == 0) return std::nullopt;
  return wall_pressure(packing).sum() / n_axes;
}

template <int Dim>
Vec<Dim> stress_borne_by_friction(const Packing<Dim>& packing) {
  Vec<Dim> between = Vec<Dim>::Zero(), reference = Vec<Dim>::Zero(), sum = Vec<Dim>::Zero();
  for (const Wall<Dim>& wall : packing.walls) {
    between[wall.axis] = 1.0;
    if (!is_open_along(packing.walls, wall.axis))
      reference[wall.axis] += 0.5 * wall.position;
    else if (wall.open)
      reference[wall.axis] = wall.position;
  }
  for (const Contact<Dim>& c : packing.contacts)
    if (packing.is_wall(c.j)) {
      const Vec<Dim> point = packing.grains.position[c.i] + stress_lever(packing, c);
      sum += c.shear_force.cwiseProduct(point - reference);
    }
  return sum.cwiseProduct(between) / packing.cell.volume();
}

template <int Dim>
Vec<Dim> strain_origin(const Packing<Dim>& packing) {
  Vec<Dim> origin = Vec<Dim>::Zero();
  for (const Wall<Dim>& wall : packing.walls)
    if (n_moving_walls(packing, wall.axis) != 1)
      origin[wall.axis] += 0.5 * wall.position;
    else if (!follows_forces(wall))
      origin[wall.axis] = wall.position;
  return origin;
}

template <int Dim>
Mat<Dim> load_stress(const Packing<Dim>& packing) {
  Mat<Dim> stress = static_stress(packing);
  const Vec<Dim> mean = wall_pressure(packing);
  const std::vector<double> force = wall_forces(packing);
  for (std::size_t w = 0; w < force.size(); ++w) {
    const Wall<Dim>& wall = packing.walls[w];
    if (wall.open) continue;
    double& pressure = stress(wall.axis, wall.axis);
    if (n_moving_walls(packing, wall.axis) != 1)
      pressure = mean[wall.axis];
    else if (follows_forces(wall))
      pressure = force[w] / wall_area(packing, wall.axis);
  }
  return stress;
}

template <int Dim>
double wall_imbalance(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  double largest = 0.0;
  const std::vector<double> force = wall_forces(packing);
  for (std::size_t w = 0; w < force.size(); ++w) {
    const Wall<Dim>& wall = packing.walls[w];
    if (!follows_forces(wall)) continue;
    const double pressure = force[w] / wall_area(packing, wall.axis);
    largest = std::max(largest, std::abs(pressure - target_stress[wall.axis]));
  }
  return largest;
}

#define FLOC_INSTANTIATE(Dim)                                             \
  template bool follows_forces(const Wall<Dim>&);                         \
  template int n_moving_walls(const Packing<Dim>&, int);                  \
  template Packing<Dim> with_walls_at_cell(Packing<Dim>);                 \
  template void fit_open_ends(Packing<Dim>&);                             \
  template double wall_area(const Packing<Dim>&, int);                    \
  template std::vector<double> wall_forces(const Packing<Dim>&);          \
  template Vec<Dim> wall_pressure(const Packing<Dim>&);                   \
  template std::optional<double> mean_wall_pressure(const Packing<Dim>&); \
  template Vec<Dim> stress_borne_by_friction(const Packing<Dim>&);        \
  template Vec<Dim> strain_origin(const Packing<Dim>&);                   \
  template Mat<Dim> load_stress(const Packing<Dim>&);                     \
  template double wall_imbalance(const Packing<Dim>&, const Vec<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
