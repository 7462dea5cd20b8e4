#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "floc/contact/law_table.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/dynamics.h"

namespace floc {
namespace {

/// Longest stable time step of an undamped crystal of equal grains (in 2D a triangular crystal of disks, in 3D
/// close-packed spheres), in units of sqrt(m/K_N). The normal and the tangential stiffness are both K_N, and m is the
/// mass of a grain. In both crystals, the mode that becomes unstable first is a rotation of all grains in phase.
template <int Dim>
constexpr double kCrystalLimit = 2.0 / (Dim == 2 ? 4.898979485566356 : 6.324555320336759);

/// Assumed largest overlap during a chunk of time steps, divided by the largest overlap at the beginning of the chunk.
constexpr double kDeeper = 1.3;
/// Assumed ratio of the largest to the mean contact force in a packing under pressure. The stiffness of a Hertz contact
/// under this largest force is twice its stiffness under the mean force.
constexpr double kLargestForce = 8.0;
/// Product z Phi of the coordination number z and the solid fraction Phi in a packing with few contacts. The mean
/// contact force under a pressure is estimated with this product.
constexpr double kFewContacts = 4.0;

/// Solid fraction of the closest packing. The largest frequency of vibrations of the cell is estimated for this solid
/// fraction.
template <int Dim>
constexpr double kClosePacked = Dim == 2 ? 0.9069 : 0.7405;

template <int Dim>
int largest_grain(const Grains<Dim>& g) {
  return static_cast<int>(std::max_element(g.radius.begin(), g.radius.end()) - g.radius.begin());
}

template <int Dim>
ContactLoad load_on(const Packing<Dim>& packing, double pressure) {
  ContactLoad load;
  for (const Contact<Dim>& c : packing.contacts) load.overlap = std::max(load.overlap, -kDeeper * c.gap);
  const double a = largest_diameter(packing.grains);
  // For equal spheres of diameter a, the pressure is P = z Phi <N>/(pi a^2), with z the coordination number, Phi the
  // solid fraction and <N> the mean normal force.
  load.force = kLargestForce * std::numbers::pi * a * a * pressure / kFewContacts;
  double fastest_squared = 0.0;
  for (const Vec<Dim>& v : packing.grains.velocity)
    fastest_squared = std::max(fastest_squared, v.squaredNorm());
  load.impact_speed = 2.0 * std::sqrt(fastest_squared);
  return load;
}

/// Returns the geometry of the stiffest contact that grain i can have: with one of the largest grains, or with a wall.
template <int Dim>
PairGeometry<> stiffest_pair(const Grains<Dim>& grains, int i, int largest, bool with_wall) {
  if (with_wall) return {0.0, grains.radius[i], grains.mass[i]};
  return {0.0, reduced(grains.radius[i], grains.radius[largest]),
          reduced(grains.mass[i], grains.mass[largest])};
}

/// Returns the largest stiffness of a contact between grains, or of a grain with a wall (force/length).
template <int Dim>
double stiffest_contact(const Grains<Dim>& g, const Law& parameters, const ContactLoad& load, bool with_wall) {
  const int largest = largest_grain(g);
  return std::visit(
      [&](const auto& law) {
        double stiffest = 0.0;
        for (int i = 0; i < g.size(); ++i) {
          const ContactStiffness bound = law.stiffness_bound(stiffest_pair(g, i, largest, with_wall), load);
          stiffest = std::max({stiffest, bound.normal, bound.tangential});
        }
        return stiffest;
      },
      compose_law(parameters));
}

}  // namespace

template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times, double pressure) {
  const Grains<Dim>& g = packing.grains;
  const ContactLoad load = load_on(packing, pressure);
  const int largest = largest_grain(g);
  double shortest = std::numeric_limits<double>::infinity();
  const auto shorten = [&](const Law& parameters, bool with_wall) {
    std::visit(
        [&](const auto& law) {
          for (int i = 0; i < g.size(); ++i) {
            const ContactStiffness bound = law.stiffness_bound(stiffest_pair(g, i, largest, with_wall), load);
            // If tangential springs are stiffer than normal springs, they vibrate faster.
            const double stiffest = std::max(bound.normal, bound.tangential);
            shortest = std::min(shortest, std::sqrt(g.mass[i] / stiffest));
            // Rolling motions are stable up to a time step of x sqrt(inertia/rolling stiffness), vibrations up to y
            // sqrt(mass/stiffness), with x = 1.45 y (measured in crystals).
            const double turning = std::max(bound.rolling, bound.twisting);
            if (turning > 0.0) shortest = std::min(shortest, 1.45 * std::sqrt(g.inertia(i) / turning));
          }
        },
        compose_law(parameters));
  };
  shorten(packing.law, false);
  if (!packing.walls.empty()) shorten(packing.wall_law, true);
  constexpr double kOverDisks = Dim == 2 ? 1.0 : kCrystalLimit<Dim> / kCrystalLimit<2>;
  return kOverDisks * time_step_in_contact_times * shortest;
}

template <int Dim>
double cell_time_step_of(const Packing<Dim>& packing, double cell_mass, double time_step_in_contact_times,
                         double pressure) {
  const Grains<Dim>& g = packing.grains;
  double squared_diameters = 0.0;
  for (const double r : g.radius) squared_diameters += 4.0 * r * r;
  const double shrinks = std::min(1.0, std::pow(solid_fraction(packing) / kClosePacked<Dim>, 1.0 / Dim));
  const double side = shrinks * packing.cell.matrix.diagonal().minCoeff();
  // In a close packing, a grain has 6 (2D) or 12 (3D) neighbours, so there are 3 or 6 contacts per grain. The mean of
  // n_a^2 over the contacts is 1/Dim, where n_a is a component of the normal of a contact.
  constexpr double kContactsAlong = Dim == 2 ? 3.0 / 2.0 : 6.0 / 3.0;
  const double stiffness = stiffest_contact(g, packing.law, load_on(packing, pressure), false);
  const double frequency = std::sqrt(kContactsAlong * stiffness * squared_diameters / cell_mass) / side;
  return time_step_in_contact_times / frequency;
}

template double time_step_of(const Packing<2>&, double, double);
template double time_step_of(const Packing<3>&, double, double);
template double cell_time_step_of(const Packing<2>&, double, double, double);
template double cell_time_step_of(const Packing<3>&, double, double, double);

}  // namespace floc
