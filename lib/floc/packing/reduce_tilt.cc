#include "floc/packing/reduce_tilt.h"

#include <cassert>
#include <cmath>

#include "floc/geometry/tilt.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/require_periodic.h"
#include "floc/packing/wrap.h"

namespace floc {

template <int Dim>
void reduce_tilt(Packing<Dim>& packing, int axis) {
  assert(axis > 0 && packing.cell.matrix.isLowerTriangular(0.0));
  require_periodic(packing, "the tilt of a cell is reduced");
  Cell<Dim>& cell = packing.cell;
  const double side = cell.matrix(0, 0);
  const double lengths = sides_in_tilt(cell.matrix(axis, 0), side);
  if (lengths == 0.0) return;
  cell.matrix(axis, 0) = std::fma(-lengths, side, cell.matrix(axis, 0));
  cell.velocity.row(axis) -= lengths * cell.velocity.row(0);
  for (Contact<Dim>& c : packing.contacts) c.image[0] += static_cast<int>(lengths) * c.image[axis];
  wrap_into_cell(packing);
  refresh_contacts(packing);
}

template void reduce_tilt(Packing<2>&, int);
template void reduce_tilt(Packing<3>&, int);

}  // namespace floc
