#include "floc/packing/wrap.h"

#include <algorithm>
#include <vector>

#include "floc/packing/contact_order.h"
#include "floc/packing/swap_sides.h"

namespace floc {

template <int Dim>
void wrap_into_cell(Packing<Dim>& packing) {
  Grains<Dim>& grains = packing.grains;
  std::vector<Vec<Dim, int>> images;
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < grains.size(); ++i) {
    const Vec<Dim> s = packing.cell.reduced(grains.position[i]);
    images.push_back(-s.array().floor().matrix().template cast<int>());
    for (const Wall<Dim>& wall : packing.walls) images[i][wall.axis] = 0;
    centres.push_back(displaced<Dim>(grains.centre(i), packing.cell, images[i]));
  }
  grains.set_centres(centres);
  const ContactHistory<Dim> parity = swap_parity<Dim>(packing.law);
  for (Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j)) continue;
    c.image += images[c.i] - images[c.j];
    if (!is_canonical(c)) swap_sides(parity, c);
  }
  std::sort(packing.contacts.begin(), packing.contacts.end(), precedes<Contact<Dim>>);
}

template void wrap_into_cell(Packing<2>&);
template void wrap_into_cell(Packing<3>&);

}  // namespace floc
