#include "floc/io/extended_xyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/listed_columns.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/body_name.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

/// One frame of an extended XYZ file: the comment line and, in `rows`, one line for each grain.
struct XyzFrame {
  int line = 0;  ///< number (from 1) of the line of the file at which the frame begins
  std::string comment;
  std::vector<std::string> rows;
};

std::vector<XyzFrame> read_frames(const std::string& path) {
  std::istringstream in(read_text(path));
  std::vector<XyzFrame> frames;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    // Empty lines are skipped only between frames. Within a frame, an empty line may be the comment line of plain XYZ.
    if (trimmed(line).empty()) continue;
    const auto n = parse_number<std::int64_t>(line);
    if (!n || *n < 0)
      throw InputError(fmt::format("{}:{}", path, number),
                       fmt::format("a frame begins with \"{}\", expected the number of grains", line));
    XyzFrame frame;
    frame.line = number;
    if (!std::getline(in, frame.comment))
      throw InputError(
          path, "the file ends before the comment line of a frame: expected a comment line with Properties=");
    // No memory is reserved for n rows, because n may be far too large in a damaged file. With such an n, the loop ends
    // with an error at the end of the file.
    for (std::int64_t k = 0; k < *n; ++k) {
      if (!std::getline(in, line))
        throw InputError(path, fmt::format("the file ends after {} of {} grains of a frame", k, *n));
      frame.rows.push_back(line);
    }
    number += 1 + static_cast<int>(*n);
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw InputError(path, "the file has no grains");
  return frames;
}

/// Returns the keys and values in the comment line of a frame. An entry of this line has the form key=value or
/// key="value with spaces".
std::map<std::string, std::string> keys_of(const std::string& place, std::string_view text) {
  std::map<std::string, std::string> keys;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t equals = std::min(text.find_first_of("= "), text.size());
    const std::string key(text.substr(0, equals));
    const bool has_value = equals < text.size() && text[equals] == '=';
    text.remove_prefix(std::min(equals + 1, text.size()));
    if (!has_value) continue;
    const bool quoted = text.starts_with('"');
    if (quoted) text.remove_prefix(1);
    const std::size_t end = text.find(quoted ? '"' : ' ');
    if (quoted && end == std::string_view::npos)
      throw InputError(place,
                       key + ": the value of this key begins with a quotation mark but has no closing one");
    if (!keys.emplace(key, text.substr(0, end)).second)
      throw InputError(place, key + ": this key is given twice");
    text.remove_prefix(std::min(end == std::string_view::npos ? text.size() : end + 1, text.size()));
  }
  return keys;
}

/// Returns the names of the columns of a frame.
/// @param properties  value of the key Properties, "name:type:count:...". In this text, pos:R:3 denotes the three
/// columns x, y and z. Any other name:type:n with n > 1 denotes n columns, which are called `name` followed by a number
/// from 1 to n
std::vector<std::string> columns_of(const std::string& place, const std::string& properties) {
  std::vector<std::string> fields;
  std::istringstream in(properties);
  for (std::string field; std::getline(in, field, ':');) fields.push_back(field);
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < fields.size(); k += 3) {
    const auto count = k + 2 < fields.size() ? parse_number<int>(fields[k + 2]) : std::nullopt;
    if (!count || *count < 1 || *count > 100)
      throw InputError(place,
                       fmt::format("Properties={}, expected name:type:count for each property", properties));
    if (fields[k] == "pos" && *count == 3)
      columns.insert(columns.end(), {"x", "y", "z"});
    else if (*count == 1)
      columns.push_back(fields[k]);
    else
      for (int a = 1; a <= *count; ++a) columns.push_back(fields[k] + std::to_string(a));
  }
  return columns;
}

