#include "floc/packing/wrap.h"

#include <algorithm>

#include "floc/packing/contact_order.h"
#include "floc/packing/swap_sides.h"

namespace floc {

template <int Dim>
std::vector<Vec<Dim, int>> wrap_grains(const Cell<Dim>& cell, Grains<Dim>& grains) {
  std::vector<Vec<Dim, int>> images;
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < grains.size(); ++i) {
    const Vec<Dim> s = cell.reduced(grains.position[i]);
    images.push_back(-s.array().floor().matrix().template cast<int>());
    centres.push_back(displaced<Dim>(grains.centre(i), cell, images.back()));
  }
  grains.set_centres(centres);
  return images;
}

template <int Dim>
void wrap_into_cell(Packing<Dim>& packing) {
  Grains<Dim>& grains = packing.grains;
  const std::vector<DoubleDoubleVec<Dim>> before = [&] {
    std::vector<DoubleDoubleVec<Dim>> centres;
    for (int i = 0; i < grains.size(); ++i) centres.push_back(grains.centre(i));
    return centres;
  }();
  std::vector<Vec<Dim, int>> images = wrap_grains(packing.cell, grains);
  // An axis between walls is not periodic.
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < grains.size(); ++i) {
    for (const Wall<Dim>& wall : packing.walls) images[i][wall.axis] = 0;
    centres.push_back(displaced<Dim>(before[i], packing.cell, images[i]));
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

#define FLOC_INSTANTIATE(Dim)                                                      \
  template std::vector<Vec<Dim, int>> wrap_grains(const Cell<Dim>&, Grains<Dim>&); \
  template void wrap_into_cell(Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
