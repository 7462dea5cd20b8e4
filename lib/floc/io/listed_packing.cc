#include "floc/io/listed_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "floc/base/error.h"
#include "floc/packing/contact_forces.h"

namespace floc {
namespace {

/// A tangential force this close to its cap, relative, is at it: files print six digits or more.
constexpr double kCapTolerance = 1e-6;
/// A tangential force below this fraction of the normal one is rounding.
constexpr double kNoShear = 1e-9;
/// Rounding of a product of two vectors, of the product of their lengths.
constexpr double kRounding = 1e-15;
/// Images farther away, in cells, do not fit an integer.
constexpr double kFarthest = 1e9;
/// Lattice vectors that are parallel but for rounding span no volume.
constexpr double kFlat = 1e-12;

template <int Dim>
Cell<Dim> make_cell(const std::string& place, const std::vector<std::vector<double>>& vectors) {
  Cell<Dim> cell;
  double box = 1.0;
  for (int a = 0; a < Dim; ++a) {
    if (vectors[a].size() != Dim)
      throw InputError(place,
                       fmt::format("vector {} has {} components, expected {}", a + 1, vectors[a].size(), Dim));
    for (int b = 0; b < Dim; ++b) cell.matrix(a, b) = vectors[a][b];
    box *= cell.matrix.row(a).norm();
  }
  if (!(cell.volume() > kFlat * box))
    throw InputError(place,
                     fmt::format("the cell is degenerate: its vectors span no volume ({:.3g})", cell.volume()));
  return cell;
}

/// Index of each identifier.
class Identifiers {
 public:
  explicit Identifiers(const std::vector<ListedGrain>& grains) {
    for (const ListedGrain& grain : grains) {
      if (!index_.emplace(grain.id, static_cast<int>(index_.size())).second)
        throw InputError(grain.place, fmt::format("id = {} is given twice", grain.id));
      lowest_ = std::min(lowest_, grain.id);
      highest_ = std::max(highest_, grain.id);
    }
  }

  int index(const std::string& place, const char* name, std::int64_t id) const {
    if (const auto found = index_.find(id); found != index_.end()) return found->second;
    throw InputError(place, fmt::format("{} = {}: no grain has this id; they are from {} to {}", name, id,
                                        lowest_, highest_));
  }

