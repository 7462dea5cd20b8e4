#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "support/network_packings.h"

namespace floc::test {

/// Cubic crystal of equal spheres, in its conventional cell.
struct CubicCrystal {
  std::string name;
  std::vector<Vec<3>> places;  ///< centres of the spheres, divided by the side of the cell
  double side;                 ///< side of the cell, divided by the distance between neighbours
  int z;                       ///< neighbours
  double volume;               ///< volume per sphere, divided by the cubed distance between neighbours
};

inline CubicCrystal simple_cubic() {
  return {"sc", {Vec<3>::Zero()}, 1.0, 6, 1.0};
}

inline CubicCrystal body_centred_cubic() {
  return {
      "bcc", {Vec<3>::Zero(), Vec<3>(0.5, 0.5, 0.5)}, std::sqrt(4.0 / 3.0), 8, 4.0 / (3.0 * std::sqrt(3.0))};
}

inline CubicCrystal face_centred_cubic() {
  return {"fcc",
          {Vec<3>::Zero(), Vec<3>(0.0, 0.5, 0.5), Vec<3>(0.5, 0.0, 0.5), Vec<3>(0.5, 0.5, 0.0)},
          std::sqrt(2.0),
          12,
          1.0 / std::sqrt(2.0)};
}

inline std::vector<CubicCrystal> cubic_crystals() {
  return {simple_cubic(), body_centred_cubic(), face_centred_cubic()};
}

/// Returns a crystal of spheres with a given distance between neighbours.
/// @param distance  distance between neighbours (length)
/// @param diameter  diameter of the spheres (length); if it exceeds `distance`, neighbours are in contact
inline Packing<3> crystal_of(const CubicCrystal& crystal, double distance, double diameter, const Law& law) {
  Packing<3> packing;
  packing.law = law;
  packing.cell.matrix = crystal.side * distance * Mat<3>::Identity();
  packing.grains = Grains<3>::with_size(static_cast<int>(crystal.places.size()));
  packing.grains.radius.assign(crystal.places.size(), 0.5 * diameter);
  packing.grains.mass.assign(crystal.places.size(), 1.0);
  for (std::size_t i = 0; i < crystal.places.size(); ++i)
    packing.grains.position[i] = packing.cell.matrix * crystal.places[i];
  find_contacts(packing);
  return packing;
}

/// Sets the forces and stiffnesses of all contacts between equal spheres according to Hertz and Mindlin: at an overlap
/// h, the normal force is N = (E/3) sqrt(a) h^1.5 with the diameter a, and K_T = `ratio` K_N. Tangential forces stay
/// unchanged.
/// @param E  E/(1 - nu^2) of the material (force/length^2)
inline void make_hertzian(double E, double ratio, Packing<3>& packing) {
  for (Contact<3>& c : packing.contacts) {
    const double a = 2.0 * packing.grains.radius[c.i], h = -c.gap;
    c.normal_force = c.elastic_force = E / 3.0 * std::sqrt(a) * std::pow(h, 1.5);
    c.kn = 0.5 * E * std::sqrt(a * h);
    c.kt = ratio * c.kn;
  }
}

}  // namespace floc::test