/// Returns the names of the columns of a frame of plain xyz. The frame does not name its columns, so the name of a
/// column is its number, from 1. The positions are in columns 2 to 4, after the name of the element, unless the user
/// names other columns.
/// @param given  columns that the user named; this function adds the columns of the positions
std::vector<std::string> numbered_columns(const std::string& place, const XyzFrame& frame,
                                          std::map<std::string, std::string>& given) {
  if (!given.contains("radius") && !given.contains("diameter"))
    throw InputError(
        place,
        "the comment line of the frame has no Properties=, so the columns have no names: give the number of "
        "the column of the sizes, --columns radius=5 or --columns diameter=5, and also the numbers of the "
        "columns x, y and z unless these are columns 2 to 4");
  // emplace() keeps the number of a column that the user has given.
  given.emplace("x", "2");
  given.emplace("y", "3");
  given.emplace("z", "4");
  std::vector<std::string> columns;
  // The first row determines the number of columns, and CsvTable::add_row() refuses a later row with another number of
  // cells. A frame without grains has no first row.
  for (std::size_t k = 0; !frame.rows.empty() && k < tokenize(frame.rows.front()).size(); ++k)
    columns.push_back(std::to_string(k + 1));
  return columns;
}

std::vector<std::vector<double>> lattice_of(const std::string& place, const std::string& text) {
  const std::vector<std::string> tokens = tokenize(text);
  if (tokens.size() != 9)
    throw InputError(place, fmt::format("Lattice has {} numbers, expected 9", tokens.size()));
  std::vector<std::vector<double>> cell(3);
  for (std::size_t k = 0; k < 9; ++k) {
    const auto value = parse_number<double>(tokens[k]);
    if (!value)
      throw InputError(place, fmt::format("Lattice has \"{}\", expected a finite number{}", tokens[k],
                                          decimal_comma_hint(tokens[k])));
    cell[k / 3].push_back(*value);
  }
  return cell;
}

/// Reads the value of the key Origin: the corner of the cell. OVITO writes this key.
Eigen::Vector3d origin_of(const std::string& place, const std::string& text) {
  const std::vector<std::string> tokens = tokenize(text);
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = tokens.size() == 3 ? parse_number<double>(tokens[k]) : std::nullopt;
    if (!value) throw InputError(place, fmt::format("Origin=\"{}\", expected three finite numbers", text));
    origin[static_cast<Eigen::Index>(k)] = *value;
  }
  return origin;
}

/// Reads the value of the key pbc, such as "T T F". For each lattice vector, returns whether the packing is periodic
/// along this vector.
std::vector<bool> periodic_of(const std::string& place, const std::string& text) {
  std::vector<bool> periodic;
  for (std::string token : tokenize(text)) {
    std::transform(token.begin(), token.end(), token.begin(), [](unsigned char c) { return std::tolower(c); });
    const bool yes = token == "t" || token == "true" || token == "1";
    if (!yes && token != "f" && token != "false" && token != "0")
      throw InputError(place, fmt::format("pbc=\"{}\", expected T or F for each lattice vector", text));
    periodic.push_back(yes);
  }
  if (periodic.size() != 3)
    throw InputError(place, fmt::format("pbc=\"{}\", expected T or F for each lattice vector", text));
  return periodic;
}

/// Reads the value of the key walls: names of walls at the faces of the box, such as "x- x+". floc writes this key.
void add_walls(const std::string& place, const std::string& names, ListedSpace& space) {
  space.exact_walls = true;
  for (const std::string& name : tokenize(names)) {
    const auto wall = wall_side(name);
    if (!wall || space.cell.empty())
      throw InputError(place,
                       fmt::format("walls=\"{}\", expected names of faces of the box (Lattice), such as x- "
                                   "and x+",
                                   names));
    add_wall_at_face(*wall, space);
  }
}

