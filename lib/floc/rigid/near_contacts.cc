#include "floc/rigid/near_contacts.h"

#include <algorithm>
#include <limits>

#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/rigid/contact_points.h"

namespace floc {
namespace {

/// Two contact points of a pair of shapes count as one point if their distance, divided by the smaller radius, is below
/// this value. Their keys may differ, because several features of the shapes may be equally near.
constexpr double kOnePoint = 1e-3;

/// Returns whether a sorted list of contacts contains a contact point. For round grains, equal keys mean equal points.
/// @param last  end of the list
template <int Dim, class Iterator>
bool has_point(const Packing<Dim>& packing, Iterator first, Iterator last, const Contact<Dim>& point) {
  const auto same = std::lower_bound(first, last, point, precedes<Contact<Dim>>);
  if (same != last && !precedes(point, *same)) return true;
  if (packing.grains.are_round()) return false;
  Contact<Dim> lowest = point;
  lowest.key = std::numeric_limits<int>::min();
  const double radius = smaller_radius(packing, point);
  for (auto c = std::lower_bound(first, last, lowest, precedes<Contact<Dim>>);
       c != last && same_pair(*c, point); ++c)
    if ((c->arm_i - point.arm_i).norm() < kOnePoint * radius) return true;
  return false;
}

}  // namespace

template <int Dim>
int add_near_contacts(Packing<Dim>& packing, double gap) {
  const std::size_t before = packing.contacts.size();
  for (const Contact<Dim>& contact : ContactPoints<Dim>().find(packing, gap)) {
    const auto known = packing.contacts.begin() + static_cast<std::ptrdiff_t>(before);
    if (!has_point(packing, packing.contacts.begin(), known, contact)) packing.contacts.push_back(contact);
  }
  std::ranges::sort(packing.contacts, precedes<Contact<Dim>>);
  return static_cast<int>(packing.contacts.size() - before);
}

template int add_near_contacts(Packing<2>&, double);
template int add_near_contacts(Packing<3>&, double);

}  // namespace floc
