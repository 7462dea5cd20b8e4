#include "floc/io/listed_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/contact/adhesion/capillary_adhesion.h"
#include "floc/io/listed_forces.h"
#include "floc/io/listed_images.h"
#include "floc/io/listed_misfits.h"
#include "floc/io/listed_points.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/stiffness_check.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/locate.h"

namespace floc {
namespace {

/// A force below this fraction of the largest listed force counts as a rounding error.
constexpr double kNoForce = 1e-9;
/// Two grains cannot be in contact if the gap between them exceeds the range of the law by more than this fraction of
/// their mean radius. The fraction is large because a file may have few digits.
constexpr double kFarthestGap = 0.1;

/// Whether the two grains of a contact must be exchanged so that the grain with the lower index comes first. For a
/// contact of a grain with its own image, the answer is true if find_pairs() uses the opposite image.
template <int Dim>
bool is_reversed(const Contact<Dim>& c) {
  if (c.i != c.j) return c.i > c.j;
  const Vec<Dim, int> zero = Vec<Dim, int>::Zero();
  return std::lexicographical_compare(c.image.begin(), c.image.end(), zero.begin(), zero.end());
}

/// Returns the name of the second body of a listed contact.
std::string second_name(const ListedContact& row) {
  return row.wall ? row.wall->name() : std::to_string(row.id2);
}

/// Makes the contacts of a packing from the contacts that a file lists. Counts the listed contacts that are left out
/// and the listed images that are replaced.
template <int Dim>
class ListedContacts {
 public:
  ListedContacts(const ListedPacking& listed, const Identifiers& identifiers, const Packing<Dim>& packing)
      : listed_(listed),
        identifiers_(identifiers),
        packing_(packing),
        half_width_(0.5 * smallest_width(packing)) {
    if (!listed.contacts) return;
    counts_.n_read = static_cast<int>(listed.contacts->size());
    for (const ListedContact& row : *listed.contacts) largest_force_ = std::max(largest_force_, force_of(row));
  }

  /// Makes the contact that one row of the table lists. Listed forces replace the forces of the law. Returns nothing if
  /// the contact is left out.
  std::optional<Contact<Dim>> place(const ListedContact& row) {
    Contact<Dim> c;
    c.i = identifiers_.index(row.place, "id1", row.id1);
    c.j = row.wall ? wall_of(row) : identifiers_.index(row.place, "id2", row.id2);
    set_liquid(row, c);
    if (!row.wall) set_image(row, c);
    if (!packing_.grains.are_round()) return point(row, c);
    floc::place(locate(packing_, c), c);
    const double gap = c.gap;
    if (is_bond(row, c)) return bond(row, c);
    if (row.across_no_lattice && !can_touch(c)) return distant_force(row, c);
    const bool wet = bridge_volume(packing_, c) != 0.0;
    if (!touches(packing_, c) && gap >= range_of(packing_, c) && !wet &&
        force_of(row) <= kNoForce * largest_force_) {
      if (!row.force && !row.normal_force)
        throw InputError(
            row.place.text(),
            fmt::format(
                "the gap is {}, at which the law gives no force, and no normal_force is listed for the contact",
                gap) +
                counting_hint(listed_));
      ++counts_.n_neighbors;
      return std::nullopt;
    }
    require_one_image(row, c);
    require_possible(row, c);
    const bool reversed = put_in_order(c);
    refresh_contact(packing_, c);
    require_direction(row, c);
    const GivenForces<Dim> given = given_forces<Dim>(row, reversed, c.normal);
    if (!given.normal && row.has_stiffness())
      throw InputError(row.place.text(),
                       "a stiffness is listed for the contact, but no normal force: expected both");
    if (given.normal && pulls_without_adhesion(row, *given.normal, c)) return std::nullopt;
    require_stiffnesses(row);
    set_forces(packing_, row, given, c);
    // For surfaces that touch, kn must be positive. For an attraction across a gap, kn is negative. Rigid contacts have
    // no stiffness, and the contacts of a state list it as zero.
    if (!c.distant && !(row.kn == 0.0 && packing_.law_of(c).is_rigid()))
      require_stiffness(
          row, "kn", row.kn, row.kn > 0.0,
          touches(packing_, c)
              ? "a positive number, because the surfaces touch"
              : "a positive number, because the law does not attract across this gap" + hint_of_liquid(row));
    compare_stiffnesses(row, c);
    return c;
  }

