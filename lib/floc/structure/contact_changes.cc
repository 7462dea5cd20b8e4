#include "floc/structure/contact_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "floc/packing/contact_order.h"

namespace floc {
namespace {

/// The radii of a grain in two files count as equal if their relative difference is at most this value, because the
/// numbers in the files are rounded.
constexpr double kSameRadius = 1e-9;

/// Returns the integer matrix M that relates the lattice vectors of two states. If the rows of A and B are the lattice
/// vectors of the states before and after, then B = M A, up to a strain.
template <int Dim>
Mat<Dim> lattice_choice(const Cell<Dim>& before, const Cell<Dim>& after) {
  return (after.matrix * before.matrix.inverse()).array().round().matrix();
}

template <int Dim>
bool is_lattice_choice(const Mat<Dim>& choice) {
  return std::abs(std::abs(choice.determinant()) - 1.0) < 1e-6;
}

/// Returns the circular mean of each component of displacements in reduced coordinates. This mean is the same for any
/// choice of the periodic images of the grains.
template <int Dim>
Vec<Dim> circular_mean(const std::vector<Vec<Dim>>& displacement) {
  Vec<Dim> mean;
  for (int a = 0; a < Dim; ++a) {
    double sine = 0.0, cosine = 0.0;
    for (const Vec<Dim>& d : displacement) {
      sine += std::sin(2.0 * std::numbers::pi * d[a]);
      cosine += std::cos(2.0 * std::numbers::pi * d[a]);
    }
    mean[a] = std::atan2(sine, cosine) / (2.0 * std::numbers::pi);
  }
  return mean;
}

/// Identity of a contact, and index of the contact in the contact list. The identity consists of the two grains in
/// canonical order, the periodic image in the lattice of the state before, and a key that distinguishes several
/// contacts of one pair of grains. For grains with corners, a key in the contact list denotes corners, edges or faces,
/// which change while the two grains remain in contact. Here, the key is therefore set to 0.
template <int Dim>
struct Named {
  Contact<Dim> name;
  int index;
};

template <int Dim>
Contact<Dim> name_of(const Contact<Dim>& c, const Vec<Dim, int>& image) {
  Contact<Dim> name;
  name.i = c.i, name.j = c.j, name.image = image, name.key = c.key;
  return canonical(name);
}

template <int Dim>
std::vector<Named<Dim>> named(const Packing<Dim>& packing, const auto& image_of) {
  const std::vector<Contact<Dim>>& contacts = packing.contacts;
  std::vector<Named<Dim>> names;
  for (int c = 0; c < static_cast<int>(contacts.size()); ++c) {
    names.push_back({name_of(contacts[c], image_of(contacts[c])), c});
    if (!packing.grains.are_round()) names.back().name.key = 0;
  }
  std::stable_sort(names.begin(), names.end(),
                   [](const auto& p, const auto& q) { return precedes(p.name, q.name); });
  if (!packing.grains.are_round()) {
    const auto repeated =
        std::ranges::unique(names, [](const auto& p, const auto& q) { return same_pair(p.name, q.name); });
    names.erase(repeated.begin(), repeated.end());
  }
  return names;
}

/// Finds the contacts that are kept, lost and gained, in one pass through both lists of contacts, which are sorted.
template <int Dim>
void match(const Packing<Dim>& before, const Packing<Dim>& after, const std::vector<Named<Dim>>& old_names,
           const std::vector<Named<Dim>>& new_names, ContactChanges<Dim>& out) {
  const auto lose = [&](int c) {
    if (!before.contacts[c].distant) out.lost.push_back(c);
  };
  const auto gain = [&](int c) {
    if (!after.contacts[c].distant) out.gained.push_back(c);
  };
  std::size_t p = 0, q = 0;
  while (p < old_names.size() || q < new_names.size()) {
    if (q == new_names.size() || (p < old_names.size() && precedes(old_names[p].name, new_names[q].name))) {
      lose(old_names[p++].index);
    } else if (p == old_names.size() || precedes(new_names[q].name, old_names[p].name)) {
      gain(new_names[q++].index);
    } else {
      const int c = old_names[p++].index, d = new_names[q++].index;
      const bool touched = !before.contacts[c].distant, touches = !after.contacts[d].distant;
      if (touched && touches) {
        out.kept.push_back({c, d});
      } else {
        out.n_parted += touched ? 1 : 0;
        lose(c);
        gain(d);
      }
    }
  }
}

}  // namespace

template <int Dim>
double ContactChanges<Dim>::rms_displacement() const {
  double sum = 0.0;
  for (const Vec<Dim>& u : displacement) sum += u.squaredNorm();
  return displacement.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(displacement.size()));
}

