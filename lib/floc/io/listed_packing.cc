#include "floc/io/listed_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/contact/adhesion/capillary_adhesion.h"
#include "floc/io/listed_ids.h"
#include "floc/io/listed_space.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/stiffness_check.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/locate.h"

namespace floc {
namespace {

/// Largest distance of a tangential force from the limit of friction, relative to this limit, at which the force counts
/// as mobilised (at its limit). Files print forces with six digits or more.
constexpr double kCapTolerance = 1e-6;
/// A tangential force below this fraction of the normal force of the same contact is taken for a rounding error.
constexpr double kNoShear = 1e-9;
/// Rounding error of a scalar product, relative to the product of the lengths of the two vectors.
constexpr double kRounding = 1e-15;
/// Largest distance of a periodic image from the cell, in numbers of cells. Larger numbers may not fit an int.
constexpr double kFarthest = 1e9;
/// A force below this fraction of the largest listed force is taken for a rounding error.
constexpr double kNoForce = 1e-9;
/// Two grains cannot be in contact if their gap exceeds the range of the law by more than this fraction of their mean
/// radius. The fraction is large because a file may have few digits.
constexpr double kFarthestGap = 0.1;
/// Largest accepted difference between a listed normal force and the normal component of the total force listed for the
/// same contact, relative to the total force. Rounding of positions to six digits rotates the contact normal, but
/// changes this component by less.
constexpr double kSameForce = 1e-3;
/// The lattice vectors of a cell are parallel within rounding if the volume of the cell, divided by the product of the
/// lengths of these vectors, is below this value.
constexpr double kFlat = 1e-12;

template <int Dim>
Cell<Dim> make_cell(const std::string& place, const std::vector<std::vector<double>>& vectors) {
  Cell<Dim> cell;
  double box = 1.0;
  for (int a = 0; a < Dim; ++a) {
    if (vectors[a].size() != Dim)
      throw InputError(place, fmt::format("lattice vector {} has {} components, expected {}", a + 1,
                                          vectors[a].size(), Dim));
    for (int b = 0; b < Dim; ++b) cell.matrix(a, b) = vectors[a][b];
    box *= cell.matrix.row(a).norm();
  }
  if (!(cell.volume() > kFlat * box))
    throw InputError(place, fmt::format("the cell is degenerate: its lattice vectors span no volume ({:.3g})",
                                        cell.volume()));
  return cell;
}

template <int Dim>
Grains<Dim> make_grains(const std::vector<ListedGrain>& listed) {
  const int n = static_cast<int>(listed.size());
  Grains<Dim> grains = Grains<Dim>::with_size(n);
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < n; ++i) {
    centres.push_back(double_double<Dim>(listed[i].position.template head<Dim>(),
                                         listed[i].position_low.template head<Dim>()));
    grains.radius[i] = listed[i].radius;
    grains.mass[i] = listed[i].mass.value_or(std::pow(2.0 * listed[i].radius, Dim));
  }
  grains.set_centres(centres);
  std::vector<std::int64_t> names;
  for (const ListedGrain& grain : listed) names.push_back(grain.id);
  grains.set_names(std::move(names));
  return grains;
}

/// Converts a displacement, given as numbers of cells along the lattice vectors, to integers.
/// @throws InputError naming `place` if a number exceeds kFarthest
template <int Dim>
Vec<Dim, int> whole_cells(const FileLine& place, const Vec<Dim>& cells) {
  if (!(cells.cwiseAbs().maxCoeff() < kFarthest))
    throw InputError(
        place.text(),
        "a grain lies more than 1e9 cells away from the cell: --cell is too small, or a coordinate is "
        "wrong");
  return cells.template cast<int>();
}

/// Returns the smallest distance between two opposite faces of the cell (length).
template <int Dim>
double smallest_width(const Cell<Dim>& cell) {
  // Each column of the inverse of the cell matrix is normal to a pair of opposite faces of the cell. Its length is the
  // inverse of the distance between these faces.
  return 1.0 / cell.matrix.inverse().colwise().norm().maxCoeff();
}

/// Returns the periodic image of grain j that is nearest to grain i, in numbers of cells. First the image with the
/// smallest reduced coordinates relative to grain i is found. Then it is compared with its neighbours, because in a
/// skewed cell one of these can be nearer. In an extremely skewed cell the nearest image may be missed; such a cell
/// should be reduced first.
template <int Dim>
Vec<Dim, int> nearest_image(const Packing<Dim>& packing, const FileLine& place, int i, int j) {
  const Vec<Dim> apart = packing.grains.position[j] - packing.grains.position[i];
  const Vec<Dim, int> guess = whole_cells<Dim>(place, (-packing.cell.reduced(apart)).array().round().matrix());
  Vec<Dim, int> best = guess;
  double nearest = std::numeric_limits<double>::infinity();
  int n_images = 1;
  for (int a = 0; a < Dim; ++a) n_images *= 3;
  for (int m = 0; m < n_images; ++m) {
    Vec<Dim, int> image = guess;
    for (int a = 0, rest = m; a < Dim; ++a, rest /= 3) image[a] += rest % 3 - 1;
    const double distance = (apart + packing.cell.shift(image)).norm();
    if ((i == j && image.isZero()) || distance >= nearest) continue;
    nearest = distance;
    best = image;
  }
  return best;
}

/// Whether the two grains of a contact have to be exchanged so that the grain with the lower index comes first. A
/// contact of a grain with its own image is exchanged if find_pairs() uses the opposite image.
template <int Dim>
bool is_reversed(const Contact<Dim>& c) {
  if (c.i != c.j) return c.i > c.j;
  const Vec<Dim, int> zero = Vec<Dim, int>::Zero();
  return std::lexicographical_compare(c.image.begin(), c.image.end(), zero.begin(), zero.end());
}

/// Forces that the file lists for a contact. They act on the first grain of the contact.
template <int Dim>
struct GivenForces {
  std::optional<double> normal;
  std::optional<Vec<Dim>> shear;
  std::optional<RotationVector<Dim>> rolling;
  std::optional<double> twisting;  ///< twisting moment, which does not depend on the order of the two grains
};

template <int Dim>
GivenForces<Dim> given_forces(const ListedContact& listed, bool reversed, const Vec<Dim>& normal) {
  const double sign = reversed ? -1.0 : 1.0;
  GivenForces<Dim> given;
  given.normal = listed.normal_force;
  if (listed.shear_force) {
    const Vec<Dim> on_first = sign * listed.shear_force->template head<Dim>();
    const double along = normal.dot(on_first);
    // The normal component of a listed tangential force is subtracted only if it exceeds rounding errors. Otherwise the
    // tangential force keeps all of its digits.
    given.shear = on_first;
    if (std::abs(along) > kRounding * on_first.norm()) *given.shear -= normal * along;
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
    given.shear = on_first + *given.normal * normal;
  }
  if (listed.rolling_moment) given.rolling = sign * listed.rolling_moment->template tail<kRotations<Dim>>();
  given.twisting = listed.twisting_moment;
  return given;
}

/// Replaces the forces and stiffnesses of a contact, which the law has given, by those that the file lists.
/// @throws InputError for a listed force or stiffness (tangential, rolling, twisting) that the law does not have
template <int Dim>
void set_forces(const Packing<Dim>& packing, const ListedContact& listed, const GivenForces<Dim>& given,
                Contact<Dim>& c) {
  const Law& law = packing.law;
  if (given.normal) c.normal_force = *given.normal;
  if (given.shear && law.has_friction()) c.shear_force = *given.shear;
  if (given.shear && !law.has_friction() && given.shear->norm() > kNoShear * std::abs(c.normal_force))
    throw InputError(
        listed.place.text(),
        fmt::format("the tangential force is {:.6g}, but the law has no friction", given.shear->norm()));
  if (given.rolling && !law.has_rolling())
    throw InputError(listed.place.text(), "a rolling moment is listed, but the law has no rolling resistance");
  if (given.rolling) c.rolling_moment = *given.rolling;
  if (given.twisting && !law.has_twisting())
    throw InputError(listed.place.text(),
                     "a twisting moment is listed, but the law has no twisting resistance");
  if (given.twisting) c.twisting_moment = *given.twisting;
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

/// Checks one stiffness that a file may list for a contact.
/// @param name  name of the column of the stiffness
/// @param right  whether `value` is an allowed value
/// @param expected  description of the allowed values, for the message
/// @throws InputError if `value` is listed and not allowed
void require_stiffness(const ListedContact& listed, const char* name, const std::optional<double>& value,
                       bool right, const char* expected) {
  if (value && !right)
    throw InputError(listed.place.text(), fmt::format("{} = {}, expected {}", name, *value, expected));
}

void require_stiffnesses(const ListedContact& listed) {
  require_stiffness(listed, "kt", listed.kt, listed.kt >= 0.0, "a tangential stiffness >= 0");
  require_stiffness(listed, "kr", listed.kr, listed.kr >= 0.0, "a rolling stiffness >= 0");
  require_stiffness(listed, "ktw", listed.ktw, listed.ktw >= 0.0, "a twisting stiffness >= 0");
}

/// Makes the contacts of a packing from the contacts that a file lists, and counts the listed contacts that are left
/// out or get another image.
template <int Dim>
class ListedContacts {
 public:
  ListedContacts(const ListedPacking& listed, const Identifiers& identifiers, const Packing<Dim>& packing)
      : listed_(listed),
        identifiers_(identifiers),
        packing_(packing),
        half_width_(0.5 * smallest_width(packing.cell)) {
    counts_.n_read = static_cast<int>(listed.contacts->size());
    for (const ListedContact& row : *listed.contacts) largest_force_ = std::max(largest_force_, force_of(row));
  }

  /// Makes the contact that one row of the table of contacts describes. Listed forces replace the forces of the law.
  /// Returns nothing if the contact is left out.
  std::optional<Contact<Dim>> place(const ListedContact& row) {
    Contact<Dim> c;
    c.i = identifiers_.index(row.place, "id1", row.id1);
    c.j = identifiers_.index(row.place, "id2", row.id2);
    set_liquid(row, c);
    set_image(row, c);
    floc::place(locate(packing_, c), c);
    const double gap = c.gap;
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
    require_possible(row, c);
    const bool reversed = is_reversed(c);
    if (reversed) {
      std::swap(c.i, c.j);
      c.image = -c.image;
    }
    refresh_contact(packing_, c);
    if (c.normal.isZero(0.0))
      throw InputError(row.place.text(), "the grains have the same centre: their contact has no direction");
    const GivenForces<Dim> given = given_forces<Dim>(row, reversed, c.normal);
    if (!given.normal && row.has_stiffness())
      throw InputError(row.place.text(), "a stiffness is listed for the contact, but no normal force");
    if (given.normal && *given.normal < -kNoForce * largest_force_ && !packing_.law.adheres()) {
      if (counts_.n_tensile++ == 0) first_tensile_ = {&row, *given.normal};
      return std::nullopt;
    }
    require_stiffnesses(row);
    set_forces(packing_, row, given, c);
    // The sign of kn is tested only for surfaces that touch, because kn is negative for an attraction across a gap.
    if (!c.distant)
      require_stiffness(row, "kn", row.kn, row.kn > 0.0,
                        "a positive number, the stiffness of surfaces that touch");
    compare_stiffnesses(row, c);
    return c;
  }

  ListedContactCounts counts() const {
    ListedContactCounts counts = counts_;
    counts.stiffness_differences = stiffnesses_.differences(packing_.law.force_exponent());
    return counts;
  }

  /// Checks that no contact was left out because its force is tensile and the law has no adhesion.
  /// @throws InputError naming the first contact that was left out for this reason
  void require_no_tensile() const {
    if (counts_.n_tensile == 0) return;
    const bool adhesive_law_exists = packing_.law.force_exponent() == 1.0;
    throw InputError(
        first_tensile_.row->place.text(),
        fmt::format(
            "the contact of grains {} and {} pulls with the force {:.6g}, as {} of the {} listed contacts do, "
            "but the law has no adhesion: {}, or leave out the contacts that pull with --drop-tensile",
            first_tensile_.row->id1, first_tensile_.row->id2, -first_tensile_.normal_force, counts_.n_tensile,
            counts_.n_read,
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

  void compare_stiffnesses(const ListedContact& row, const Contact<Dim>& c) {
    if (!row.has_stiffness()) return;
    Contact<Dim> touching = c;
    // If the file does not list liquid bridges, every pair of grains that touch is taken to have a bridge, which
    // attracts with its full strength.
    if (const CapillaryAdhesion* liquid = packing_.law.liquid();
        liquid != nullptr && touches(packing_, c) && bridge_volume(packing_, c) == 0.0)
      touching.elastic_force = std::max(
          0.0, c.normal_force + liquid->strength(packing_.grains.radius[c.i], packing_.grains.radius[c.j]));
    const Stiffnesses by_law = law_stiffnesses(packing_, touching);
    stiffnesses_.add({row.kn.value_or(by_law[0]), row.kt.value_or(by_law[1]), row.kr.value_or(by_law[2]),
                      row.ktw.value_or(by_law[3])},
                     by_law, fmt::format("{}-{}", row.id1, row.id2));
  }

  /// Returns the largest magnitude of the forces that are listed for a contact.
  static double force_of(const ListedContact& row) {
    const auto norm = [](const std::optional<Eigen::Vector3d>& v) { return v ? v->norm() : 0.0; };
    return std::max({norm(row.force), std::abs(row.normal_force.value_or(0.0)), norm(row.shear_force)});
  }

  double radii(const Contact<Dim>& c) const {
    return packing_.grains.radius[c.i] + packing_.grains.radius[c.j];
  }
  double gap_of(const Contact<Dim>& c) const { return locate(packing_, c).gap; }
  bool can_touch(const Contact<Dim>& c) const {
    return gap_of(c) <= range_of(packing_, c) + 0.5 * kFarthestGap * radii(c);
  }

  /// Sets the volume of the liquid bridge of a contact to the listed volume, if there is one.
  /// @throws InputError if a volume is listed, but the law has no liquid
  void set_liquid(const ListedContact& row, Contact<Dim>& c) const {
    if (!row.bridge_volume) return;
    if (!holds_liquid(packing_) && *row.bridge_volume != 0.0)
      throw InputError(
          row.place.text(),
          fmt::format("bridge_volume = {:.6g}, but the law has no liquid: give adhesion.law=capillary",
                      *row.bridge_volume));
    if (holds_liquid(packing_)) set_bridge_volume(*row.bridge_volume, c);
  }

  /// Sets the periodic image of the second grain of a contact. It is the listed image if the grains can touch there,
  /// otherwise the nearest image. Some programs move the positions into the cell but list images for positions outside
  /// it.
  void set_image(const ListedContact& row, Contact<Dim>& c) {
    if (row.image) c.image = row.image->template head<Dim>();
    if (row.image && c.i == c.j && c.image.isZero())
      throw InputError(row.place.text(),
                       "id1 and id2 are equal and the image is zero: the grain would touch itself");
    if (row.image && can_touch(c)) return;
    if (row.image) require_within_reach(c);
    c.image = nearest_image(packing_, row.place, c.i, c.j);
    if (row.image && can_touch(c)) ++counts_.n_other_image;
  }

  /// Checks the distance between the grains of a contact.
  /// @throws InputError if they are so many cells apart that this number may not fit an int
  void require_within_reach(const Contact<Dim>& c) const {
    const Vec<Dim> apart = packing_.grains.position[c.j] - packing_.grains.position[c.i];
    if (packing_.cell.reduced(apart).cwiseAbs().maxCoeff() < kFarthest) return;
    throw InputError(
        listed_.grains[c.i].place.text(),
        fmt::format("the grain is more than 1e9 cells away from the grain at {}, but a contact of the two "
                    "is listed",
                    listed_.grains[c.j].place.text()));
  }

  /// Checks the periodic image of the second grain that set_image() chose for a contact.
  /// @throws InputError if the grains cannot touch at this image, or if no image was listed and another image may be
  /// equally near
  void require_possible(const ListedContact& row, const Contact<Dim>& c) const {
    const double distance = branch(packing_, c).norm();
    const bool chosen = !row.image || c.image != row.image->template head<Dim>();
    if (chosen && distance >= half_width_)
      throw InputError(row.place.text(),
                       fmt::format("the centres of the grains are {:.6g} apart, not less than half the width "
                                   "of the cell ({:.6g}): the list of contacts has to give, in the columns "
                                   "image1.., which image of the second grain touches the first{}",
                                   distance, half_width_, counting_hint(listed_)));
    if (!can_touch(c))
      throw InputError(
          row.place.text(),
          fmt::format(
              "grains {} and {} carry a force of {:.6g}, but even their nearest images have a "
              "gap of {:.6g} (radii {:.6g} and {:.6g}): positions, radii or the cell do not fit this contact{}",
              row.id1, row.id2, force_of(row), gap_of(c), packing_.grains.radius[c.i],
              packing_.grains.radius[c.j], counting_hint(listed_)));
  }

  const ListedPacking& listed_;
  const Identifiers& identifiers_;
  const Packing<Dim>& packing_;
  double half_width_;
  double largest_force_ = 0.0;
  ListedContactCounts counts_;
  Tensile first_tensile_;
  StiffnessComparison stiffnesses_;
};

template <int Dim>
ListedContactCounts add_contacts(const ListedPacking& listed, const Identifiers& identifiers,
                                 Packing<Dim>& packing) {
  const auto order = [](const Contact<Dim>& c) {
    return std::tuple(c.i, c.j, std::vector(c.image.begin(), c.image.end()));
  };
  using Placed = std::pair<Contact<Dim>, const ListedContact*>;
  std::vector<Placed> placed;
  ListedContacts<Dim> contacts(listed, identifiers, packing);
  for (const ListedContact& row : *listed.contacts)
    if (std::optional<Contact<Dim>> contact = contacts.place(row))
      placed.emplace_back(*std::move(contact), &row);
  if (!listed.drop_tensile) contacts.require_no_tensile();
  std::stable_sort(placed.begin(), placed.end(),
                   [&](const Placed& a, const Placed& b) { return order(a.first) < order(b.first); });
  const auto twice = std::adjacent_find(placed.begin(), placed.end(), [&](const Placed& a, const Placed& b) {
    return order(a.first) == order(b.first);
  });
  if (twice != placed.end()) {
    const ListedContact& second = *(twice + 1)->second;
    throw InputError(second.place.text(),
                     fmt::format("the contact of grains {} and {} is listed twice, first at {}", second.id1,
                                 second.id2, twice->second->place.text()));
  }
  for (const auto& [contact, from] : placed) packing.contacts.push_back(contact);
  return contacts.counts();
}

/// Moves every grain into the periodic cell and updates the images of the contacts.
template <int Dim>
void wrap(const ListedPacking& listed, Packing<Dim>& packing) {
  std::vector<Vec<Dim, int>> moved;
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < packing.grains.size(); ++i) {
    const Vec<Dim> reduced = packing.cell.reduced(packing.grains.position[i]);
    moved.push_back(whole_cells<Dim>(listed.grains[i].place, -reduced.array().floor().matrix()));
    centres.push_back(displaced<Dim>(packing.grains.centre(i), packing.cell, moved.back()));
  }
  packing.grains.set_centres(centres);
  for (Contact<Dim>& c : packing.contacts) {
    using Wide = Vec<Dim, std::int64_t>;
    const Wide image = c.image.template cast<std::int64_t>() + moved[c.i].template cast<std::int64_t>() -
                       moved[c.j].template cast<std::int64_t>();
    if (static_cast<double>(image.cwiseAbs().maxCoeff()) > kFarthest)
      throw InputError(
          listed.grains[c.i].place.text(),
          fmt::format(
              "the grain is more than 1e9 cells away from the grain at {}, but a contact of the two is listed",
              listed.grains[c.j].place.text()));
    c.image = image.template cast<int>();
  }
}

bool lists_liquid(const ListedPacking& listed) {
  return listed.contacts && !listed.contacts->empty() &&
         std::all_of(listed.contacts->begin(), listed.contacts->end(),
                     [](const ListedContact& c) { return c.bridge_volume.has_value(); });
}

/// Reports an inconsistency if the listed volumes of liquid bridges do not add up to the volume of liquid that the
/// water content in the law gives. Differences by rounding to six digits are accepted.
template <int Dim>
void add_doubt_of_liquid(const Packing<Dim>& packing, std::vector<std::string>& inconsistencies) {
  constexpr double kDigits = 1e-6;
  const double all = BridgeSearch(*packing.law.liquid(), packing.grains.radius).liquid();
  double sum = 0.0;
  for (const Contact<Dim>& c : packing.contacts) sum += std::abs(bridge_volume(packing, c));
  if (std::abs(sum - all) > kDigits * all)
    inconsistencies.push_back(fmt::format(
        "the volumes of the listed liquid bridges sum to {:.6g}, but the water content of the law gives "
        "{:.6g}",
        sum, all));
}

template <int Dim>
Imported assemble_in(const ListedPacking& listed) {
  State<Dim> state;
  state.units = listed.units;
  Packing<Dim>& packing = state.packing;
  packing.cell = make_cell<Dim>(listed.cell_place, listed.cell);
  packing.law = listed.law;
  if (Dim == 2) require_one_plane(listed);
  packing.grains = make_grains<Dim>(listed.grains);
  const Identifiers identifiers(listed);
  Imported imported;
  if (listed.contacts) imported.listed_contacts = add_contacts(listed, identifiers, packing);
  imported.liquid_known = holds_liquid(packing) && lists_liquid(listed);
  wrap(listed, packing);
  state.path.branch = "imported";
  state.provenance.source = listed.place;
  imported.state = std::move(state);
  imported.contacts_known = listed.contacts.has_value();
  imported.remarks = listed.remarks;
  imported.inconsistencies = listed.inconsistencies;
  if (imported.liquid_known)
    add_doubt_of_liquid(std::get<State<Dim>>(imported.state).packing, imported.inconsistencies);
  return imported;
}

}  // namespace

const Law& required_law(const std::string& path, const ImportOptions& options) {
  if (!options.law) throw InputError(path, "the file holds no contact law: give --law");
  return *options.law;
}

Imported assemble(const ListedPacking& listed) {
  if (listed.grains.empty()) throw InputError(listed.place, "the file has no grains");
  if (listed.cell.empty()) throw InputError(listed.place, "the file holds no cell: give --cell");
  if (listed.cell.size() == 2) return assemble_in<2>(listed);
  if (listed.cell.size() == 3) return assemble_in<3>(listed);
  throw InputError(listed.cell_place, "the cell has to have two lattice vectors in 2D, or three in 3D");
}

}  // namespace floc
