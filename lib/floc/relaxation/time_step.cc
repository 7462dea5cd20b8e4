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

/// Longest stable step of a crystal of equal grains with K_T = K_N, undamped, in sqrt(m/K_N): of triangles of
/// disks and of close-packed spheres, both by their spins in phase.
template <int Dim>
constexpr double kCrystalLimit = 2.0 / (Dim == 2 ? 4.898979485566356 : 6.324555320336759);

/// Contacts get deeper within a chunk of steps than they are at its beginning.
constexpr double kDeeper = 1.3;
/// The largest force over the mean in a packing under pressure: its stiffness is twice that of the mean force.
constexpr double kLargestForce = 8.0;
/// Contacts a grain times solid fraction, of packings of few contacts.
constexpr double kFewContacts = 4.0;

template <int Dim>
ContactLoad load_on(const Packing<Dim>& packing, double pressure) {
  ContactLoad load;
  for (const Contact<Dim>& c : packing.contacts) load.overlap = std::max(load.overlap, -kDeeper * c.gap);
  const double a = largest_diameter(packing.grains);
  // P = z Phi <N>/(pi a^2) of equal spheres.
  load.force = kLargestForce * std::numbers::pi * a * a * pressure / kFewContacts;
  double fastest_squared = 0.0;
  for (const Vec<Dim>& v : packing.grains.velocity)
    fastest_squared = std::max(fastest_squared, v.squaredNorm());
  load.impact_speed = 2.0 * std::sqrt(fastest_squared);
  return load;
}

/// Of two of the largest grains, whose contacts are the stiffest, or of one with a wall.
template <int Dim>
PairGeometry<> largest_pair(const Packing<Dim>& packing, bool with_wall) {
  const double radius = 0.5 * largest_diameter(packing.grains);
  double mass = 0.0;
  for (const double m : packing.grains.mass) mass = std::max(mass, m);
  return with_wall ? PairGeometry<>(0.0, radius, mass) : PairGeometry<>(0.0, 0.5 * radius, 0.5 * mass);
}

template <int Dim>
ContactStiffness stiffest_contact(const Packing<Dim>& packing, double pressure) {
  const ContactLoad load = load_on(packing, pressure);
  const auto bound_of = [&](const LawParameters& parameters, bool with_wall) {
    const PairGeometry<> pair = largest_pair(packing, with_wall);
    return std::visit([&](const auto& law) { return law.stiffness_bound(pair, load); },
                      compose_law(parameters));
  };
  ContactStiffness bound = bound_of(packing.law, false);
  if (!packing.walls.empty()) {
    const ContactStiffness on_wall = bound_of(packing.wall_law, true);
    bound = {std::max(bound.normal, on_wall.normal), std::max(bound.tangential, on_wall.tangential),
             std::max(bound.rolling, on_wall.rolling)};
  }
  return bound;
}

}  // namespace

template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times, double pressure) {
  const Grains<Dim>& g = packing.grains;
  double shortest = std::numeric_limits<double>::infinity();
  const ContactStiffness bound = stiffest_contact(packing, pressure);
  // Springs across the contact vibrate faster than those along it where they are stiffer.
  const double stiffest = std::max(bound.normal, bound.tangential);
  for (int i = 0; i < g.size(); ++i) {
    shortest = std::min(shortest, std::sqrt(g.mass[i] / stiffest));
    // Rolling is stable to 1.45 times the step in units of its own period that vibration allows (measured in
    // crystals).
    if (bound.rolling > 0.0) shortest = std::min(shortest, 1.45 * std::sqrt(g.inertia(i) / bound.rolling));
  }
  constexpr double kOverDisks = Dim == 2 ? 1.0 : kCrystalLimit<Dim> / kCrystalLimit<2>;
  return kOverDisks * time_step_in_contact_times * shortest;
}

template double time_step_of(const Packing<2>&, double, double);
template double time_step_of(const Packing<3>&, double, double);

}  // namespace floc
