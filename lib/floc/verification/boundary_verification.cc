#include "floc/verification/boundary_verification.h"

#include <fmt/format.h>

#include <string>

#include "floc/packing/equilibrium.h"
#include "floc/packing/wall_forces.h"

namespace floc {

template <int Dim>
Criterion verify_boundary_motion(const State<Dim>& state) {
  const Packing<Dim>& packing = state.packing;
  const ForceScale scale = force_scale(packing, state.target_stress);
  Criterion result{"boundary_motion", 0.0, state.tolerance.energy, true, ""};
  std::string moving;
  double energy = 0.0;
  for (std::size_t w = 0; w < packing.walls.size(); ++w) {
    const Wall<Dim>& wall = packing.walls[w];
    // A wall that does not follow forces has an infinite mass, so it has no finite kinetic energy. For such a wall,
    // only the velocity is tested.
    if (follows_forces(wall))
      energy += 0.5 * wall.mass * wall.velocity * wall.velocity;
    else if (wall.velocity != 0.0)
      moving += fmt::format("wall {} is a fixed wall but has the velocity {:.3g}; ", w, wall.velocity);
  }
  const Grains<Dim>& g = packing.grains;
  // The rows of the matrix H are the lattice vectors of the cell, and V is the time derivative of H. A grain at x that
  // follows the deformation of the cell about its centre c has the velocity V^T H^-T (x - c).
  const Mat<Dim> gradient = packing.cell.matrix.inverse() * packing.cell.velocity;
  const Vec<Dim> centre = 0.5 * packing.cell.matrix.transpose() * Vec<Dim>::Ones();
  if (packing.walls.empty())
    for (int i = 0; i < g.size(); ++i)
      energy += 0.5 * g.mass[i] * (gradient.transpose() * (g.position[i] - centre)).squaredNorm();
  // If there is neither adhesion nor an imposed pressure, the force scale is zero. The condition avoids the ratio 0/0
  // in a packing whose boundary is at rest.
  if (energy > 0.0) result.value = energy / (g.size() * scale.force * scale.length);
  result.holds = moving.empty() && *result.value < result.limit;
  if (!result.holds)
    result.where =
        moving + (packing.walls.empty() ? "the cell is still being deformed (cell/velocity in the state file)"
                                        : "the walls still move (walls/velocity in the state file)");
  return result;
}

template Criterion verify_boundary_motion(const State<2>&);
template Criterion verify_boundary_motion(const State<3>&);

}  // namespace floc
