#include "floc/io/listed_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/table_units.h"

namespace floc {
namespace {

double positive(const CsvTable& table, int row, int column) {
  const double value = table.number(row, column);
  if (value > 0.0) return value;
  throw InputError(table.place(row), fmt::format("{} = {}, must be positive", table.columns()[column], value));
}

/// Returns the index of the column for the quantity `name`; -1 if there is no such column.
int column_if(const NamedColumns& columns, const std::string& name) {
  return columns.has(name) ? columns.column(name) : -1;
}

/// A column of numbers, and the factor that converts the numbers to the required unit.
struct Quantity {
  UnitColumn column;
  double factor = 1.0;

  Quantity(UnitColumn of) : column(std::move(of)) {}
  void convert_to(const CsvTable& table, const std::string& unit) {
    const std::string& header = table.columns()[static_cast<std::size_t>(column.index)];
    factor = unit_factor(fmt::format("{}, column {}", table.place(), header), column.unit, "column x", unit);
  }
};

/// Returns the indices of the `count` columns name1, name2, ...; an empty list if there is no column name1.
std::vector<int> numbered(const NamedColumns& columns, const std::string& name, int count) {
  std::vector<int> found;
  if (columns.has(name + "1"))
    for (int k = 1; k <= count; ++k) found.push_back(columns.column(name + std::to_string(k)));
  return found;
}

std::optional<Eigen::Vector3d> vector_of(const CsvTable& table, int row, const std::vector<int>& columns) {
  if (columns.empty()) return std::nullopt;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < columns.size(); ++k) value[k] = table.number(row, columns[k]);
  return value;
}

/// Returns the indices of the columns for the third components of vectors, of those vectors that the table has.
std::vector<int> third_components(const NamedColumns& columns, const std::vector<std::string>& vectors) {
  std::vector<int> found;
  for (const std::string& name : vectors)
    if (columns.has(name + "1") && columns.has(name + "3")) found.push_back(columns.column(name + "3"));
  return found;
}

std::optional<double> number_of(const CsvTable& table, int row, int column) {
  if (column < 0) return std::nullopt;
  return table.number(row, column);
}

int image_of(const CsvTable& table, int row, int column) {
  constexpr std::int64_t kFarthest = 1'000'000'000;
  const std::int64_t image = table.integer(row, column);
  if (image >= -kFarthest && image <= kFarthest) return static_cast<int>(image);
  throw InputError(table.place(row), fmt::format("{} = {}, expected a number of cells up to 1e9 in magnitude",
                                                 table.columns()[column], image));
}

/// Indices of the columns in a table of contacts. The index of a missing column is -1. A list of indices is empty if
/// its columns are missing.
struct ContactColumns {
  int id1, id2, normal_force, kn, kt, kr, ktw, bridge_volume, bonded, rolling_moment_2d, twisting_moment, gap,
      kind;
  std::vector<int> image, force, shear_force, rolling_moment, point, normal;
  /// Columns of third components, which must be zero in two dimensions: those of forces up to rounding.
  std::vector<int> forces_across, images_across;
  std::array<int, 4> strengths{};