  ListedContactCounts counts() const {
    ListedContactCounts counts = counts_;
    counts.stiffness_differences = stiffnesses_.differences(packing_.law.force_exponent());
    counts.misfit = misfits_.sentence();
    return counts;
  }

  /// Throws if at least one contact was left out because its force is tensile and the law has no adhesion.
  /// @throws InputError naming the first of these contacts
  void require_no_tensile() const {
    if (counts_.n_tensile == 0) return;
    const bool adhesive_law_exists = packing_.law.force_exponent() == 1.0;
    throw InputError(
        first_tensile_.row->place.text(),
        fmt::format(
            "the contact of grains {} and {} carries a tensile force of {:.6g}, and {} of the {} listed "
            "contacts are tensile, but the law has no adhesion: {}, or leave out tensile contacts with "
            "--drop-tensile",
            first_tensile_.row->id1, second_name(*first_tensile_.row), -first_tensile_.normal_force,
            counts_.n_tensile, counts_.n_read,
            adhesive_law_exists
                ? "give adhesion.force in --law, with adhesion.law=constant if grains attract each other in "
                  "contact only, or with adhesion.range"
                : "adhesion is possible with the linear law only (normal.stiffness, adhesion.force)"));
  }

 private:
  struct Tensile {
    const ListedContact* row = nullptr;
    double normal_force = 0.0;
  };

  /// Returns the index of the wall that a contact refers to.
  /// @throws InputError if the packing has no such wall
  int wall_of(const ListedContact& row) const {
    for (std::size_t w = 0; w < packing_.walls.size(); ++w) {
      const Wall<Dim>& wall = packing_.walls[w];
      if (wall.axis == row.wall->axis && wall.side == row.wall->side && !wall.open)
        return packing_.grains.size() + static_cast<int>(w);
    }
    throw InputError(
        row.place.text(),
        fmt::format(
            "the contact is between grain {} and the wall {}, but the packing has no such wall: give --walls",
            row.id1, row.wall->name()));
  }

  /// Returns whether a contact must be left out because its force is tensile and its law has no adhesion. Counts these
  /// contacts.
  bool pulls_without_adhesion(const ListedContact& row, double normal_force, const Contact<Dim>& c) {
    if (normal_force >= -kNoForce * largest_force_ || packing_.law_of(c).adheres()) return false;
    if (counts_.n_tensile++ == 0) first_tensile_ = {&row, normal_force};
    return true;
  }

  /// Makes the contact at one contact point of two grains with corners. Returns nothing if the contact is left out.
  std::optional<Contact<Dim>> point(const ListedContact& row, Contact<Dim> c) {
    if (row.bond)
      throw InputError(row.place.text(),
                       "bonds are possible only between disks or spheres, but the grains have corners");
    require_one_image(row, c);
    const bool reversed = put_in_order(c);
    place_point(row, reversed, packing_, c);
    if (c.gap > 0.0 && force_of(row) <= kNoForce * largest_force_) {
      ++counts_.n_neighbors;
      return std::nullopt;
    }
    misfits_.add(row, packing_, c);
    const GivenForces<Dim> given = given_forces<Dim>(row, reversed, c.normal);
    if (!given.normal)
      throw InputError(row.place.text(),
                       "the contact has no force: expected a force for every contact of grains with corners");
    if (pulls_without_adhesion(row, *given.normal, c)) return std::nullopt;
    require_stiffnesses(row);
    set_forces(packing_, row, given, c);
    compare_stiffnesses(row, c);
    return c;
  }

  /// Whether a contact is a bond: it is listed as a bond, or it has a stiffness although its surfaces do not touch.
  bool is_bond(const ListedContact& row, const Contact<Dim>& c) const {
    return row.bond || (row.kn > 0.0 && c.gap >= range_of(packing_, c) && !touches(packing_, c));
  }

