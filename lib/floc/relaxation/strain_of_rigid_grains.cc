// Member functions of class ContactDynamicsRelaxer for cells that are strained at an imposed rate.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/contact_dynamics_relaxer.h"

namespace floc {
namespace {

/// Number of time steps of a strain in one call of advance().
constexpr int kStrainingSteps = 20;
/// In the step whose forces are recorded in motion, the allowed number of sweeps is larger by this factor.
constexpr int kSweepsOfRecord = 50;
/// In a recorded motion, a contact counts as force-free if its repulsive force, divided by the mean repulsive force, is
/// at most this number.
constexpr double kIdle = 1e-9;
/// A cell counts as closed if a side, divided by the largest diameter, is below this number.
constexpr double kClosedSide = 0.5;

}  // namespace

/// Records the lengths of the cell before the strain. Sets the rates of change of sides with an imposed length, and all
/// shear rates, to zero.
template <int Dim>
void ContactDynamicsRelaxer<Dim>::begin_strain() {
  const Mat<Dim>& matrix = packing_.cell.matrix;
  for (int a = 0; a < Dim; ++a) progress_.side_before.push_back(matrix(a, a));
  if (load_.offset) progress_.offset_before = matrix(load_.offset->axis, 0);
  if (imposed_strain().size() > 0.0) progress_.phase = ContactDynamicsProgress::straining;
  Mat<Dim> rate = packing_.cell.rate();
  bool moves = false;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) {
      if (a == b && !load_.strained(a)) continue;
      moves = moves || rate(a, b) != 0.0;
      rate(a, b) = 0.0;
    }
  if (moves) packing_.cell.velocity = matrix * rate.transpose();
}

template <int Dim>
ImposedStrain<Dim> ContactDynamicsRelaxer<Dim>::imposed_strain() const {
  ImposedStrain<Dim> strain;
  for (int a = 0; a < Dim; ++a) strain.from[a] = progress_.side_before[a];
  strain.to = load_.side;
  for (int a = 0; a < Dim; ++a) strain.is_imposed[a] = load_.strained(a);
  if (load_.offset) {
    strain.sheared_axis = load_.offset->axis;
    strain.offset_from = progress_.offset_before;
    strain.offset_to = load_.offset->offset;
  }
  strain.duration = strain.size() / strain_rate_;
  return strain;
}

/// Sets the velocity of the cell for the next step of the imposed strain. Shortens this step so that a whole number of
/// steps is left until the full strain.
/// @return false if the strain is already complete
template <int Dim>
bool ContactDynamicsRelaxer<Dim>::impose_strain(ContactDynamics<Dim>& motion) const {
  const ImposedStrain<Dim> strain = imposed_strain();
  if (strain.over(progress_.time)) return false;
  const double left = strain.duration - progress_.time;
  motion.shorten_next_step(left / std::ceil(left / motion.time_step()));
  const double dt = motion.time_step();
  const Cell<Dim>& cell = motion.packing().cell;
  // The rows of the matrix Q are the lattice vectors. A step of length dt multiplies Q by 1 + dt L^T, with the velocity
  // gradient L.
  Mat<Dim> next = cell.matrix;
  strain.set_lattice(progress_.time + dt, next);
  const Vec<Dim> before = cell.rate().diagonal();
  Vec<Dim> stretch;
  for (int a = 0; a < Dim; ++a)
    stretch[a] = load_.strained(a) ? (next(a, a) / cell.matrix(a, a) - 1.0) / dt : before[a];
  Mat<Dim> rate = stretch.asDiagonal();
  if (const int axis = strain.sheared_axis; axis > 0)
    rate(0, axis) = ((next(axis, 0) - cell.matrix(axis, 0)) / dt - cell.matrix(axis, 0) * stretch[0]) /
                    cell.matrix(axis, axis);
  motion.set_cell_velocity(cell.matrix * rate.transpose());
  return true;
}

