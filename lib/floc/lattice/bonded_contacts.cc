#include "floc/lattice/bonded_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/contact/law_parameters.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/locate.h"

namespace floc {
namespace {

/// Smallest ratio of a limit in the contact law (adhesion, friction, rolling resistance) to the forces and moments of
/// the bonds.
constexpr double kMargin = 2.0;

void set_moment(const RotationVector<2>& moment, Contact<2>& c) {
  c.rolling_moment = moment;
}
void set_moment(const RotationVector<3>& moment, Contact<3>& c) {
  c.twisting_moment = c.normal.dot(moment);
  c.rolling_moment = moment - c.twisting_moment * c.normal;
}

/// Returns whether any bond resists twisting.
template <int Dim>
bool twists(const BondedContacts<Dim>& bonds) {
  return std::any_of(bonds.begin(), bonds.end(), [](const BondedContact<Dim>& b) { return b.twists; });
}

template <int Dim>
LawParameters law_for(const BondedContacts<Dim>& bonds) {
  double kn = 0.0, kt = 0.0, kr = 0.0, tension = 0.0, largest = 0.0;
  for (const BondedContact<Dim>& b : bonds) {
    kn += b.kn, kt += b.kt, kr += b.kr;
    tension = std::max(tension, -b.normal_force);
    largest = std::max({largest, std::abs(b.normal_force), b.shear_force.norm()});
  }
  const auto n = static_cast<double>(std::max<std::size_t>(1, bonds.size()));
  const double adhesion = largest > 0.0 ? std::max(kMargin * tension, 0.1 * largest) : 1.0;
  double coefficient = 0.1, arm = 0.0;
  for (const BondedContact<Dim>& b : bonds) {
    const double elastic = b.normal_force + adhesion;
    coefficient = std::max(coefficient, kMargin * b.shear_force.norm() / elastic);
    arm = std::max(arm, kMargin * b.moment.norm() / elastic);
  }
  LawParameters law;
  law.normal = LinearRepulsion{kn > 0.0 ? kn / n : 1.0};
  law.adhesion = ConstantAdhesion{adhesion};
  if (kt > 0.0) law.friction = CoulombFriction{coefficient, kt / n};
  if (kt > 0.0 && kr > 0.0) law.rolling = RollingSpring{std::max(arm, std::sqrt(kr / kn)), kr / n};
  // The elements of a lattice do not resist twisting.
  if (Dim == 3 && law.rolling && twists(bonds))
    law.twisting = TwistingSpring{law.rolling.template get<RollingSpring>().coefficient, kr / n};
  return law;
}

}  // namespace

template <int Dim>
void set_bonded_contacts(const BondedContacts<Dim>& bonds, Packing<Dim>& packing) {
  /// A force counts as mobilised if it differs from its limit by at most this fraction of the limit. The limits in the
  /// contact law are so large that no force of a bond is mobilised.
  constexpr double kCapTolerance = 1e-9;
  packing.law = law_for(bonds);
  packing.contacts.clear();
  packing.contacts.reserve(bonds.size());
  for (const BondedContact<Dim>& b : bonds) {
    Contact<Dim> c;
    c.i = b.i, c.j = b.j, c.image = b.image;
    place(locate(packing, c), c);
    c.normal_force = b.normal_force;
    c.shear_force = b.shear_force;
    set_moment(b.moment, c);
    set_given_forces(packing, b.kn, b.kt, kCapTolerance, c);
    if (packing.law.has_rolling()) c.kr = b.kr;
    if (packing.law.has_twisting()) c.ktw = b.kr;
    packing.contacts.push_back(c);
  }
  std::sort(packing.contacts.begin(), packing.contacts.end(), precedes<Contact<Dim>>);
}

template void set_bonded_contacts(const BondedContacts<2>&, Packing<2>&);
template void set_bonded_contacts(const BondedContacts<3>&, Packing<3>&);

}  // namespace floc
