#include "floc/packing/packing.h"

#include <numbers>

namespace floc {

template <int Dim>
double solid_fraction(const Packing<Dim>& packing) {
  double volume = 0.0;
  for (const double r : packing.grains.radius)
    volume += std::numbers::pi * r * r * (Dim == 2 ? 1.0 : 4.0 / 3.0 * r);
  return volume / packing.cell.volume();
}

template <int Dim>
Vec<Dim> branch(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return packing.grains.position[contact.j] + packing.cell.shift(contact.image) -
         packing.grains.position[contact.i];
}

template double solid_fraction(const Packing<2>&);
template double solid_fraction(const Packing<3>&);
template Vec<2> branch(const Packing<2>&, const Contact<2>&);
template Vec<3> branch(const Packing<3>&, const Contact<3>&);

}  // namespace floc
