#include "floc/io/csv_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

#include "floc/base/error.h"
#include "floc/io/csv.h"
#include "floc/packing/contact_forces.h"

namespace floc {
namespace {

constexpr const char* kAxis[] = {"x", "y", "z"};

/// A csv file whose columns go by our names.
class NamedColumns {
 public:
  NamedColumns(const CsvTable& table, const std::map<std::string, std::string>& names)
      : table_(table), names_(names) {}

  bool has(const std::string& name) const { return names_.contains(name) || table_.has(name); }
  int column(const std::string& name) const {
    return table_.column(names_.contains(name) ? names_.at(name) : name);
  }

  /// The columns name1, name2, ...; none if the first is not there.
  std::vector<int> numbered(const std::string& name, int count) const {
    std::vector<int> columns;
    if (has(name + "1"))
      for (int k = 1; k <= count; ++k) columns.push_back(column(name + std::to_string(k)));
    return columns;
  }

 private:
  const CsvTable& table_;
  const std::map<std::string, std::string>& names_;
};

void check_columns(const std::map<std::string, std::string>& columns) {
  static const std::vector<std::string> known = {"x", "y", "z", "radius", "diameter", "mass", "id"};
  for (const auto& [name, column] : columns)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(
          "--columns",
          fmt::format("\"{}\" is no column of a grain: x, y, z, radius, diameter, mass, id", name));
}

template <int Dim>
Cell<Dim> make_cell(const std::vector<std::vector<double>>& vectors) {
  Cell<Dim> cell;
  for (int a = 0; a < Dim; ++a) {
    if (vectors[a].size() != Dim)
      throw InputError("--cell",
                       fmt::format("vector {} has {} components, expected {}", a + 1, vectors[a].size(), Dim));
    for (int b = 0; b < Dim; ++b) cell.matrix(a, b) = vectors[a][b];
  }
  if (!(cell.volume() > 0.0)) throw InputError("--cell", "its vectors span no volume");
  return cell;
}

double positive(const CsvTable& table, int row, int column) {
  const double value = table.number(row, column);
  if (value > 0.0) return value;
  throw InputError(table.place(row), fmt::format("{} = {}, must be positive", table.columns()[column], value));
}

template <int Dim>
Grains<Dim> read_grains(const CsvTable& table, const NamedColumns& names) {
  const int n = table.n_rows();
  Grains<Dim> grains = Grains<Dim>::with_size(n);
  int axis[Dim];
  for (int a = 0; a < Dim; ++a) axis[a] = names.column(kAxis[a]);
  const bool by_radius = names.has("radius") || !names.has("diameter");
  const int size = names.column(by_radius ? "radius" : "diameter");
  const int mass = names.has("mass") ? names.column("mass") : -1;
  for (int i = 0; i < n; ++i) {
    for (int a = 0; a < Dim; ++a) grains.position[i][a] = table.number(i, axis[a]);
    grains.radius[i] = positive(table, i, size) * (by_radius ? 1.0 : 0.5);
    grains.mass[i] = mass >= 0 ? positive(table, i, mass) : std::pow(2.0 * grains.radius[i], Dim);
  }
  return grains;
}

/// Index of each identifier.
class Identifiers {
 public:
  Identifiers(const CsvTable& table, const NamedColumns& names) : n_(table.n_rows()), named_(names.has("id")) {
    if (!named_) return;
    const int column = names.column("id");
    for (int i = 0; i < n_; ++i)
      if (!index_.emplace(table.integer(i, column), i).second)
        throw InputError(table.place(i), fmt::format("id = {} is given twice", table.integer(i, column)));
  }

  int index(const CsvTable& contacts, int row, int column) const {
    const std::int64_t id = contacts.integer(row, column);
    if (!named_ && id >= 0 && id < n_) return static_cast<int>(id);
    if (const auto found = index_.find(id); found != index_.end()) return found->second;
    throw InputError(
        contacts.place(row),
        named_ ? fmt::format("{} = {}: no grain has this id", contacts.columns()[column], id)
               : fmt::format("{} = {}, expected a grain from 0 to {}", contacts.columns()[column], id, n_ - 1));
  }

