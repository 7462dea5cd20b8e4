#include "floc/assembly/box_options.h"

#include <algorithm>
#include <limits>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"
#include "floc/packing/grain_sizes.h"

namespace floc {

Law wall_law(const Law& grains, const BoxOptions& box) {
  LawParameters law = grains;
  if (box.adhesion == 0.0) law.adhesion.reset();
  // liquid bridges do not form at walls; the wall may attract grains with a constant force instead
  else if (!law.adhesion || law.adhesion.holds<CapillaryAdhesion>())
    law.adhesion = ConstantAdhesion{box.adhesion};
  if (box.friction == 0.0) {
    law.friction.reset();
    law.rolling.reset();
    law.twisting.reset();
  } else if (grains.is_rigid() && !law.friction) {
    law.friction = RigidFriction{box.friction};
  }
  for (const LawNumber& n : numbers_of(law)) {
    if (n.key == "adhesion.force") *n.value = box.adhesion;
    if (n.key == "friction.coefficient") *n.value = box.friction;
  }
  return law;
}

bool any_wall_moves(const BoxOptions& box, int dimension) {
  return std::any_of(box.boundary.begin(), box.boundary.begin() + dimension, moves);
}

template <int Dim>
std::vector<Wall<Dim>> walls_around(const Packing<Dim>& packing, const BoxOptions& box,
                                    const Vec<Dim>& lowest) {
  std::vector<Wall<Dim>> walls;
  for (int a = 0; a < Dim; ++a) {
    if (box.boundary[a] == BoxSide::periodic) continue;
    const BoxSide side = box.boundary[a];
    const double fixed = std::numeric_limits<double>::infinity();
    const double moving = box.mass * largest_mass(packing.grains);
    walls.push_back({a, -1, lowest[a], 0.0, side == BoxSide::walls ? moving : fixed});
    walls.push_back({a, +1, lowest[a] + packing.cell.matrix(a, a), 0.0, moves(side) ? moving : fixed,
                     side == BoxSide::floor});
  }
  return walls;
}

template std::vector<Wall<2>> walls_around(const Packing<2>&, const BoxOptions&, const Vec<2>&);
template std::vector<Wall<3>> walls_around(const Packing<3>&, const BoxOptions&, const Vec<3>&);

}  // namespace floc