/// Reads the cell, the boundaries and the dimension from the comment line of a frame.
ListedSpace space_of(const std::string& place, const std::map<std::string, std::string>& keys) {
  ListedSpace space;
  space.place = place;
  if (keys.contains("Lattice")) space.cell = lattice_of(place, keys.at("Lattice"));
  if (keys.contains("Origin")) space.origin = origin_of(place, keys.at("Origin"));
  if (keys.contains("pbc")) {
    space.periodic = periodic_of(place, keys.at("pbc"));
    space.boundary = fmt::format("pbc=\"{}\"", keys.at("pbc"));
  }
  if (keys.contains("walls")) add_walls(place, keys.at("walls"), space);
  if (!keys.contains("dimension")) return space;
  const auto dimension = parse_number<int>(keys.at("dimension"));
  if (!dimension || (*dimension != 2 && *dimension != 3))
    throw InputError(place, fmt::format("dimension={}, expected 2 or 3", keys.at("dimension")));
  space.dimension = *dimension;
  return space;
}

}  // namespace

bool is_extended_xyz(const std::string& path) {
  std::istringstream in(read_text(path));
  std::string first, second;
  std::getline(in, first);
  std::getline(in, second);
  const bool named =
      second.find("Properties=") != std::string::npos || path.ends_with(".xyz") || path.ends_with(".xyz.gz");
  return parse_number<std::int64_t>(first) && named;
}

Imported read_extended_xyz(const std::string& path, const ImportOptions& options) {
  check_grain_columns("--columns", options.columns);
  const std::vector<XyzFrame> frames = read_frames(path);
  const int n = static_cast<int>(frames.size());
  const int index = options.index.value_or(n - 1);
  if (index >= n)
    throw InputError(path, fmt::format("index = {}, but the file contains frames 0 to {}", index, n - 1));
  const XyzFrame& frame = frames[static_cast<std::size_t>(index)];
  const std::string place = fmt::format("{}:{}", path, frame.line + 1);
  std::map<std::string, std::string> keys = keys_of(place, frame.comment);
  ImportOptions named = options;
  CsvTable table(path, keys.contains("Properties") ? columns_of(place, keys["Properties"])
                                                   : numbered_columns(place, frame, named.columns));
  for (std::size_t k = 0; k < frame.rows.size(); ++k)
    table.add_row(frame.line + 2 + static_cast<int>(k), tokenize(frame.rows[k]));

  ListedPacking listed = listed_packing(path, options);
  listed.grains = read_grains(NamedColumns(table, named.columns));
  listed.space = space_of(place, keys);
  listed.remarks.push_back(fmt::format("frame {} of the frames 0 to {} is read", index, n - 1));
  return assemble(std::move(listed), options);
}

namespace {

template <int Dim>
std::string xyz_text(const State<Dim>& state) {
  const Packing<Dim> packing = with_walls_at_cell(state.packing);
  const Grains<Dim>& grains = packing.grains;
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  lattice.topLeftCorner<Dim, Dim>() = packing.cell.matrix;
  std::string text = fmt::format("{}\nLattice=\"", grains.size());
  for (int k = 0; k < 9; ++k) text += fmt::format("{}{}", k == 0 ? "" : " ", lattice(k / 3, k % 3));
  const auto periodic_along = [&](int a) { return between_walls(packing.walls, a) ? "F" : "T"; };
  text += fmt::format(
      "\" Properties=species:S:1:pos:R:3:radius:R:1:mass:R:1:id:I:1 pbc=\"{} {} {}\" dimension={}{}\n",
      periodic_along(0), periodic_along(1), Dim == 3 ? periodic_along(2) : "F", Dim,
      packing.walls.empty() ? "" : fmt::format(" walls=\"{}\"", wall_names(packing.walls)));
  for (int i = 0; i < grains.size(); ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head<Dim>() = grains.position[i];
    text += fmt::format("X {} {} {} {} {} {}\n", x[0], x[1], x[2], grains.radius[i], grains.mass[i],
                        grains.name(i));
  }
  return text;
}

}  // namespace

std::string extended_xyz_text(const AnyState& any) {
  return std::visit([](const auto& state) { return xyz_text(state); }, any);
}

}  // namespace floc
