#include "floc/io/merge_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "floc/io/listed_bodies.h"

namespace floc {
namespace {

/// Key that identifies a pair of grains and the periodic image of the second grain. The key does not depend on the
/// order of the two grains.
using Pair = std::tuple<std::int64_t, std::int64_t, int, int, int>;

/// Whether the two bodies of a contact are in ascending order of their identifiers. For a grain and its own image, the
/// sign of the image decides.
bool ascending(const ListedContact& c) {
  const Eigen::Vector3i none = Eigen::Vector3i::Zero();
  if (c.id1 != c.id2 || !c.image) return c.id1 <= c.id2;
  return !std::lexicographical_compare(c.image->begin(), c.image->end(), none.begin(), none.end());
}

Pair pair_of(const ListedContact& c) {
  const Eigen::Vector3i image =
      c.image.value_or(Eigen::Vector3i(Eigen::Vector3i::Zero())) * (ascending(c) ? 1 : -1);
  if (c.wall) return {c.id1, -1, c.wall->axis, c.wall->side, 0};
  return {std::min(c.id1, c.id2), std::max(c.id1, c.id2), image[0], image[1], image[2]};
}

/// Whether two rows of the same pair contain the same forces, within rounding to four digits.
/// @param mirrored  whether the rows name the two grains in opposite order
bool agree(const ListedContact& a, ListedContact b, bool mirrored) {
  constexpr double kDigits = 1e-4;
  if (mirrored) reverse_actions(b);
  const auto same = [&](const std::optional<Eigen::Vector3d>& v, const std::optional<Eigen::Vector3d>& w) {
    return v.has_value() == w.has_value() &&
           (!v || (*v - *w).norm() <= kDigits * std::max(v->norm(), w->norm()));
  };
  const double f = a.normal_force.value_or(0.0), g = b.normal_force.value_or(0.0);
  return same(a.force, b.force) && same(a.shear_force, b.shear_force) &&
         std::abs(f - g) <= kDigits * std::max(std::abs(f), std::abs(g));
}

}  // namespace

std::string merge_pairs(std::vector<ListedContact>& contacts) {
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pair_of(contacts[a]) < pair_of(contacts[b]); });
  std::vector<bool> second(contacts.size(), false);
  std::size_t n_merged = 0, n_different = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    const ListedContact &a = contacts[order[k - 1]], &b = contacts[order[k]];
    if (second[order[k - 1]] || pair_of(a) != pair_of(b)) continue;
    second[order[k]] = true;
    ++n_merged;
    n_different += !agree(a, b, ascending(a) != ascending(b));
  }
  std::vector<ListedContact> kept;
  kept.reserve(contacts.size() - n_merged);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (!second[c]) kept.push_back(std::move(contacts[c]));
  const std::size_t n_read = contacts.size();
  contacts = std::move(kept);
  return fmt::format(
      "{} of the {} listed contacts repeat an earlier pair of grains and are left out; {} of these contacts "
      "contradict the forces in the earlier row of the pair",
      n_merged, n_read, n_different);
}

}  // namespace floc
