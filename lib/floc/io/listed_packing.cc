#include "floc/io/listed_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/io/contact_file.h"
#include "floc/io/listed_contacts.h"
#include "floc/io/listed_ids.h"
#include "floc/io/listed_images.h"
#include "floc/io/merge_pairs.h"
#include "floc/io/settle_space.h"
#include "floc/packing/ball.h"
#include "floc/packing/liquid/liquid.h"

namespace floc {
namespace {

/// Lattice vectors count as linearly dependent if the volume of the cell, divided by the product of the lengths of the
/// vectors, is below this number, which allows for rounding.
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
Grains<Dim> make_grains(const ListedPacking& packing) {
  const std::vector<ListedGrain>& listed = packing.grains;
  const int n = static_cast<int>(listed.size());
  Grains<Dim> grains = Grains<Dim>::with_size(n);
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < n; ++i) {
    centres.push_back(double_double<Dim>(listed[i].position.template head<Dim>(),
                                         listed[i].position_low.template head<Dim>()));
    grains.radius[i] = listed[i].radius;
  }
  grains.set_centres(centres);
  std::vector<std::int64_t> names;
  for (const ListedGrain& grain : listed) names.push_back(grain.id);
  grains.set_names(std::move(names));
  set_shapes(packing, grains);
  for (int i = 0; i < n; ++i) {
    const double of_ball = std::pow(2.0 * grains.radius[i], Dim);
    grains.mass[i] = listed[i].mass.value_or(
        grains.are_round() ? of_ball : of_ball * grains.volume(i) / Ball<Dim>{grains.radius[i]}.volume());
  }
  return grains;
}

/// Returns the two ends of each axis that is not periodic.
template <int Dim>
std::vector<Wall<Dim>> make_walls(const ListedPacking& listed) {
  std::vector<Wall<Dim>> walls;
  for (const ListedEnds& ends : listed.ends) {
    const double side = listed.cell[ends.axis][ends.axis];
    // If both ends are open, the lower end is placed at the lowest point of the grains. The distance between the ends
    // is always the side of the cell.
    double lowest = std::numeric_limits<double>::infinity();
    for (const ListedGrain& g : listed.grains)
      lowest = std::min(lowest, g.position[ends.axis] - reach_along(listed, g, ends.axis, -1));
    const double low = ends.low ? *ends.low : ends.high ? *ends.high - side : lowest;
    walls.push_back({ends.axis, -1, low, 0.0, ends.low_mass, !ends.low});
    walls.push_back({ends.axis, +1, ends.high.value_or(low + side), 0.0, ends.high_mass, !ends.high});
  }
  return walls;
}

/// Moves the grains by lattice vectors along the periodic axes, so that they lie in the cell, and updates the images of
/// the contacts.
template <int Dim>
void wrap(const ListedPacking& listed, State<Dim>& state) {
  Packing<Dim>& packing = state.packing;
  std::vector<Vec<Dim, int>> moved;
  std::vector<DoubleDoubleVec<Dim>> centres;
  for (int i = 0; i < packing.grains.size(); ++i) {
    // The rounded position determines only a whole number of cells. The grain is moved in double-double precision, so
    // that its position keeps all digits of the file.
    const Vec<Dim> reduced = packing.cell.reduced(packing.grains.position[i]);
    Vec<Dim> cells = -reduced.array().floor().matrix();
    for (const Wall<Dim>& wall : packing.walls) cells[wall.axis] = 0.0;
    moved.push_back(whole_cells<Dim>(listed.grains[i].place, cells));
    centres.push_back(displaced<Dim>(packing.grains.centre(i), packing.cell, moved.back()));
  }
  packing.grains.set_centres(centres);
  const auto update_image = [&](auto& c) {
    if (packing.is_wall(c.j)) return;
    // The branch vector x_j + image * cell - x_i of a contact must not change when the grains i and j are moved. The
    // new image is therefore image + moved_i - moved_j. Each of the three terms may be so large that their sum exceeds
    // the range of int.
    using Wide = Vec<Dim, std::int64_t>;
    const Wide image = c.image.template cast<std::int64_t>() + moved[c.i].template cast<std::int64_t>() -
                       moved[c.j].template cast<std::int64_t>();
    if (static_cast<double>(image.cwiseAbs().maxCoeff()) > kFarthestImage)
      throw InputError(
          listed.grains[c.i].place.text(),
          fmt::format(
              "the grain is more than 1e9 cells away from the grain at {}, but a contact of the two is listed",
              listed.grains[c.j].place.text()));
    c.image = image.template cast<int>();
  };
  for (Contact<Dim>& c : packing.contacts) update_image(c);
  for (BondStrength<Dim>& strength : state.bond_strengths) update_image(strength);
}

bool lists_liquid(const ListedPacking& listed) {
  return listed.contacts && !listed.contacts->empty() &&
         std::all_of(listed.contacts->begin(), listed.contacts->end(),
                     [](const ListedContact& c) { return c.bridge_volume.has_value(); });
}

/// Compares the total volume of the listed liquid bridges with the volume of liquid that follows from the water content
/// of the law. Reports an inconsistency if the two differ. Rounding errors of six digits are accepted.
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

/// Says which masses were assumed, if these masses have weights.
void add_remark_on_masses(const ListedPacking& listed, int dimension, std::vector<std::string>& remarks) {
  const auto without = std::ranges::count_if(listed.grains, [](const ListedGrain& g) { return !g.mass; });
  if (without == 0 || listed.gravity.isZero(0.0)) return;
  remarks.push_back(
      fmt::format("there is no mass for {} of {} grains: the mass of a ball of diameter d is taken as d^{}, "
                  "and the weights follow from it",
                  without, listed.grains.size(), dimension));
}

template <int Dim>
Imported assemble_in(const ListedPacking& listed) {
  State<Dim> state;
  state.units = listed.units;
  Packing<Dim>& packing = state.packing;
  packing.cell = make_cell<Dim>(listed.cell_place, listed.cell);
  packing.law = listed.law;
  packing.walls = make_walls<Dim>(listed);
  packing.wall_law = listed.wall_law.value_or(listed.law);
  packing.gravity = listed.gravity.template head<Dim>();
  if (packing.walls.empty()) packing.wall_law = Law();
  if (Dim == 2) require_one_plane(listed);
  packing.grains = make_grains<Dim>(listed);
  const Identifiers identifiers(listed);
  Imported imported;
  // The contacts are made before wrap() moves the grains into the cell, because the listed images refer to the listed
  // positions.
  imported.listed_contacts = add_contacts(listed, identifiers, state);
  imported.liquid_known = holds_liquid(packing) && lists_liquid(listed);
  wrap(listed, state);
  state.path.branch = "imported";
  state.provenance.source = listed.place;
  imported.state = std::move(state);
  imported.contacts_known = listed.contacts.has_value();
  imported.lacks_wall_contacts = listed.lacks_wall_contacts;
  imported.remarks = listed.remarks;
  add_remark_on_masses(listed, Dim, imported.remarks);
  imported.inconsistencies = listed.inconsistencies;
  if (const std::string& misfit = imported.listed_contacts.misfit; !misfit.empty())
    imported.inconsistencies.push_back(misfit);
  if (imported.liquid_known)
    add_doubt_of_liquid(std::get<State<Dim>>(imported.state).packing, imported.inconsistencies);
  return imported;
}

}  // namespace