template <int Dim>
std::string ContactDynamicsRelaxer<Dim>::closed_cell() const {
  const double a = largest_diameter(packing_.grains);
  for (int k = 0; k < Dim; ++k)
    if (load_.strained(k) && load_.side[k] < kClosedSide * a)
      return fmt::format(
          "the cell closes: the imposed length of axis {} is {:.4g}, too short for the largest grain, whose "
          "diameter is {:.4g}; impose a smaller strain",
          k + 1, load_.side[k], a);
  return "";
}

/// Advances the strain by the next kStrainingSteps time steps. When the strain is complete, the motion of rigid grains
/// is recorded. The velocities of elastic grains are set to zero, and these grains then relax in the strained cell.
template <int Dim>
RelaxationStatus ContactDynamicsRelaxer<Dim>::strain() {
  if (!closed_cell().empty()) {
    ending_ = "closed";
    return RelaxationStatus::gave_up;
  }
  make_steps(kStrainingSteps);
  if (!imposed_strain().over(progress_.time)) return RelaxationStatus::running;
  if (is_elastic()) {
    imposed_strain().set_lattice(progress_.time, packing_.cell.matrix);
    stop_grains(packing_);
    measure();
    if (strains_springs_)
      start_resting();
    else
      start_moving();
    return RelaxationStatus::running;
  }
  record_motion();
  return RelaxationStatus::converged;
}

/// Gives the contacts the forces of the time step that begins at the present positions and velocities. If the last
/// steps were shorter than the shortest time in which overlaps are removed, because they were cut off at the end of a
/// small strain, the recorded step is the longest one in which the grains do not move too far. A short step may
/// change velocities by as much as a long one, with forces that are larger in proportion.
template <int Dim>
void ContactDynamicsRelaxer<Dim>::record_motion() {
  // The lengths are set once more to remove the rounding errors of the steps.
  imposed_strain().set_lattice(progress_.time, packing_.cell.matrix);
  ContactDynamicsSettings chosen = settings();
  chosen.max_sweeps =
      kSweepsOfRecord * std::min(chosen.max_sweeps, std::numeric_limits<int>::max() / kSweepsOfRecord);
  const bool is_cut_off = progress_.time_step < shortest_removal(chosen);
  const double first = is_cut_off ? chosen.longest_step : progress_.time_step;
  ContactDynamics<Dim> motion(std::move(packing_), boundary_load(), chosen, first, progress_.last_step);
  const SweepResult found = motion.find_forces();
  progress_.n_sweeps += found.n_sweeps;
  motion_ = {.time_step = motion.time_step(),
             .longest_step = chosen.longest_step,
             .cell_mass = options_.cell_mass,
             .restitution = chosen.restitution,
             .slow_impact = chosen.slow_impact,
             .sweep_tolerance = chosen.sweep_tolerance,
             .residual = found.residual,
             .inertial_number = options_.contact_dynamics.inertial_number};
  packing_ = motion.release_packing();
  const double least = kIdle * mean_repulsive_force(packing_);
  std::erase_if(packing_.contacts,
                [&](const Contact<Dim>& c) { return !(c.elastic_force > least) && c.normal_force >= 0.0; });
  measure();
  ending_ = "moving";
}

#define FLOC_INSTANTIATE(Dim)                                                            \
  template void ContactDynamicsRelaxer<Dim>::begin_strain();                             \
  template ImposedStrain<Dim> ContactDynamicsRelaxer<Dim>::imposed_strain() const;       \
  template bool ContactDynamicsRelaxer<Dim>::impose_strain(ContactDynamics<Dim>&) const; \
  template std::string ContactDynamicsRelaxer<Dim>::closed_cell() const;                 \
  template RelaxationStatus ContactDynamicsRelaxer<Dim>::strain();                       \
  template void ContactDynamicsRelaxer<Dim>::record_motion();
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