template <int Dim>
double ContactChanges<Dim>::largest_displacement() const {
  double largest = 0.0;
  for (const Vec<Dim>& u : displacement) largest = std::max(largest, u.norm());
  return largest;
}

template <int Dim>
std::string incomparable(const Packing<Dim>& before, const Packing<Dim>& after) {
  if (!before.walls.empty() || !after.walls.empty())
    return "the grains are between walls, but contacts can be compared only in periodic cells";
  if (before.grains.size() != after.grains.size())
    return fmt::format(
        "there are {} grains in one state, but {} in the other: both must be states of the same grains",
        before.grains.size(), after.grains.size());
  for (int i = 0; i < before.grains.size(); ++i)
    if (std::abs(before.grains.radius[i] - after.grains.radius[i]) > kSameRadius * before.grains.radius[i])
      return fmt::format(
          "grain {} has radius {:.10g} in one state, but {:.10g} in the other: both must be states of the same "
          "grains",
          before.grains.name(i), before.grains.radius[i], after.grains.radius[i]);
  if (before.grains.are_round() != after.grains.are_round())
    return "the grains have corners in one of the states only: both must be states of the same grains";
  if (!is_lattice_choice<Dim>(lattice_choice(before.cell, after.cell)))
    return "the two cells do not correspond: no strain, with any choice of lattice vectors, turns one into "
           "the other";
  return {};
}

template <int Dim>
ContactChanges<Dim> contact_changes(const Packing<Dim>& before, const Packing<Dim>& after) {
  assert(incomparable(before, after).empty());
  ContactChanges<Dim> out;
  const Mat<Dim> choice = lattice_choice(before.cell, after.cell);
  const Mat<Dim, int> images = choice.transpose().template cast<int>();
  out.cell_after = choice.inverse() * after.cell.matrix;
  out.deformation = out.cell_after.transpose() * before.cell.matrix.transpose().inverse();

  // Displacements are computed in reduced coordinates, where the affine part is zero. First, the circular mean of the
  // displacements is subtracted; it does not depend on the periodic images of the grains. Then, whole cells are
  // subtracted from each displacement. In the opposite order, grains that moved together by half a cell would be
  // separated.
  const int n = before.grains.size();
  const Mat<Dim> to_reduced = out.cell_after.transpose().inverse();
  std::vector<Vec<Dim>> moved(n);
  for (int i = 0; i < n; ++i)
    moved[i] = to_reduced * after.grains.position[i] - before.cell.reduced(before.grains.position[i]);
  const Vec<Dim> common = circular_mean<Dim>(moved);
  Vec<Dim> mean = Vec<Dim>::Zero();
  out.wrapped.resize(n);
  for (int i = 0; i < n; ++i) {
    moved[i] -= common;
    const Vec<Dim> cells = moved[i].array().round().matrix();
    out.wrapped[i] = cells.template cast<int>();
    moved[i] -= cells;
    mean += moved[i] / n;
  }
  for (int i = 0; i < n; ++i) out.displacement.push_back(out.cell_after.transpose() * (moved[i] - mean));

  // The image of a contact changes if other lattice vectors are chosen, or if a grain crosses the border of the cell,
  // although the contact remains the same. Contacts of both states are therefore identified by their image in the
  // lattice of `before`.
  const auto old_names = named<Dim>(before, [](const Contact<Dim>& c) { return c.image; });
  const auto new_names = named<Dim>(after, [&](const Contact<Dim>& c) -> Vec<Dim, int> {
    return images * c.image + out.wrapped[c.j] - out.wrapped[c.i];
  });
  match(before, after, old_names, new_names, out);
  return out;
}

#define FLOC_INSTANTIATE(Dim)                                                  \
  template struct ContactChanges<Dim>;                                         \
  template std::string incomparable(const Packing<Dim>&, const Packing<Dim>&); \
  template ContactChanges<Dim> contact_changes(const Packing<Dim>&, const Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
