#include "floc/io/listed_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/packing/law/contact_forces.h"

namespace floc {
namespace {

/// A tangential force counts as mobilised (at the limit of friction) if it differs from this limit by at most this
/// fraction of the limit. The fraction is the rounding error of six digits, because files print forces with six digits
/// or more.
constexpr double kCapTolerance = 1e-6;
/// A tangential force below this fraction of the normal force of the same contact counts as a rounding error.
constexpr double kNoShear = 1e-9;
/// Rounding error of a scalar product, divided by the product of the lengths of the two vectors.
constexpr double kRounding = 1e-15;
/// Largest accepted difference, divided by the total force, between the normal force of a contact and the normal
/// component of its total force, if a file lists both forces. The same holds for tangential forces. If positions are
/// rounded to six digits, the contact normal rotates, and the components change by less than this fraction.
constexpr double kSameForce = 1e-3;

}  // namespace

template <int Dim>
GivenForces<Dim> given_forces(const ListedContact& listed, bool reversed, const Vec<Dim>& normal) {
  const double sign = reversed ? -1.0 : 1.0;
  GivenForces<Dim> given;
  given.normal = listed.normal_force;
  if (listed.shear_force) {
    const Vec<Dim> on_first = sign * listed.shear_force->template head<Dim>();
    const double along = normal.dot(on_first);
    // The normal component of a listed tangential force is subtracted if it exceeds rounding errors. A smaller
    // component is not subtracted, so that the force keeps all of its digits.
    given.shear = on_first;
    if (std::abs(along) > kRounding * on_first.norm()) *given.shear -= normal * along;
    const double largest = std::max(on_first.norm(), std::abs(listed.normal_force.value_or(0.0)));
    if (!listed.force && std::abs(along) > kSameForce * largest)
      throw InputError(
          listed.place.text(),
          fmt::format("the tangential force has the component {:.6g} along the contact normal, expected a "
                      "force perpendicular to the normal; list a whole force in force1.. instead",
                      along));
  }
  if (listed.force) {
    const Vec<Dim> on_first = sign * listed.force->template head<Dim>();
    given.normal = -normal.dot(on_first);
    if (listed.normal_force &&
        !(std::abs(*listed.normal_force - *given.normal) <= kSameForce * on_first.norm()))
      throw InputError(listed.place.text(),
                       fmt::format("normal_force = {:.6g}, but the total force listed for the same contact has "
                                   "the normal component {:.6g}: leave out one of these two forces",
                                   *listed.normal_force, *given.normal));
    const Vec<Dim> across = on_first + *given.normal * normal;
    // The sum of both lists contains the tangential force twice if force1.. is the whole force.
    const double same = kSameForce * on_first.norm();
    if (given.shear && given.shear->norm() > same && (across - 2.0 * *given.shear).norm() <= same)
      throw InputError(
          listed.place.text(),
          fmt::format("force1.. has the tangential part {:.6g} that shear_force1.. lists again: beside these "
                      "columns it must be the normal part of the force; leave out one of the two",
                      given.shear->norm()));
    given.shear = across;
  }
  if (listed.rolling_moment) given.rolling = sign * listed.rolling_moment->template tail<kRotations<Dim>>();
  given.twisting = listed.twisting_moment;
  return given;
}

template <int Dim>
void set_forces(const Packing<Dim>& packing, const ListedContact& listed, const GivenForces<Dim>& given,
                Contact<Dim>& c) {
  const Law& law = packing.law_of(c);
  if (given.normal) c.normal_force = *given.normal;
  if (given.shear && law.has_friction()) c.shear_force = *given.shear;
  if (given.shear && !law.has_friction() && given.shear->norm() > kNoShear * std::abs(c.normal_force))
    throw InputError(
        listed.place.text(),
        fmt::format("the tangential force is {:.6g}, but the law has no friction", given.shear->norm()));
  if (given.rolling && !given.rolling->isZero(0.0) && !law.has_rolling())
    throw InputError(listed.place.text(), "a rolling moment is listed, but the law has no rolling resistance");
  if (given.rolling && law.has_rolling()) c.rolling_moment = *given.rolling;
  if (given.twisting && *given.twisting != 0.0 && !law.has_twisting())
    throw InputError(listed.place.text(),
                     "a twisting moment is listed, but the law has no twisting resistance");
  if (given.twisting && law.has_twisting()) c.twisting_moment = *given.twisting;
  if (given.normal || given.shear || given.rolling || given.twisting)
    set_given_forces(packing, listed.kn, listed.kt, kCapTolerance, c);
  if (listed.kr && *listed.kr != 0.0 && !law.has_rolling())
    throw InputError(listed.place.text(),
                     "a rolling stiffness is listed, but the law has no rolling resistance");
  if (listed.kr && law.has_rolling() && !c.distant) c.kr = *listed.kr;
  if (listed.ktw && *listed.ktw != 0.0 && !law.has_twisting())
    throw InputError(listed.place.text(),
                     "a twisting stiffness is listed, but the law has no twisting resistance");
  if (listed.ktw && law.has_twisting() && !c.distant) c.ktw = *listed.ktw;
}

void require_stiffness(const ListedContact& listed, const char* name, const std::optional<double>& value,
                       bool right, const std::string& expected) {
  if (value && !right)
    throw InputError(listed.place.text(), fmt::format("{} = {}, expected {}", name, *value, expected));
}

void require_stiffnesses(const ListedContact& listed) {
  require_stiffness(listed, "kt", listed.kt, listed.kt >= 0.0, "a tangential stiffness >= 0");
  require_stiffness(listed, "kr", listed.kr, listed.kr >= 0.0, "a rolling stiffness >= 0");
  require_stiffness(listed, "ktw", listed.ktw, listed.ktw >= 0.0, "a twisting stiffness >= 0");
}

#define FLOC_INSTANTIATE(Dim)                                                          \
  template GivenForces<Dim> given_forces(const ListedContact&, bool, const Vec<Dim>&); \
  template void set_forces(const Packing<Dim>&, const ListedContact&, const GivenForces<Dim>&, Contact<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