 private:
  int n_;
  bool named_;
  std::unordered_map<std::int64_t, int> index_;
};

/// The image of j nearest to i. Searched around the one that is nearest in reduced coordinates: in a skewed
/// cell they can differ, by one step a direction unless the cell is so slanted that it should be reduced first.
template <int Dim>
Vec<Dim, int> nearest_image(const Packing<Dim>& packing, int i, int j) {
  const Vec<Dim> apart = packing.grains.position[j] - packing.grains.position[i];
  const Vec<Dim, int> guess = (-packing.cell.reduced(apart)).array().round().matrix().template cast<int>();
  Vec<Dim, int> best = guess;
  double nearest = std::numeric_limits<double>::infinity();
  int n_images = 1;
  for (int a = 0; a < Dim; ++a) n_images *= 3;
  for (int m = 0; m < n_images; ++m) {
    Vec<Dim, int> image = guess;
    for (int a = 0, rest = m; a < Dim; ++a, rest /= 3) image[a] += rest % 3 - 1;
    const double distance = (apart + packing.cell.shift(image)).squaredNorm();
    if ((i == j && image.isZero()) || distance >= nearest) continue;
    nearest = distance;
    best = image;
  }
  return best;
}

/// Puts the grain of lower index first, and of two opposite images of one grain the one find_pairs() names.
template <int Dim>
void orient(Contact<Dim>& c) {
  const Vec<Dim, int> zero = Vec<Dim, int>::Zero();
  const bool opposite_image =
      c.i == c.j && std::lexicographical_compare(c.image.begin(), c.image.end(), zero.begin(), zero.end());
  if (c.i < c.j || (c.i == c.j && !opposite_image)) return;
  std::swap(c.i, c.j);
  c.image = -c.image;
  c.shear_force = -c.shear_force;
  c.rolling_moment = -c.rolling_moment;
}

/// Columns of a list of contacts; -1 or empty where it has none.
template <int Dim>
struct ContactColumns {
  int id1, id2, normal_force;
  std::vector<int> image, shear_force, rolling_moment;