 private:
  std::unordered_map<std::int64_t, int> index_;
  std::int64_t lowest_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t highest_ = std::numeric_limits<std::int64_t>::min();
};

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
  return grains;
}

/// A number of cells along each lattice vector, as integers.
template <int Dim>
Vec<Dim, int> whole_cells(const std::string& place, const Vec<Dim>& cells) {
  if (!(cells.cwiseAbs().maxCoeff() < kFarthest))
    throw InputError(place,
                     "lies more than 1e9 cells away from the cell: --cell is too small, or a coordinate wrong");
  return cells.template cast<int>();
}

/// Smallest distance of two opposite faces of the cell.
template <int Dim>
double smallest_width(const Cell<Dim>& cell) {
  // The columns of the inverse are normal to the faces, one over the distance long.
  return 1.0 / cell.matrix.inverse().colwise().norm().maxCoeff();
}

/// The image of j nearest to i. Searched around the one that is nearest in reduced coordinates: in a skewed
/// cell they can differ, by one step a direction unless the cell is so slanted that it should be reduced first.
template <int Dim>
Vec<Dim, int> nearest_image(const Packing<Dim>& packing, const std::string& place, int i, int j) {
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
  const double half = 0.5 * smallest_width(packing.cell);
  if (nearest >= half)
    throw InputError(
        place, fmt::format("the contact is {:.6g} long, not below half the cell ({:.6g}): the list has to "
                           "say which image of the grain it is with",
                           nearest, half));
  return best;
}

/// Whether grains are to be exchanged: the one of lower index comes first, and of two opposite images of one
/// grain the one find_pairs() names.
template <int Dim>
bool is_reversed(const Contact<Dim>& c) {
  if (c.i != c.j) return c.i > c.j;
  const Vec<Dim, int> zero = Vec<Dim, int>::Zero();
  return std::lexicographical_compare(c.image.begin(), c.image.end(), zero.begin(), zero.end());
}

/// Forces a list gives, on the first grain of the contact.
template <int Dim>
struct GivenForces {
  std::optional<double> normal;
  std::optional<Vec<Dim>> shear;
  std::optional<RotationVector<Dim>> rolling;
  std::optional<double> twisting;  ///< the same whichever grain is the first
};

template <int Dim>
GivenForces<Dim> given_forces(const ListedContact& listed, bool reversed, const Vec<Dim>& normal) {
  const double sign = reversed ? -1.0 : 1.0;
  GivenForces<Dim> given;
  given.normal = listed.normal_force;
  if (listed.shear_force) {
    const Vec<Dim> on_first = sign * listed.shear_force->template head<Dim>();
    const double along = normal.dot(on_first);
    // What is tangential but for rounding is kept to the last digit.
    given.shear = on_first;
    if (std::abs(along) > kRounding * on_first.norm()) *given.shear -= normal * along;
  }
  if (listed.force) {
    const Vec<Dim> on_first = sign * listed.force->template head<Dim>();
    given.normal = -normal.dot(on_first);
    given.shear = on_first + *given.normal * normal;
  }
  if (listed.rolling_moment) given.rolling = sign * listed.rolling_moment->template tail<kRotations<Dim>>();
  given.twisting = listed.twisting_moment;
  return given;
}

/// Lays forces that were given over those of the law.
template <int Dim>
void set_forces(const Packing<Dim>& packing, const ListedContact& listed, const GivenForces<Dim>& given,
                Contact<Dim>& c) {
  const LawParameters& law = packing.law;
  if (given.normal) c.normal_force = *given.normal;
  if (given.shear && law.friction) c.shear_force = *given.shear;
  if (given.shear && !law.friction && given.shear->norm() > kNoShear * std::abs(c.normal_force))
    throw InputError(listed.place, fmt::format("the tangential force is {:.6g}, but the law has no friction",
                                               given.shear->norm()));
  if (given.rolling && !law.rolling)
    throw InputError(listed.place, "a rolling moment is given, but the law has no rolling");
  if (given.rolling) c.rolling_moment = *given.rolling;
  if (given.twisting && !law.twisting)
    throw InputError(listed.place, "a twisting moment is given, but the law has no twisting");
  if (given.twisting) c.twisting_moment = *given.twisting;
  if (given.normal || given.shear || given.rolling || given.twisting)
    set_given_forces(packing, listed.kn, listed.kt, kCapTolerance, c);
  if (listed.kr && *listed.kr != 0.0 && !law.rolling)
    throw InputError(listed.place, "a rolling stiffness is given, but the law has no rolling");
  if (listed.kr && law.rolling && !c.distant) c.kr = *listed.kr;
}

/// Fills the contact from the law, then lays the forces that were given over it.
template <int Dim>
Contact<Dim> make_contact(const Packing<Dim>& packing, const Identifiers& identifiers,
                          const ListedContact& listed) {
  Contact<Dim> c;
  c.i = identifiers.index(listed.place, "id1", listed.id1);
  c.j = identifiers.index(listed.place, "id2", listed.id2);
  if (listed.image)
    c.image = listed.image->template head<Dim>();
  else
    c.image = nearest_image(packing, listed.place, c.i, c.j);
  if (c.i == c.j && c.image.isZero()) throw InputError(listed.place, "the grain would touch itself");
  const bool reversed = is_reversed(c);
  if (reversed) {
    std::swap(c.i, c.j);
    c.image = -c.image;
  }
  refresh_contact(packing, c);
  if (c.normal.isZero(0.0))
    throw InputError(listed.place, "the grains have the same centre: their contact has no direction");
  const LawParameters& law = packing.law;
  const GivenForces<Dim> given = given_forces<Dim>(listed, reversed, c.normal);
  if (!given.normal && (listed.kn || listed.kt || listed.kr))
    throw InputError(listed.place, "a stiffness is given without the normal force that goes with it");
  if (!given.normal && c.gap >= 0.0 && c.gap >= law.range())
    throw InputError(
        listed.place,
        fmt::format("the gap is {}, where the law does not act, and no normal_force says otherwise", c.gap));
  set_forces(packing, listed, given, c);
  return c;
}

template <int Dim>
void add_contacts(const ListedPacking& listed, const Identifiers& identifiers, Packing<Dim>& packing) {
  const auto order = [](const Contact<Dim>& c) {
    return std::tuple(c.i, c.j, std::vector(c.image.begin(), c.image.end()));
  };
  using Placed = std::pair<Contact<Dim>, const ListedContact*>;
  std::vector<Placed> placed;
  for (const ListedContact& contact : *listed.contacts)
    placed.emplace_back(make_contact(packing, identifiers, contact), &contact);
  std::stable_sort(placed.begin(), placed.end(),
                   [&](const Placed& a, const Placed& b) { return order(a.first) < order(b.first); });
  const auto twice = std::adjacent_find(placed.begin(), placed.end(), [&](const Placed& a, const Placed& b) {
    return order(a.first) == order(b.first);
  });
  if (twice != placed.end()) {
    const ListedContact& second = *(twice + 1)->second;
    throw InputError(second.place, fmt::format("the contact of grains {} and {} is listed twice, first at {}",
                                               second.id1, second.id2, twice->second->place));
  }
  for (const auto& [contact, from] : placed) packing.contacts.push_back(contact);
}

/// Brings every grain into the cell; images of contacts follow.
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
      throw InputError(listed.grains[c.i].place,
                       fmt::format("is more than 1e9 cells away from {}, which it is said to touch",
                                   listed.grains[c.j].place));
    c.image = image.template cast<int>();
  }
}