  ContactColumns(const NamedColumns& names, int dimension)
      : id1(names.column("id1")),
        id2(names.column("id2")),
        normal_force(column_if(names, "normal_force")),
        kn(column_if(names, "kn")),
        kt(column_if(names, "kt")),
        kr(column_if(names, "kr")),
        ktw(column_if(names, "ktw")),
        bridge_volume(column_if(names, "bridge_volume")),
        bonded(column_if(names, "bonded")),
        rolling_moment_2d(dimension == 2 ? column_if(names, "rolling_moment") : -1),
        twisting_moment(dimension == 3 ? column_if(names, "twisting_moment") : -1),
        gap(column_if(names, "gap")),
        kind(column_if(names, "kind")),
        image(numbered(names, "image", dimension)),
        force(numbered(names, "force", dimension)),
        shear_force(numbered(names, "shear_force", dimension)),
        rolling_moment(dimension == 3 ? numbered(names, "rolling_moment", 3) : std::vector<int>{}),
        point(numbered(names, "point", dimension)),
        normal(numbered(names, "normal", dimension)) {
    // A scalar force without direction is the normal force, unless the table has the force as a vector.
    if (normal_force < 0 && force.empty()) normal_force = column_if(names, "force");
    for (std::size_t k = 0; k < strengths.size(); ++k) strengths[k] = column_if(names, kStrengthNames[k]);
    if (dimension == 2) {
      forces_across = third_components(names, {"force", "shear_force"});
      images_across = third_components(names, {"image"});
    }
  }
};

/// Reads the two bodies of a contact: the identifiers of two grains, or the identifier of a grain and the name of a
/// wall, such as "x-".
/// @return whether the first body is a wall; if so, the two bodies must be exchanged
bool read_bodies(const CsvTable& table, int row, const ContactColumns& columns, ListedContact& c) {
  const auto first = wall_side(table.text(row, columns.id1)), second = wall_side(table.text(row, columns.id2));
  if (first && second)
    throw InputError(table.place(row),
                     fmt::format("the bodies {} and {} are both walls, expected a grain and a wall",
                                 first->name(), second->name()));
  c.wall = first ? first : second;
  c.id1 = table.integer(row, first ? columns.id2 : columns.id1);
  if (!c.wall) c.id2 = table.integer(row, columns.id2);
  return first.has_value();
}

/// Reads the kind of a contact. An empty text means that the kind is not known.
std::optional<ContactType> kind_of(const CsvTable& table, int row, int column) {
  if (column < 0) return std::nullopt;
  const std::string text(table.text(row, column));
  const std::optional<ContactType> kind = contact_type_of(text);
  if (!kind && !text.empty())
    throw InputError(table.place(row),
                     fmt::format("kind = {}, expected vertex-face, edge-edge, double or face-face", text));
  return kind;
}

/// Reads whether a contact is a bond.
bool is_bond(const CsvTable& table, int row, int column) {
  if (column < 0) return false;
  const double value = table.number(row, column);
  if (value != 0.0 && value != 1.0)
    throw InputError(table.place(row), fmt::format("{} = {}, expected 1 for a bond or 0 for another contact",
                                                   table.columns()[column], value));
  return value == 1.0;
}

/// Checks that the third components of vectors are zero in a two-dimensional packing.
/// @throws InputError naming file, line and column
void require_in_plane(const CsvTable& table, int row, const ContactColumns& columns, const ListedContact& c) {
  constexpr double kRounding = 1e-9;
  const auto norm = [](const std::optional<Eigen::Vector3d>& v) { return v ? v->norm() : 0.0; };
  const double force = std::max({norm(c.force), norm(c.shear_force), std::abs(c.normal_force.value_or(0.0))});
  const auto require = [&](int column, double largest) {
    const double value = table.number(row, column);
    if (std::abs(value) > largest)
      throw InputError(table.place(row),
                       fmt::format("{} = {:.6g}, expected 0 for disks in two dimensions; give --dimension 3 if "
                                   "the grains are spheres",
                                   table.columns()[column], value));
  };
  for (const int column : columns.forces_across) require(column, kRounding * force);
  for (const int column : columns.images_across) require(column, 0.0);
}

ListedContact read_contact(const CsvTable& table, int row, const ContactColumns& columns) {
  ListedContact c;
  const bool wall_first = read_bodies(table, row, columns, c);
  if (!columns.image.empty()) {
    c.image = Eigen::Vector3i::Zero();
    for (std::size_t k = 0; k < columns.image.size(); ++k)
      (*c.image)[k] = image_of(table, row, columns.image[k]);
  }
  c.force = vector_of(table, row, columns.force);
  c.normal_force = number_of(table, row, columns.normal_force);
  c.shear_force = vector_of(table, row, columns.shear_force);
  require_in_plane(table, row, columns, c);
  // If the table also has the columns shear_force1.., the columns force1.. contain the normal force. The tangential
  // force is then added, so that `force` is the total force. The tangential force is kept for comparison.
  if (c.force && c.shear_force) *c.force += *c.shear_force;
  c.rolling_moment = vector_of(table, row, columns.rolling_moment);
  // In 2D the rolling moment is a scalar. It is stored as the third component of a vector.
  if (columns.rolling_moment_2d >= 0)
    c.rolling_moment = Eigen::Vector3d(0.0, 0.0, table.number(row, columns.rolling_moment_2d));
  c.twisting_moment = number_of(table, row, columns.twisting_moment);
  c.kn = number_of(table, row, columns.kn);
  c.kt = number_of(table, row, columns.kt);
  c.kr = number_of(table, row, columns.kr);
  c.ktw = number_of(table, row, columns.ktw);
  c.bridge_volume = number_of(table, row, columns.bridge_volume);
  c.bond = is_bond(table, row, columns.bonded);
  for (std::size_t k = 0; k < c.strengths.size(); ++k) {
    c.strengths[k] = number_of(table, row, columns.strengths[k]).value_or(0.0);
    if (c.strengths[k] < 0.0)
      throw InputError(table.place(row), fmt::format("{} = {}, expected a strength of 0 or more",
                                                     kStrengthNames[k], c.strengths[k]));
  }
  c.point = vector_of(table, row, columns.point);
  c.normal = vector_of(table, row, columns.normal);
  if (!columns.point.empty()) {
    c.gap = number_of(table, row, columns.gap);
    c.kind = kind_of(table, row, columns.kind);
  }
  if (wall_first) reverse_actions(c);
  return c;
}

/// Checks the unit of a column.
/// @param why  reason why the unit must be `expected`, for messages
void require_unit(const CsvTable& table, const UnitColumn& column, const std::string& expected,
                  const char* why) {
  if (column.unit == expected) return;
  throw InputError(table.place(), fmt::format("column \"{}\" is in {}: expected {}, {}",
                                              table.columns()[static_cast<std::size_t>(column.index)],
                                              column.unit.empty() ? "no unit" : column.unit,
                                              expected.empty() ? "no unit" : expected, why));
}

void require_one_unit_of_force(const NamedColumns& names, const std::string& units) {
  std::optional<std::string> first;
  std::vector<std::string> forces = contact_names();
  std::erase_if(forces, [](const std::string& name) { return name.find("force") == std::string::npos; });
  if (!names.has("normal_force") && !names.has("force1")) forces.emplace_back("force");
  for (const std::string& name : forces) {
    if (!names.has(name)) continue;
    const UnitColumn column = names.unit_column(name);
    if (units == "SI" && !column.unit.empty()) require_unit(names.table(), column, "N", "the unit of SI");
    if (first) require_unit(names.table(), column, *first, "the unit of the other forces");
    first = column.unit;
  }
}

void check_columns(const std::string& option, const std::string& what, const std::vector<std::string>& known,
                   const std::map<std::string, std::string>& given) {
  for (const auto& [name, column] : given)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(
          option, fmt::format("\"{}\" is not the name of a {} column that floc reads; these columns are {}",
                              name, what, fmt::join(known, ", ")));
}

}  // namespace

