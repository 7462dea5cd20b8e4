#include "floc/relaxation/packing_from_motion.h"

#include <algorithm>
#include <vector>

#include "floc/packing/contact_order.h"
#include "floc/packing/law/contact_forces.h"

namespace floc {
namespace {

/// Copies the grains into a packing, and moves them into its cell by lattice vectors.
/// @return the number of lattice vectors along each axis by which each grain was moved
template <int Dim>
std::vector<Vec<Dim, int>> copy_grains(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                       Packing<Dim>& out) {
  // The centres of the grains have no low parts (Grains::position_low), since positions in motion are rounded to a
  // double.
  out.grains = Grains<Dim>::with_size(grains.size());
  out.grains.id = grains.id;
  std::vector<Vec<Dim, int>> wrap(grains.size());
  for (int k = 0; k < grains.size(); ++k) {
    const int i = grains.index[k];
    for (int a = 0; a < Dim; ++a) {
      out.grains.position[i][a] = grains.x[a][k];
      out.grains.velocity[i][a] = grains.v[a][k];
    }
    wrap[k] = cell.wrap(out.grains.position[i]);
    for (int a = 0; a < kRotations<Dim>; ++a) out.grains.angular_velocity[i][a] = grains.spin[a][k];
    out.grains.orientation[i] = grains.orientation_of(k);
    out.grains.radius[i] = grains.radius[k];
    out.grains.mass[i] = grains.mass[k];
  }
  return wrap;
}

/// Whether the two bodies of a pair, at their present positions, are close enough to interact or have a liquid bridge.
/// @param key  bodies and periodic image of the pair
template <int Dim>
bool is_contact(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                const Interaction<Dim>& interaction, int pair, const NeighborPair<Dim>& key) {
  const PairArrays<Dim>& pairs = interaction.pairs();
  const double reach = pairs.radii(pair) + interaction.range();
  if (interaction.partner() == Partner::wall) {
    const Wall<Dim>& wall = cell.walls().walls()[key.j];
    return !(wall.side * (wall.position - grains.x[wall.axis][key.i]) >= reach);
  }
  const Vec<Dim> shift = cell.image_shift(key.image);
  Vec<Dim> r;
  for (int a = 0; a < Dim; ++a) r[a] = grains.x[a][key.j] - grains.x[a][key.i] + shift[a];
  const bool wet = !pairs.bridge_volume().empty() && pairs.bridge_volume()[pair] != 0.0;
  return !(r.squaredNorm() >= reach * reach) || wet;
}

/// Adds contacts to a packing: the pairs of an interaction that are close enough to interact or have a liquid bridge,
/// with their history variables.
/// @param wrap  number of lattice vectors by which each grain was moved into the cell
template <int Dim>
void append_contacts(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                     const Interaction<Dim>& interaction, const std::vector<Vec<Dim, int>>& wrap,
                     Packing<Dim>& out) {
  const PairArrays<Dim>& pairs = interaction.pairs();
  out.contacts.reserve(out.contacts.size() + pairs.size());
  for (int p = 0; p < pairs.size(); ++p) {
    if (pairs.padding(p)) continue;
    NeighborPair<Dim> key = pairs.key(p);
    if (!is_contact(grains, cell, interaction, p, key)) continue;
    if (interaction.partner() == Partner::wall)
      key = {grains.index[key.i], grains.size() + key.j, key.image, key.key};
    else
      key = {grains.index[key.i], grains.index[key.j], key.image + wrap[key.i] - wrap[key.j], key.key};
    const bool swap = key.j < key.i;
    if (swap) key = swapped(key);
    Contact<Dim> c;
    c.i = key.i;
    c.j = key.j;
    c.image = key.image;
    c.key = key.key;
    c.history = interaction.history(p, swap);
    out.contacts.push_back(c);
  }
}

}  // namespace

template <int Dim>
Packing<Dim> packing_from_motion(const GrainArrays<Dim>& grains, const CellMotion<Dim>& cell,
                                 const Interactions<Dim>& interactions, const Law& law, const Law& wall_law) {
  Packing<Dim> out;
  out.law = law;
  out.walls = cell.walls().walls();
  out.wall_law = wall_law;
  out.cell = cell.cell();
  const std::vector<Vec<Dim, int>> wrap = copy_grains(grains, cell, out);
  for (const Interaction<Dim>& interaction : interactions)
    append_contacts(grains, cell, interaction, wrap, out);
  std::sort(out.contacts.begin(), out.contacts.end(), precedes<Contact<Dim>>);
  refresh_contacts(out);
  return out;
}

template Packing<2> packing_from_motion(const GrainArrays<2>&, const CellMotion<2>&, const Interactions<2>&,
                                        const Law&, const Law&);
template Packing<3> packing_from_motion(const GrainArrays<3>&, const CellMotion<3>&, const Interactions<3>&,
                                        const Law&, const Law&);

}  // namespace floc
