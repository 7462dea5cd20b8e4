#include "floc/verification/shape_criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/packing/contact_order.h"
#include "floc/verification/contact_check.h"

namespace floc {
namespace {

/// Returns whether a list of contacts, sorted like the contacts of a packing, contains a contact between the two bodies
/// of `c`.
template <int Dim>
bool has_pair(const std::vector<Contact<Dim>>& sorted, Contact<Dim> c) {
  c.key = std::numeric_limits<int>::min();
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), c, precedes<Contact<Dim>>);
  return at != sorted.end() && same_pair(*at, c);
}

}  // namespace

Criterion concluded(Criterion criterion, Violations& violations) {
  criterion.where = violations.worst_first();
  criterion.holds = criterion.where.empty();
  criterion.by_value = !(criterion.value <= criterion.limit);
  return criterion;
}

template <int Dim>
void compare_contact(const Packing<Dim>& stored, const Contact<Dim>& c, const Contact<Dim>& found,
                     Criterion& result, Violations& violations) {
  // All three errors have to be lengths. The error of the normal is therefore multiplied by the length of the branch
  // vector (from centre to centre). The product is about the displacement of a grain that would turn the normal by this
  // error.
  const double error =
      std::max({std::abs(c.gap - found.gap), (c.normal - found.normal).norm() * branch(stored, c).norm(),
                (c.arm_i - found.arm_i).norm()});
  result.value = std::max(*result.value, error);
  if (!(error <= result.limit))
    violations.add(error, fmt::format("{} by {:.2g}", pair_name(stored, c), error));
  else if (c.type != found.type)
    // A wrong type has no magnitude. The value 0 places it behind all errors of the geometry in the message.
    violations.add(0.0,
                   fmt::format("{}, recorded as a contact of the type {} instead of {}", pair_name(stored, c),
                               contact_type_name(c.type), contact_type_name(found.type)));
}

template <int Dim>
void add_lost_contact(const Packing<Dim>& stored, const Contact<Dim>& c, Violations& violations) {
  violations.add(std::numeric_limits<double>::infinity(),
                 pair_name(stored, c) + ", which have no contact point there");
}

template <int Dim>
Criterion check_shape_geometry(const Packing<Dim>& stored, const std::vector<Contact<Dim>>& found) {
  Criterion result{"geometry", 0.0, distance_error(stored), true, ""};
  Violations violations;
  for (std::size_t k = 0; k < stored.contacts.size(); ++k) {
    const Contact<Dim>&c = stored.contacts[k], &r = found[k];
    // An infinite gap marks two bodies without a contact point. This violation has no finite error, so it does not
    // change the value of the criterion.
    if (std::isinf(r.gap))
      add_lost_contact(stored, c, violations);
    else
      compare_contact(stored, c, r, result, violations);
  }
  return concluded(result, violations);
}

template <int Dim>
Criterion check_shape_list(const Packing<Dim>& packing, const RigidGeometry<Dim>& geometry) {
  Violations violations;
  int n_wrong = 0;
  const auto wrong = [&](const std::string& what) { violations.add(0.0, what), ++n_wrong; };
  const std::vector<Contact<Dim>>& contacts = packing.contacts;
  for (std::size_t k = 1; k < contacts.size(); ++k)
    if (!precedes(contacts[k - 1], contacts[k]))
      wrong(pair_name(packing, contacts[k]) + " are in the contact list twice or out of order");
  std::vector<Contact<Dim>> sorted = contacts;
  std::ranges::sort(sorted, precedes<Contact<Dim>>);
  for (const Contact<Dim>& c : geometry.overlapping)
    if (!has_pair(sorted, c))
      wrong(fmt::format("{} are missing in the contact list although they overlap by {:.2g}",
                        pair_name(packing, c), -c.gap));
  return {"list", static_cast<double>(n_wrong), 0.0, n_wrong == 0, violations.worst_first()};
}

#define FLOC_INSTANTIATE(Dim)                                                                              \
  template void compare_contact(const Packing<Dim>&, const Contact<Dim>&, const Contact<Dim>&, Criterion&, \
                                Violations&);                                                              \
  template void add_lost_contact(const Packing<Dim>&, const Contact<Dim>&, Violations&);                   \
  template Criterion check_shape_geometry(const Packing<Dim>&, const std::vector<Contact<Dim>>&);          \
  template Criterion check_shape_list(const Packing<Dim>&, const RigidGeometry<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