  /// Makes a bond. A bond has its own stiffnesses, independent of the law. If no force is listed, the force of the bond
  /// is zero.
  Contact<Dim> bond(const ListedContact& row, Contact<Dim> c) {
    require_one_image(row, c);
    const bool reversed = put_in_order(c);
    floc::place(locate(packing_, c), c);
    require_direction(row, c);
    require_stiffnesses(row);
    require_stiffness(row, "kn", row.kn.value_or(0.0), row.kn.value_or(0.0) > 0.0,
                      "a positive stiffness of the bond");
    const GivenForces<Dim> given = given_forces<Dim>(row, reversed, c.normal);
    c.normal_force = given.normal.value_or(0.0);
    c.elastic_force = std::max(c.normal_force, 0.0);
    if (given.shear) c.shear_force = *given.shear;
    if (given.rolling) c.rolling_moment = *given.rolling;
    c.twisting_moment = given.twisting.value_or(0.0);
    c.kn = *row.kn;
    c.kt = row.kt.value_or(0.0);
    c.kr = row.kr.value_or(0.0);
    c.ktw = row.ktw.value_or(0.0);
    c.bonded = true;
    ++counts_.n_bonds;
    return c;
  }

  /// Makes a contact across a boundary at which grains are rotated when they cross it. No lattice translation brings
  /// the two grains together. The contact keeps the listed force and has no stiffness.
  Contact<Dim> distant_force(const ListedContact& row, Contact<Dim> c) {
    const bool reversed = put_in_order(c);
    floc::place(locate(packing_, c), c);
    const GivenForces<Dim> given = given_forces<Dim>(row, reversed, c.normal);
    c.normal_force = given.normal.value_or(0.0);
    if (row.force)
      c.shear_force = (reversed ? -1.0 : 1.0) * row.force->template head<Dim>() + c.normal_force * c.normal;
    c.bonded = true;
    ++counts_.n_across_no_lattice;
    return c;
  }

  /// Exchanges the bodies of a contact if the second body must come first. @return whether they were exchanged
  bool put_in_order(Contact<Dim>& c) const {
    if (packing_.is_wall(c.j) || !is_reversed(c)) return false;
    std::swap(c.i, c.j);
    c.image = -c.image;
    return true;
  }

  void require_direction(const ListedContact& row, const Contact<Dim>& c) const {
    if (packing_.is_wall(c.j) && !(c.normal.dot(packing_.wall(c.j).normal()) > 0.0))
      throw InputError(row.place.text(), fmt::format("grain {} has its centre on or beyond the wall {}",
                                                     row.id1, row.wall->name()));
    if (c.normal.isZero(0.0))
      throw InputError(row.place.text(), "the grains have the same centre: their contact has no direction");
  }

  void compare_stiffnesses(const ListedContact& row, const Contact<Dim>& c) {
    if (!row.has_stiffness()) return;
    Contact<Dim> touching = c;
    // If the file lists no liquid bridges, every pair of touching grains is assumed to have a bridge, which attracts
    // with its full strength.
    if (const CapillaryAdhesion* liquid = packing_.law.liquid();
        liquid != nullptr && touches(packing_, c) && bridge_volume(packing_, c) == 0.0)
      touching.elastic_force = std::max(
          0.0, c.normal_force + liquid->strength(packing_.grains.radius[c.i], packing_.surface_radius(c.j)));
    const Stiffnesses by_law = law_stiffnesses(packing_, touching);
    stiffnesses_.add({row.kn.value_or(by_law[0]), row.kt.value_or(by_law[1]), row.kr.value_or(by_law[2]),
                      row.ktw.value_or(by_law[3])},
                     by_law, fmt::format("{}-{}", row.id1, second_name(row)));
  }

  /// Returns the magnitude of the largest force that is listed for a contact.
  static double force_of(const ListedContact& row) {
    const auto norm = [](const std::optional<Eigen::Vector3d>& v) { return v ? v->norm() : 0.0; };
    return std::max({norm(row.force), std::abs(row.normal_force.value_or(0.0)), norm(row.shear_force)});
  }

  double radii(const Contact<Dim>& c) const {
    return packing_.grains.radius[c.i] + packing_.surface_radius(c.j);
  }
  /// Returns the gap (length) between the surfaces of two bodies. For grains with corners, it is the gap at the contact
  /// point with the smallest gap.
  double gap_of(const Contact<Dim>& c) const {
    if (packing_.grains.are_round()) return locate(packing_, c).gap;
    return std::min(radii(c), manifold_of(packing_, c, branch(packing_, c), radii(c)).least_gap());
  }
  bool can_touch(const Contact<Dim>& c) const {
    return gap_of(c) <= range_of(packing_, c) + 0.5 * kFarthestGap * radii(c);
  }

