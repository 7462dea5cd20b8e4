#include "floc/lattice/lattice_packing.h"

#include <cmath>

#include "floc/lattice/bonded_contacts.h"
#include "floc/packing/contact_order.h"

namespace floc {

template <int Dim>
Packing<Dim> packing_of(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                        const LatticeSolution<Dim>& solution) {
  std::vector<int> here(network.n_nodes, -1), there;
  for (int k = 0; k < network.n_nodes; ++k)
    if (network.present[k]) here[k] = static_cast<int>(there.size()), there.push_back(k);
  Packing<Dim> out;
  out.cell = lattice.cell;
  out.grains = Grains<Dim>::with_size(static_cast<int>(there.size()));
  for (std::size_t k = 0; k < there.size(); ++k) {
    out.grains.position[k] = lattice.node[there[k]];
    out.grains.radius[k] = 0.5 * network.spacing;
    out.grains.mass[k] = std::pow(network.spacing, Dim);
  }
  BondedContacts<Dim> bonds;
  bonds.reserve(network.elements.size());
  for (int e = 0; e < static_cast<int>(network.elements.size()); ++e) {
    if (solution.open[e]) continue;
    const LatticeElement<Dim>& element = network.elements[e];
    BondedContact<Dim> bond{here[element.i],
                            here[element.j],
                            element.image,
                            solution.normal_force[e],
                            Vec<Dim>::Zero(),
                            RotationVector<Dim>::Zero(),
                            element.kn,
                            0.0,
                            0.0};
    if (!network.central()) {
      bond.shear_force = solution.shear_force[e];
      bond.moment = solution.moment[e];
    }
    if (!element.unilateral) {
      bond.kt = network.shear * element.kn;
      bond.kr = network.bending * element.kn * network.spacing * network.spacing;
    }
    if (!is_canonical(bond)) {
      bond = swapped(bond);
      bond.shear_force = -bond.shear_force;
      bond.moment = -bond.moment;
    }
    bonds.push_back(bond);
  }
  set_bonded_contacts(bonds, out);
  return out;
}

template Packing<2> packing_of(const Lattice<2>&, const LatticeNetwork<2>&, const LatticeSolution<2>&);
template Packing<3> packing_of(const Lattice<3>&, const LatticeNetwork<3>&, const LatticeSolution<3>&);

}  // namespace floc