template <int Dim>
Imported assemble_in(const ListedPacking& listed) {
  State<Dim> state;
  state.units = listed.units;
  Packing<Dim>& packing = state.packing;
  packing.cell = make_cell<Dim>(listed.cell_place, listed.cell);
  packing.law = listed.law;
  packing.grains = make_grains<Dim>(listed.grains);
  const Identifiers identifiers(listed.grains);
  if (listed.contacts) add_contacts(listed, identifiers, packing);
  wrap(listed, packing);
  state.path.branch = "imported";
  state.provenance.source = listed.place;
  Imported imported;
  imported.state = std::move(state);
  imported.contacts_known = listed.contacts.has_value();
  return imported;
}

}  // namespace

int dimension_of(const std::vector<ListedGrain>& grains, const ImportOptions& options) {
  if (options.dimension) return *options.dimension;
  if (!options.cell.empty()) return static_cast<int>(options.cell.size());
  const auto same_height = [&](const ListedGrain& g) { return g.position[2] == grains.front().position[2]; };
  return std::all_of(grains.begin(), grains.end(), same_height) ? 2 : 3;
}

const LawParameters& required_law(const std::string& path, const ImportOptions& options) {
  if (!options.law) throw InputError(path, "it does not say the contact law: give --law");
  return *options.law;
}

Imported assemble(const ListedPacking& listed) {
  if (listed.grains.empty()) throw InputError(listed.place, "has no grains");
  if (listed.cell.empty()) throw InputError(listed.place, "it does not say the cell: give --cell");
  if (listed.cell.size() == 2) return assemble_in<2>(listed);
  if (listed.cell.size() == 3) return assemble_in<3>(listed);
  throw InputError(listed.cell_place, "the cell has to have two vectors, or three in 3D");
}

}  // namespace floc
