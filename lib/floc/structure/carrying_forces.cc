#include "floc/structure/carrying_forces.h"

#include <algorithm>
#include <cmath>

#include "floc/structure/mobilisation.h"

namespace floc {
namespace {

void count(int dimension, const CarryingStructure& carrying, CarryingForces& out) {
  const auto n = static_cast<double>(carrying.rattler.size());
  if (n == 0.0) return;
  out.n_contacts = static_cast<int>(carrying.contacts.size());
  out.z = 2.0 * out.n_contacts / n;
  out.x0 = carrying.n_rattlers / n;
  out.x2 = static_cast<double>(std::count(carrying.degree.begin(), carrying.degree.end(), 2)) / n;
  if (carrying.n_held() == 0) return;
  out.z_star = 2.0 * out.n_contacts / carrying.n_held();
  if (dimension == 3) out.z_star_star = out.z_star + 2.0 * out.x2 / (3.0 * (1.0 - out.x0));
}

/// Returns the reduced moment `<N^q>/<N>^q` of the elastic normal forces N of the force-carrying contacts.
/// @param mean  mean `<N>`, > 0
template <int Dim>
double reduced_moment(const Packing<Dim>& packing, const CarryingStructure& carrying, double mean, double q) {
  double sum = 0.0;
  for (const int k : carrying.contacts) sum += std::pow(packing.contacts[k].elastic_force / mean, q);
  return sum / static_cast<double>(carrying.contacts.size());
}

/// Returns the fabric tensor of the strong contacts if `strong` is true, otherwise of the weak contacts. A contact is
/// strong if its elastic normal force is above the mean. The tensor is the sum of n n - 1/Dim over the strong or the
/// weak contacts, divided by the number of all force-carrying contacts; n is the normal of a contact.
template <int Dim>
Mat<Dim> fabric_of(const Packing<Dim>& packing, const CarryingStructure& carrying, double mean, bool strong) {
  Mat<Dim> sum = Mat<Dim>::Zero();
  for (const int k : carrying.contacts) {
    const Contact<Dim>& c = packing.contacts[k];
    if ((c.elastic_force > mean) == strong) sum += c.normal * c.normal.transpose() - Mat<Dim>::Identity() / Dim;
  }
  return sum / static_cast<double>(carrying.contacts.size());
}

}  // namespace

template <int Dim>
CarryingForces carrying_forces(const Packing<Dim>& packing, const CarryingStructure& carrying) {
  CarryingForces out;
  out.fabric = out.strong_fabric = out.weak_fabric = Mat<Dim>::Zero();
  count(Dim, carrying, out);
  if (carrying.contacts.empty()) return out;
  double mean = 0.0;
  for (const int k : carrying.contacts) {
    const Contact<Dim>& c = packing.contacts[k];
    mean += c.elastic_force / out.n_contacts;
    out.sliding_share += (c.sliding ? 1.0 : 0.0) / out.n_contacts;
    out.fabric += c.normal * c.normal.transpose() / out.n_contacts;
  }
  out.fabric -= Mat<Dim>::Identity() / Dim;
  out.strong_fabric = fabric_of(packing, carrying, mean, true);
  out.weak_fabric = fabric_of(packing, carrying, mean, false);
  if (!(mean > 0.0)) return out;
  out.Z_third = reduced_moment(packing, carrying, mean, 1.0 / 3.0);
  out.Z2 = reduced_moment(packing, carrying, mean, 2.0);
  out.Z_five_thirds = reduced_moment(packing, carrying, mean, 5.0 / 3.0);
  MobilisationByForce mobilisation(mean);
  for (const int k : carrying.contacts) mobilisation.add(packing.contacts[k]);
  out.M1 = mobilisation.M1();
  out.M2 = mobilisation.M2();
  return out;
}

template CarryingForces carrying_forces(const Packing<2>&, const CarryingStructure&);
template CarryingForces carrying_forces(const Packing<3>&, const CarryingStructure&);

}  // namespace floc