  /// Gives a contact the volume of its liquid bridge, if the file lists the volume.
  /// @throws InputError if the listed volume is not zero and the law has no liquid
  void set_liquid(const ListedContact& row, Contact<Dim>& c) const {
    if (!row.bridge_volume) return;
    if (!holds_liquid(packing_) && *row.bridge_volume != 0.0)
      throw InputError(
          row.place.text(),
          fmt::format("bridge_volume = {:.6g}, but the law has no liquid: give adhesion.law=capillary",
                      *row.bridge_volume));
    if (holds_liquid(packing_)) set_bridge_volume(*row.bridge_volume, c);
  }

  /// Sets the periodic image of the second grain of a contact. The listed image is used if the grains can touch at this
  /// image, else the image at the contact point or, without such an image, the nearest one. Some programs list images
  /// that refer to positions outside the cell, although the listed positions were moved into the cell.
  void set_image(const ListedContact& row, Contact<Dim>& c) {
    if (row.image) c.image = row.image->template head<Dim>();
    for (int a = 0; a < Dim; ++a)
      if (c.image[a] != 0 && between_walls(packing_.walls, a))
        throw InputError(row.place.text(),
                         fmt::format("image{} = {}, expected 0: the packing is not periodic along {}", a + 1,
                                     c.image[a], "xyz"[a]));
    if (row.image) require_another_body(row, c);
    if (row.image && (can_touch(c) || row.bond)) return;
    if (row.image) require_within_reach(c);
    c.image = nearest_image(packing_, row.place, c.i, c.j);
    // The nearest image of a disk or sphere touches first, unless two images may be equally near.
    const bool may_be_another = !packing_.grains.are_round() || branch(packing_, c).norm() >= half_width_;
    if (row.point && may_be_another) c.image = image_at_point(row, packing_, c).value_or(c.image);
    require_another_body(row, c);
    if (row.image && can_touch(c)) ++counts_.n_other_image;
  }

  /// @throws InputError if both bodies of a contact are the same grain, and not two images of it
  static void require_another_body(const ListedContact& row, const Contact<Dim>& c) {
    if (c.i == c.j && c.image.isZero()) refuse_one_body(row);
  }

  [[noreturn]] static void refuse_one_body(const ListedContact& row) {
    if (row.image)
      throw InputError(row.place.text(),
                       "id1 and id2 are equal and the image is zero: the grain would touch itself");
    throw InputError(
        row.place.text(),
        fmt::format("the first and the second body of the contact are grain {}, and not an image of it "
                    "in another cell: the grain would touch itself",
                    row.id1));
  }

  /// Checks the distance between the grains of a contact.
  /// @throws InputError if the number of cells between the grains may be too large for an int
  void require_within_reach(const Contact<Dim>& c) const {
    const Vec<Dim> apart = packing_.grains.position[c.j] - packing_.grains.position[c.i];
    if (packing_.cell.reduced(apart).cwiseAbs().maxCoeff() < kFarthestImage) return;
    throw InputError(
        listed_.grains[c.i].place.text(),
        fmt::format("the grain is more than 1e9 cells away from the grain at {}, but a contact of the two "
                    "is listed",
                    listed_.grains[c.j].place.text()));
  }

  /// Checks the periodic image of the second grain that set_image() has chosen for a contact.
  /// @throws InputError if the image is not the listed image, another image may be equally near, and the contact point
  /// does not tell which of them touches the first grain
  void require_one_image(const ListedContact& row, const Contact<Dim>& c) const {
    if (row.wall || (row.image && c.image == row.image->template head<Dim>())) return;
    const double distance = branch(packing_, c).norm();
    if (distance < half_width_ || (row.point && image_at_point(row, packing_, c) == c.image)) return;
    if (c.i == c.j) refuse_one_body(row);
    const std::string hint =
        row.point
            ? "the contact point must lie on the surface of one image of the second grain"
            : "the list of contacts must give, in the columns image1.., the image of the second grain that "
              "touches the first";
    throw InputError(
        row.place.text(),
        fmt::format(
            "the centres of the grains are {:.6g} apart, which is half the width of the cell ({:.6g}) or "
            "more: {}{}",
            distance, half_width_, hint, counting_hint(listed_)));
  }

