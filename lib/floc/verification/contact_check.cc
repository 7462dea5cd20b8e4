#include "floc/verification/contact_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/neighbors/interacting_pairs.h"
#include "floc/neighbors/unlisted_pairs.h"
#include "floc/packing/body_name.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/liquid/liquid.h"

namespace floc {
namespace {

/// Largest accepted excess of a tangential force (or moment) above its limit, divided by the limit. This value is
/// sufficient for files with only six digits, in which forces and contact normals are rounded.
constexpr double kCapTolerance = 1e-4;
/// Largest tensile normal force that counts as a rounding error, divided by the largest normal force of the packing.
constexpr double kNoForce = 1e-9;

template <int Dim>
std::string names_of(const Packing<Dim>& packing, const Contact<Dim>& c) {
  return fmt::format("{}-{}", packing.grains.name(c.i), body_name(packing, c.j));
}

/// Returns the normal force that the contact law gives at the present gap of a contact. A linear law is evaluated with
/// the stiffness of the contact. A contact with a linear spring may be marked as touching although its surfaces have a
/// gap; the returned force is then tensile.
template <int Dim>
double expected_normal_force(const Packing<Dim>& packing, const Contact<Dim>& c) {
  const Law& law = packing.law_of(c);
  if (!c.distant && law.force_exponent() == 1.0 && !law.keeps_overlap())
    return -c.kn * c.gap - (touches(packing, c) ? pull_off_force(packing, c) : 0.0);
  Contact<Dim> by_law = c;
  refresh_contact(packing, by_law);
  return by_law.normal_force;
}

template <int Dim>
void add_forces(const Packing<Dim>& packing, double tolerance, ContactCheck& check) {
  double mean = 0.0;
  for (const Contact<Dim>& c : packing.contacts) mean += std::abs(c.normal_force);
  mean /= std::max<double>(1.0, static_cast<double>(packing.contacts.size()));
  const double unit = mean > 0.0 ? mean : 1.0;
  const double open = distance_error(packing);
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.bonded || packing.law_of(c).is_rigid()) continue;
    const double difference = std::abs(c.normal_force - expected_normal_force(packing, c));
    if (difference / unit > check.largest_difference) {
      check.largest_difference = difference / unit;
      check.most_different = names_of(packing, c);
    }
    if (difference > tolerance * unit + std::abs(c.kn) * open) ++check.n_different;
  }
}

}  // namespace

template <int Dim>
double distance_error(const Packing<Dim>& packing) {
  const auto& radius = packing.grains.radius;
  const double largest = 2.0 * *std::max_element(radius.begin(), radius.end());
  return 64.0 * std::numeric_limits<double>::epsilon() * (packing.cell.matrix.cwiseAbs().sum() + largest);
}

template <int Dim>
std::vector<Contact<Dim>> missing_contacts(const Packing<Dim>& packing, double open) {
  std::vector<Contact<Dim>> missing = unlisted_pairs(packing, interacting_pairs(packing));
  for (Contact<Dim>& c : missing) refresh_contact(packing, c);
  std::erase_if(missing, [&](const Contact<Dim>& c) { return !(c.gap < packing.law_of(c).range() - open); });
  return missing;
}

template <int Dim>
ContactCheck check_contacts(const Packing<Dim>& packing, double tolerance) {
  ContactCheck check;
  check.n_contacts = static_cast<int>(packing.contacts.size());
  double largest = 0.0;
  for (const Contact<Dim>& c : packing.contacts) largest = std::max(largest, std::abs(c.normal_force));
  for (const Contact<Dim>& c : packing.contacts) {
    check.n_bonds += c.bonded;
    check.n_with_gap += !c.distant && !touches(packing, c);
    check.n_distant += c.distant;
    check.n_pulling += !c.bonded && c.normal_force < -kNoForce * largest;
    check.n_mobilised += c.is_mobilised();
    const Mobilised beyond = mobilised(packing.law_of(c), c, -kCapTolerance);
    check.n_beyond_cap += (beyond.sliding && !c.shear_force.isZero(0.0)) ||
                          (beyond.rolling && !c.rolling_moment.isZero(0.0)) ||
                          (beyond.twisting && c.twisting_moment != 0.0);
  }
  add_forces(packing, tolerance, check);
  return check;
}

template <int Dim>
void add_missing_contacts(const Packing<Dim>& packing, ContactCheck& check) {
  const std::vector<Contact<Dim>> missing = missing_contacts(packing, distance_error(packing));
  check.n_missing = static_cast<int>(missing.size());
  if (!missing.empty())
    check.missing = fmt::format("{} at a gap of {:.2g}", names_of(packing, missing[0]), missing[0].gap);
}

template <int Dim>
double relative_distance_error(const Packing<Dim>& packing) {
  return distance_error(packing) / (2.0 * *std::ranges::min_element(packing.grains.radius));
}

#define FLOC_INSTANTIATE(Dim)                                                       \
  template double distance_error(const Packing<Dim>&);                              \
  template double relative_distance_error(const Packing<Dim>&);                     \
  template std::vector<Contact<Dim>> missing_contacts(const Packing<Dim>&, double); \
  template ContactCheck check_contacts(const Packing<Dim>&, double);                \
  template void add_missing_contacts(const Packing<Dim>&, ContactCheck&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