std::string any_case(const std::string& name, const std::vector<std::string>& names) {
  if (name.size() == 1 || std::find(names.begin(), names.end(), name) != names.end()) return name;
  const auto same = [&](const std::string& other) {
    return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
  };
  const auto found = std::find_if(names.begin(), names.end(), same);
  return found == names.end() ? name : *found;
}

std::vector<SizeColumn> size_columns(const std::function<bool(const std::string&)>& has,
                                     const std::map<std::string, std::string>& given) {
  std::vector<SizeColumn> there, chosen;
  for (const SizeColumn& size : {SizeColumn{"radius", 1.0}, {"r", 1.0}, {"diameter", 0.5}}) {
    if (given.contains(size.name)) chosen.push_back(size);
    if (has(size.name)) there.push_back(size);
  }
  return chosen.empty() ? there : chosen;
}

void require_same_size(const FileLine& place, const SizeColumn& one, double radius, const SizeColumn& other,
                       double other_radius) {
  constexpr double kSixDigits = 1e-5;
  if (std::abs(other_radius - radius) <= kSixDigits * radius) return;
  throw InputError(place.text(), fmt::format("{} = {}, but {} = {}: these two sizes of the grain contradict "
                                             "each other; choose the right column with "
                                             "--columns radius=... or --columns diameter=...",
                                             one.name, radius / one.radius_of_one, other.name,
                                             other_radius / other.radius_of_one));
}