  /// Checks that the bodies of a contact are near enough to touch.
  /// @throws InputError naming the two bodies and their gap if they are too far apart
  void require_possible(const ListedContact& row, const Contact<Dim>& c) const {
    if (row.wall && !can_touch(c))
      throw InputError(
          row.place.text(),
          fmt::format("grain {} carries a force of {:.6g} at the wall {}, but the gap is {:.6g} (radius "
                      "{:.6g}): the position of the wall or of the grain is wrong",
                      row.id1, force_of(row), row.wall->name(), gap_of(c), packing_.grains.radius[c.i]));
    if (!can_touch(c))
      throw InputError(
          row.place.text(),
          fmt::format("grains {} and {} carry a force of {:.6g}, but even their nearest images have a "
                      "gap of {:.6g} (radii {:.6g} and {:.6g}): positions, radii or the cell do not fit this "
                      "contact{}{}",
                      row.id1, row.id2, force_of(row), gap_of(c), packing_.grains.radius[c.i],
                      packing_.grains.radius[c.j], hint_of_liquid(row), counting_hint(listed_)));
  }

  /// Says that a liquid bridge across a gap needs a volume, if the contact may be such a bridge.
  std::string hint_of_liquid(const ListedContact& row) const {
    if (packing_.law.liquid() == nullptr || row.bridge_volume) return "";
    return ", or this is a liquid bridge, whose volume has to be listed (column bridge_volume)";
  }

  const ListedPacking& listed_;
  const Identifiers& identifiers_;
  const Packing<Dim>& packing_;
  double half_width_;
  double largest_force_ = 0.0;
  ListedContactCounts counts_;
  Tensile first_tensile_;
  StiffnessComparison stiffnesses_;
  PointMisfits misfits_;
};

}  // namespace

template <int Dim>
ListedContactCounts add_contacts(const ListedPacking& listed, const Identifiers& identifiers,
                                 State<Dim>& state) {
  Packing<Dim>& packing = state.packing;
  const auto order = [](const Contact<Dim>& c) {
    return std::tuple(c.i, c.j, std::vector(c.image.begin(), c.image.end()));
  };
  using Placed = std::pair<Contact<Dim>, const ListedContact*>;
  std::vector<Placed> placed;
  ListedContacts<Dim> contacts(listed, identifiers, packing);
  if (listed.contacts)
    for (const ListedContact& row : *listed.contacts)
      if (std::optional<Contact<Dim>> contact = contacts.place(row))
        placed.emplace_back(*std::move(contact), &row);
  for (const ListedContact& row : listed.bonds)
    if (std::optional<Contact<Dim>> bond = contacts.place(row)) placed.emplace_back(*std::move(bond), &row);
  if (!listed.drop_tensile) contacts.require_no_tensile();
  std::stable_sort(placed.begin(), placed.end(),
                   [&](const Placed& a, const Placed& b) { return order(a.first) < order(b.first); });
  // If two bodies have both a bond and a contact, the bond replaces the contact.
  for (std::size_t k = 1; k < placed.size(); ++k)
    if (order(placed[k].first) == order(placed[k - 1].first) &&
        placed[k].second->bond != placed[k - 1].second->bond)
      placed.erase(placed.begin() + static_cast<std::ptrdiff_t>(placed[k].second->bond ? k - 1 : k)), --k;
  const auto twice = std::adjacent_find(placed.begin(), placed.end(), [&](const Placed& a, const Placed& b) {
    return order(a.first) == order(b.first) && (packing.grains.are_round() || a.first.arm_i == b.first.arm_i);
  });
  if (twice != placed.end()) {
    const ListedContact& second = *(twice + 1)->second;
    throw InputError(second.place.text(),
                     fmt::format("the contact of grains {} and {} is listed twice, first at {}", second.id1,
                                 second_name(second), twice->second->place.text()));
  }
  for (const auto& [contact, from] : placed) {
    packing.contacts.push_back(contact);
    if (from->strengths != Strengths{})
      state.bond_strengths.push_back({contact.i, contact.j, contact.image, from->strengths});
  }
  if (!packing.grains.are_round()) number_points(packing, packing.contacts);
  return contacts.counts();
}

template ListedContactCounts add_contacts(const ListedPacking&, const Identifiers&, State<2>&);
template ListedContactCounts add_contacts(const ListedPacking&, const Identifiers&, State<3>&);

}  // namespace floc