  explicit ContactColumns(const NamedColumns& names)
      : id1(names.column("id1")),
        id2(names.column("id2")),
        normal_force(names.has("normal_force") ? names.column("normal_force") : -1),
        image(names.numbered("image", Dim)),
        shear_force(names.numbered("shear_force", Dim)),
        rolling_moment(names.numbered("rolling_moment", kRotations<Dim>)) {
    if (Dim == 2 && names.has("rolling_moment")) rolling_moment = {names.column("rolling_moment")};
  }
};

/// Fills the contact from the law, then lays the forces that were given over it.
template <int Dim>
void complete(const Packing<Dim>& packing, const CsvTable& table, int row, const ContactColumns<Dim>& columns,
              Contact<Dim>& c) {
  const Contact<Dim> given = c;
  const LawParameters& law = packing.law;
  refresh_contact(packing, c);
  if (columns.normal_force >= 0) {
    c.normal_force = table.number(row, columns.normal_force);
    // Programs whose grains are rigid leave small gaps where they transmit force.
    c.distant = c.gap >= 0.0 && c.gap < law.range();
    if (!c.distant) {
      c.elastic_force = std::max(c.normal_force + law.pull_off_force(), 0.0);
      c.kn = law.normal_stiffness;
      c.kt = law.friction ? law.friction->stiffness : 0.0;
      c.kr = law.rolling ? law.rolling->stiffness : 0.0;
    }
  } else if (c.gap >= 0.0 && c.gap >= law.range()) {
    throw InputError(table.place(row),
                     fmt::format("the gap is {}, where the law does not act, and no normal_force "
                                 "says otherwise",
                                 c.gap));
  }
  if (!columns.shear_force.empty()) {
    if (!law.friction) throw InputError(table.place(row), "shear_force1 is given, but the law has no friction");
    c.shear_force = given.shear_force - c.normal * c.normal.dot(given.shear_force);
    c.shear_spring = to_shear<double>(c.normal, c.shear_force) / law.friction->stiffness;
    c.sliding = c.shear_force.norm() >= law.friction->coefficient * c.elastic_force;
  }
  if (!columns.rolling_moment.empty()) {
    if (!law.rolling) throw InputError(table.place(row), "rolling_moment is given, but the law has no rolling");
    c.rolling_moment = given.rolling_moment;
    c.rolling_spring = -c.rolling_moment / law.rolling->stiffness;
    c.rolling_yield = c.rolling_moment.norm() >= law.rolling->coefficient * c.elastic_force;
  }
}

template <int Dim>
void read_contacts(const std::string& path, const Identifiers& identifiers, Packing<Dim>& packing) {
  const CsvTable table = CsvTable::read(path);
  const std::map<std::string, std::string> no_names;
  const ContactColumns<Dim> columns(NamedColumns(table, no_names));
  for (int row = 0; row < table.n_rows(); ++row) {
    Contact<Dim> c;
    c.i = identifiers.index(table, row, columns.id1);
    c.j = identifiers.index(table, row, columns.id2);
    if (columns.image.empty()) c.image = nearest_image(packing, c.i, c.j);
    for (std::size_t k = 0; k < columns.image.size(); ++k)
      c.image[k] = static_cast<int>(table.integer(row, columns.image[k]));
    if (c.i == c.j && c.image.isZero()) throw InputError(table.place(row), "the grain would touch itself");
    for (std::size_t k = 0; k < columns.shear_force.size(); ++k)
      c.shear_force[k] = table.number(row, columns.shear_force[k]);
    for (std::size_t k = 0; k < columns.rolling_moment.size(); ++k)
      c.rolling_moment[k] = table.number(row, columns.rolling_moment[k]);
    orient(c);
    complete(packing, table, row, columns, c);
    packing.contacts.push_back(c);
  }
  const auto order = [](const Contact<Dim>& c) {
    return std::tuple(c.i, c.j, std::vector(c.image.begin(), c.image.end()));
  };
  std::sort(packing.contacts.begin(), packing.contacts.end(),
            [&](const Contact<Dim>& a, const Contact<Dim>& b) { return order(a) < order(b); });
  const auto twice = std::adjacent_find(packing.contacts.begin(), packing.contacts.end(),
                                        [&](const auto& a, const auto& b) { return order(a) == order(b); });
  if (twice != packing.contacts.end())
    throw InputError(path, fmt::format("the contact of grains {} and {} is listed twice", twice->i, twice->j));
}

/// Brings every grain into the cell; images of contacts follow.
template <int Dim>
void wrap(Packing<Dim>& packing) {
  std::vector<Vec<Dim, int>> moved;
  for (Vec<Dim>& x : packing.grains.position) {
    moved.push_back(-packing.cell.reduced(x).array().floor().matrix().template cast<int>());
    x = packing.cell.wrapped(x);
  }
  for (Contact<Dim>& c : packing.contacts) c.image += moved[c.i] - moved[c.j];
}

template <int Dim>
Imported read_packing(const std::string& path, const ImportOptions& options) {
  const CsvTable table = CsvTable::read(path);
  const NamedColumns names(table, options.columns);
  State<Dim> state;
  state.units = options.units;
  state.packing.cell = make_cell<Dim>(options.cell);
  state.packing.law = *options.law;
  state.packing.grains = read_grains<Dim>(table, names);
  if (table.n_rows() == 0) throw InputError(path, "has no grains");
  if (!options.contacts.empty()) read_contacts(options.contacts, Identifiers(table, names), state.packing);
  wrap(state.packing);
  state.path.branch = "imported";
  state.provenance.source = path;
  return {state, !options.contacts.empty(), false};
}

}  // namespace

Imported read_csv_packing(const std::string& path, const ImportOptions& options) {
  if (!options.law) throw InputError(path, "a csv file does not say the contact law: give --law");
  if (options.index != 0)
    throw InputError(path, fmt::format("index = {}, but it holds one packing", options.index));
  check_columns(options.columns);
  if (options.cell.size() == 2) return read_packing<2>(path, options);
  if (options.cell.size() == 3) return read_packing<3>(path, options);
  throw InputError(path, options.cell.empty() ? "a csv file does not say the cell: give --cell"
                                              : "--cell has to have two vectors, or three in 3D");
}

}  // namespace floc
