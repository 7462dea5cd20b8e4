#include "floc/packing/locate.h"

#include "floc/packing/ball.h"

namespace floc {

template <int Dim>
ContactGeometry<Dim> locate_balls(const DoubleDoubleVec<Dim>& branch, double radius_i, double radius_j) {
  ContactGeometry<Dim> at;
  at.branch = rounded<Dim>(branch);
  at.normal = at.branch.normalized();
  at.gap = surface_gap<Dim>(branch, radius_i, radius_j);
  const double share_i = lever_share(radius_i, radius_j);
  at.arm_i = share_i * at.branch;
  at.arm_j = (share_i - 1.0) * at.branch;
  return at;
}

template <int Dim>
ContactGeometry<Dim> locate(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return locate_balls<Dim>(exact_branch(packing, contact), packing.grains.radius[contact.i],
                           packing.surface_radius(contact.j));
}

template <int Dim>
void place(const ContactGeometry<Dim>& geometry, Contact<Dim>& contact) {
  contact.gap = geometry.gap;
  contact.normal = geometry.normal;
  contact.arm_i = geometry.arm_i;
  contact.arm_j = geometry.arm_j;
}

template <int Dim>
void set_arms(Packing<Dim>& packing) {
  for (Contact<Dim>& c : packing.contacts) {
    const ContactGeometry<Dim> at = locate(packing, c);
    c.arm_i = at.arm_i;
    c.arm_j = at.arm_j;
  }
}

#define FLOC_INSTANTIATE(Dim)                                                              \
  template ContactGeometry<Dim> locate_balls(const DoubleDoubleVec<Dim>&, double, double); \
  template ContactGeometry<Dim> locate(const Packing<Dim>&, const Contact<Dim>&);          \
  template void place(const ContactGeometry<Dim>&, Contact<Dim>&);                         \
  template void set_arms(Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