void add_wall_contacts(const std::string& list, ListedPacking& listed) {
  std::vector<ListedContact>& contacts = *listed.contacts;
  contacts.insert(contacts.end(), listed.wall_contacts.begin(), listed.wall_contacts.end());
  const bool has_walls = std::any_of(listed.ends.begin(), listed.ends.end(),
                                     [](const ListedEnds& ends) { return ends.low || ends.high; });
  if (!has_walls || !listed.shapes.empty() ||
      std::any_of(contacts.begin(), contacts.end(), [](const ListedContact& c) { return c.wall.has_value(); }))
    return;
  listed.lacks_wall_contacts = true;
  listed.remarks.push_back(fmt::format(
      "{} lists no contacts with walls: these contacts are found from the positions and radii; they "
      "have the normal forces of the contact law and no tangential forces",
      list));
}

const Law& required_law(const std::string& path, const ImportOptions& options) {
  if (!options.law)
    throw InputError(path,
                     "the file contains no contact law: give --law, for example --law "
                     "normal.stiffness=1e5,friction.coefficient=0.5,friction.stiffness=5e4");
  return *options.law;
}

ListedPacking listed_packing(const std::string& path, const ImportOptions& options) {
  ListedPacking listed;
  listed.place = path;
  listed.law = required_law(path, options);
  listed.wall_law = options.wall_law;
  listed.units = options.units;
  listed.drop_tensile = options.drop_tensile;
  return listed;
}

Imported assemble(const ListedPacking& listed) {
  if (listed.grains.empty()) throw InputError(listed.place, "the file has no grains");
  if (listed.cell.empty())
    throw InputError(listed.place,
                     "the file contains no cell: give --cell, or --walls for a packing that is not periodic");
  if (listed.cell.size() == 2) return assemble_in<2>(listed);
  if (listed.cell.size() == 3) return assemble_in<3>(listed);
  throw InputError(listed.cell_place, "the cell must have two lattice vectors in 2D, or three in 3D");
}

Imported assemble(ListedPacking listed, const ImportOptions& options) {
  const int dimension = settle_space(options, listed);
  if (auto contacts = read_contact_file(options, dimension, listed)) {
    listed.contacts = std::move(contacts);
    add_wall_contacts("the file of contacts", listed);
  } else if (!listed.wall_contacts.empty()) {
    throw InputError("--columns",
                     "the forces between grains and walls are given, but the forces between grains are not: "
                     "give --contacts");
  }
  if (options.pairs_twice && !listed.shapes.empty())
    throw InputError(listed.place,
                     "--pairs-twice merges the contacts of disks and spheres, but the grains have corners");
  if (options.pairs_twice && listed.contacts) listed.remarks.push_back(merge_pairs(*listed.contacts));
  listed.bonds = read_bond_file(options, dimension, listed);
  return assemble(listed);
}

}  // namespace floc