std::vector<ListedGrain> read_grains(const NamedColumns& columns, const std::string& units) {
  const CsvTable& table = columns.table();
  std::vector<Quantity> axis = {columns.unit_column("x"), columns.unit_column("y")};
  if (columns.has("z")) axis.push_back(columns.unit_column("z"));
  // Lengths are converted to the unit of the column x or, in SI units, to metres. If the column x has no unit, they are
  // not converted.
  const std::string length = units == "SI" && !axis[0].column.unit.empty() ? "m" : axis[0].column.unit;
  for (Quantity& of : axis) of.convert_to(table, length);
  std::vector<int> low;
  for (std::size_t k = 0; k < axis.size(); ++k)
    low.push_back(column_if(columns, std::string(1, "xyz"[k]) + "_low"));
  std::vector<std::pair<SizeColumn, Quantity>> sizes;
  for (const SizeColumn& size :
       size_columns([&](const std::string& name) { return columns.has(name); }, columns.names())) {
    sizes.emplace_back(size, columns.unit_column(size.name));
    sizes.back().second.convert_to(table, length);
  }
  // If no column gives the size, columns.column() throws: the column "radius" is missing.
  if (sizes.empty()) columns.column("radius");
  const int mass = column_if(columns, "mass");
  if (units == "SI" && mass >= 0 && !columns.unit_of(mass).empty())
    require_unit(table, columns.unit_column("mass"), "kg", "the unit of SI");
  const int id = column_if(columns, "id");
  std::vector<ListedGrain> grains;
  grains.reserve(table.n_rows());
  const auto file = std::make_shared<const std::string>(table.place() + ":");
  for (int row = 0; row < table.n_rows(); ++row) {
    ListedGrain grain;
    grain.place = {file, table.line(row)};
    grain.id = id >= 0 ? table.integer(row, id) : row;
    for (std::size_t k = 0; k < axis.size(); ++k) {
      const DoubleDouble x = table.double_double_number(row, axis[k].column.index) * axis[k].factor;
      grain.position[k] = x.high;
      // x.low contains the digits of x beyond the precision of a double. If the file has a column x_low, its value
      // replaces x.low.
      grain.position_low[k] = low[k] >= 0 ? table.number(row, low[k]) * axis[k].factor : x.low;
    }
    for (const auto& [size, of] : sizes) {
      const double radius = positive(table, row, of.column.index) * size.radius_of_one * of.factor;
      if (grain.radius != 0.0) require_same_size(grain.place, sizes.front().first, grain.radius, size, radius);
      if (grain.radius == 0.0) grain.radius = radius;
    }
    if (mass >= 0) grain.mass = positive(table, row, mass);
    grains.push_back(std::move(grain));
  }
  return grains;
}

std::vector<ListedContact> read_contacts(const NamedColumns& names, int dimension, const std::string& units) {
  const ContactColumns columns(names, dimension);
  const CsvTable& table = names.table();
  require_one_unit_of_force(names, units);
  std::vector<ListedContact> contacts;
  contacts.reserve(table.n_rows());
  const auto file = std::make_shared<const std::string>(table.place() + ":");
  for (int row = 0; row < table.n_rows(); ++row) {
    contacts.push_back(read_contact(table, row, columns));
    contacts.back().place = {file, table.line(row)};
  }
  return contacts;
}

std::vector<std::string> grain_names() {
  return {"x", "y", "z", "x_low", "y_low", "z_low", "radius", "diameter", "mass", "id"};
}

std::vector<std::string> contact_names() {
  return {"id1",
          "id2",
          "image1",
          "image2",
          "image3",
          "normal_force",
          "force1",
          "force2",
          "force3",
          "shear_force1",
          "shear_force2",
          "shear_force3",
          "rolling_moment",
          "rolling_moment1",
          "rolling_moment2",
          "rolling_moment3",
          "twisting_moment",
          "kn",
          "kt",
          "kr",
          "ktw",
          "tensile_strength",
          "shear_strength",
          "rolling_strength",
          "twisting_strength",
          "bridge_volume",
          "bonded",
          "point1",
          "point2",
          "point3",
          "normal1",
          "normal2",
          "normal3",
          "gap",
          "kind"};
}

std::vector<std::string> contact_names_in(const NamedColumns& columns, int dimension) {
  std::vector<std::string> names = contact_names();
  const std::string scalar = "rolling_moment";
  std::erase_if(names, [&](const std::string& name) {
    if (name == scalar) return dimension == 3;
    if (name.starts_with(scalar) || name == "twisting_moment") return dimension == 2;
    // A vector is read only if the table has its first component.
    const bool is_later = name.ends_with('2') || name.ends_with('3');
    return is_later && !columns.has(name.substr(0, name.size() - 1) + "1");
  });
  if (!columns.has("normal_force") && !columns.has("force1")) names.emplace_back("force");
  return names;
}

void add_unread_columns(const NamedColumns& columns, const std::vector<std::string>& names,
                        std::vector<std::string>& remarks) {
  std::vector<std::string> unread = columns.table().columns();
  for (const std::string& name : names)
    if (columns.has(name)) unread[static_cast<std::size_t>(columns.column(name))].clear();
  std::erase(unread, "");
  if (!unread.empty())
    remarks.push_back(
        fmt::format("{}: these columns are not read: {}", columns.table().place(), fmt::join(unread, ", ")));
}

void check_grain_columns(const std::string& option, const std::map<std::string, std::string>& given) {
  check_columns(option, "grain", grain_names(), given);
}

void check_contact_columns(const std::string& option, const std::map<std::string, std::string>& given) {
  check_columns(option, "contact", contact_names(), given);
}

std::vector<std::string> tokenize(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  std::vector<std::string> tokens;
  for (std::size_t at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
    tokens.emplace_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSpace, end);
  }
  return tokens;
}

}  // namespace floc
