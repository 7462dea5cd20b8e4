#include "floc/io/lammps_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/geometry/tilt.h"
#include "floc/io/lammps_box.h"
#include "floc/io/listed_columns.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/body_name.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

double sphere_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// Header and atoms of a LAMMPS data file.
struct DataFile {
  LammpsBox box;
  std::string box_place;
  std::string title;  ///< first line of the file, which LAMMPS ignores
  std::int64_t n_atoms = -1;
  CsvTable atoms;
  std::set<std::string>
      given;  ///< keywords of the header lines, and names of the sections, that have been read so far
};

std::string without_comment(const std::string& line) {
  return std::string(trimmed(line.substr(0, line.find('#'))));
}

/// Reads one line of the header of a LAMMPS data file: numbers, then a keyword, as in "0 5 xlo xhi".
void read_header_line(const std::string& place, const std::vector<std::string>& tokens, DataFile& data) {
  std::vector<double> values;
  std::string key;
  for (const std::string& token : tokens) {
    // A number with a decimal comma is reported as an error. If it were taken as a part of the keyword, the line would
    // be ignored.
    if (const auto value = parse_number<double>(token); value && key.empty())
      values.push_back(*value);
    else if (const std::string hint = decimal_comma_hint(token); !hint.empty())
      throw InputError(place, fmt::format("the line contains \"{}\", expected a finite number{}", token, hint));
    else
      key += (key.empty() ? "" : " ") + token;
  }
  if (!data.given.insert(key).second)
    throw InputError(place, fmt::format("the header line \"{}\" is given twice", key));
  const auto expect = [&](std::size_t count) {
    if (values.size() != count)
      throw InputError(place, fmt::format("the line has {} finite numbers before \"{}\", expected {}",
                                          values.size(), key, count));
  };
  if (key == "atoms") {
    expect(1);
    const auto n = whole_number(values[0]);
    if (!n)
      throw InputError(place, fmt::format("the header says {} atoms, expected a whole number", values[0]));
    data.n_atoms = *n;
  } else if (key == "xy xz yz") {
    expect(3);
    data.box.xy = values[0], data.box.xz = values[1], data.box.yz = values[2];
  } else if (key == "avec" || key == "bvec" || key == "cvec" || key == "abc origin") {
    expect(3);
    const Eigen::Vector3d vector(values[0], values[1], values[2]);
    if (key == "abc origin")
      data.box.low = vector;
    else
      data.box.set_general(key[0] - 'a', vector);
    data.box_place = place;
  } else if (key == "xlo xhi" || key == "ylo yhi" || key == "zlo zhi") {
    expect(2);
    const int a = key[0] - 'x';
    data.box.low[a] = values[0];
    data.box.side[a] = values[1] - values[0];
    data.box_place = place;
  } else if (key.ends_with("xy xz yz")) {
    // Header lines that do not describe the box (numbers of types, bonds, ...) do not affect the packing and are
    // ignored. A line that describes the box must not be ignored: an error is reported if its keyword is misspelt or
    // one of its numbers is not finite.
    throw InputError(
        place,
        fmt::format("the header line has the words \"{}\", expected three finite numbers and xy xz yz", key));
  } else if (key.find("lo ") != std::string::npos) {
    throw InputError(
        place,
        fmt::format(
            "the header line has the words \"{}\", expected two finite numbers and xlo xhi, ylo yhi or zlo zhi",
            key));
  }
}

using Columns = std::vector<std::string>;

/// For each atom style, names of the columns between the columns of the type and the position (LAMMPS manual,
/// read_data, section Atoms).
const std::map<std::string, Columns>& columns_of_styles() {
  static const std::map<std::string, Columns> columns = {
      {"sphere", {"diameter", "density"}},
      {"granular", {"diameter", "density"}},  // older name of sphere
      {"bpm/sphere", {"molecule", "diameter", "density"}},
      {"atomic", {}},
      {"charge", {"q"}},
      {"bond", {"molecule"}},
      {"angle", {"molecule"}},
      {"molecular", {"molecule"}},
      {"full", {"molecule", "q"}},
      {"dipole", {"q", "mux", "muy", "muz"}},
  };
  return columns;
}

/// Returns the columns of the section Atoms for the atom style in its heading, such as "Atoms # sphere". For the style
/// "hybrid", the columns that all styles have in common come first, and the columns of each style follow.
/// @throws InputError if the style has no radii or is unknown
Columns columns_of_style(const std::string& place, const std::string& style) {
  const std::vector<std::string> words = tokenize(style);
  const bool hybrid = words.size() > 1 && words[0] == "hybrid";
  Columns columns = {"id", "type"};
  if (hybrid) columns.insert(columns.end(), {"x", "y", "z"});
  for (const std::string& word : hybrid ? Columns(words.begin() + 1, words.end()) : words) {
    const auto found = columns_of_styles().find(word);
    if (found == columns_of_styles().end())
      throw InputError(
          place, fmt::format("atom_style {} is not known, expected sphere, bpm/sphere, or hybrid with one of "
                             "them",
                             style));
    // In the style bpm/sphere, the column of the molecule is before the column of the type.
    const bool molecule_first = !hybrid && !found->second.empty() && found->second[0] == "molecule";
    columns.insert(columns.end() - (molecule_first ? 1 : 0), found->second.begin(),
                   found->second.begin() + (molecule_first ? 1 : 0));
    columns.insert(columns.end(), found->second.begin() + (molecule_first ? 1 : 0), found->second.end());
  }
  if (!hybrid) columns.insert(columns.end(), {"x", "y", "z"});
  if (std::find(columns.begin(), columns.end(), "diameter") == columns.end())
    throw InputError(
        place, fmt::format("atom_style {} has no radii, expected sphere, bpm/sphere, or hybrid with one of "
                           "them",
                           style));
  return columns;
}

/// Returns the atom style in the heading of the section Atoms, such as "Atoms # sphere"; "sphere" if the heading has
/// none.
std::string style_of(const std::string& line) {
  const std::size_t comment = line.find('#');
  return comment == std::string::npos ? "sphere" : std::string(trimmed(line.substr(comment + 1)));
}

DataFile read_data(const std::string& path) {
  DataFile data;
  std::istringstream in(read_text(path));
  std::string section, style;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string place = fmt::format("{}:{}", path, ++number);
    const std::string text = without_comment(line);
    if (number == 1) data.title = line;
    if (number == 1 || text.empty()) continue;  // The first line is a title.
    std::vector<std::string> tokens = tokenize(text);
    if (std::isalpha(static_cast<unsigned char>(text[0]))) {
      section = text;
      if (!data.given.insert(section).second)
        throw InputError(place, fmt::format("the section {} occurs twice", section));
      if (section == "Atoms") {
        style = style_of(line);
        data.atoms = CsvTable(path, columns_of_style(place, style));
      }
    } else if (section.empty()) {
      read_header_line(place, tokens, data);
    } else if (section == "Atoms") {
      const Columns& columns = data.atoms.columns();
      if (tokens.size() != columns.size() && tokens.size() != columns.size() + 3)
        throw InputError(place, fmt::format("the line has {} cells, expected {} [ix iy iz] of atom_style {}",
                                            tokens.size(), fmt::join(columns, " "), style));
      tokens.resize(columns.size());
      data.atoms.add_row(number, tokens);
    }
  }
  if (data.box_place.empty())
    throw InputError(path, "the file has no box: it lacks a line \"... xlo xhi\" or \"... avec\"");
  if (data.n_atoms != data.atoms.n_rows())
    throw InputError(path, fmt::format("the file has {} atoms in its section Atoms, but its header says {}",
                                       data.atoms.n_rows(), data.n_atoms));
  return data;
}

/// Returns the words after `word` in the title of a data file, without commas, colons and semicolons.
std::vector<std::string> words_after(const std::string& title, const std::string& word) {
  std::string words = title;
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == ',' || c == ';' || c == ':'; }, ' ');
  std::vector<std::string> tokens = tokenize(words);
  tokens.erase(tokens.begin(), std::find(tokens.begin(), tokens.end(), word));
  if (!tokens.empty()) tokens.erase(tokens.begin());
  return tokens;
}

/// Adds the walls that are named in a title written by floc, such as "walls at the faces across x and z". A face named
/// after "open at", such as "open at z+", gets no wall.
void add_titled_walls(const std::string& title, ListedSpace& space) {
  std::vector<std::string> across = words_after(title, "across");
  across.erase(std::find(across.begin(), across.end(), "boundary"), across.end());
  const std::vector<std::string> open = words_after(title, "open");
  for (const std::string& word : across)
    for (const char* side : {"-", "+"})
      if (const auto wall = wall_side(word + side);
          wall && !space.periodic[static_cast<std::size_t>(wall->axis)] &&
          std::find(open.begin(), open.end(), word + side) == open.end())
        add_wall_at_face(*wall, space), space.exact_walls = true;
}

/// Returns the cell, the periodicity and the dimension of the packing. LAMMPS reads the dimension and the boundary from
/// an input script, and a data file has no place for them. floc therefore writes them into the title of a data file
/// ("dimension 2", "boundary f f p").
ListedSpace space_of(const DataFile& data, const std::vector<ListedGrain>& grains) {
  ListedSpace space;
  space.place = data.box_place;
  space.cell = data.box.vectors();
  space.origin = data.box.low;
  space.positive_sides = !data.box.general;
  space.mid_plane = data.box.has_mid_plane(grains.empty() ? 0.0 : grains.front().position[2]);
  if (const auto words = words_after(data.title, "dimension");
      !words.empty() && (words[0] == "2" || words[0] == "3"))
    space.dimension = words[0][0] - '0';
  const std::vector<std::string> boundary = words_after(data.title, "boundary");
  const auto is_style = [](const std::string& word) {
    return !word.empty() && word.size() <= 2 && word.find_first_not_of("pfsm") == std::string::npos;
  };
  if (boundary.size() < 3 || !std::all_of(boundary.begin(), boundary.begin() + 3, is_style)) return space;
  for (int a = 0; a < 3; ++a) space.periodic.push_back(boundary[a] == "p" || boundary[a] == "pp");
  space.boundary =
      fmt::format("the title of the file says \"boundary {} {} {}\"", boundary[0], boundary[1], boundary[2]);
  add_titled_walls(data.title, space);
  return space;
}

}  // namespace

bool is_lammps_data(const std::string& path) {
  const std::string text = read_text(path);
  const bool box = text.find("xlo xhi") != std::string::npos || text.find(" avec") != std::string::npos;
  return text.find(" atoms") != std::string::npos && box && text.find("\nAtoms") != std::string::npos;
}

Imported read_lammps_data(const std::string& path, const ImportOptions& options) {
  if (options.index.value_or(0) != 0)
    throw InputError(
        path,
        fmt::format("index = {}, but the file contains only one packing, whose index is 0: leave out --index",
                    *options.index));
  if (!options.columns.empty())
    throw InputError("--columns", "the columns of a LAMMPS data file are fixed: leave this option out");
  const DataFile data = read_data(path);
  ListedPacking listed = listed_packing(path, options);
  if (data.n_atoms == 0) throw InputError(path, "the file has no grains");
  listed.grains = read_grains(NamedColumns(data.atoms, {}));
  const int density_column = data.atoms.column("density");
  for (int i = 0; i < data.atoms.n_rows(); ++i) {
    const double density = data.atoms.number(i, density_column);
    if (!(density > 0.0))
      throw InputError(data.atoms.place(i), fmt::format("density = {}, must be positive", density));
    listed.grains[i].mass = density * sphere_volume(listed.grains[i].radius);
  }
  listed.space = space_of(data, listed.grains);
  return assemble(std::move(listed), options);
}

namespace {

/// Rotates the lattice vectors, which are the rows of `matrix`, so that the first vector is along x, the second is in
/// the x-y plane, and the diagonal of the result is positive.
/// @param rotation  output: the matrix that applies the same rotation to vectors of the packing
/// @return matrix whose rows are the rotated lattice vectors
template <int Dim>
Mat<Dim> lower_triangular(const Mat<Dim>& matrix, Mat<Dim>& rotation) {
  if (matrix.isLowerTriangular(0.0) && (matrix.diagonal().array() > 0.0).all()) {
    rotation.setIdentity();
    return matrix;
  }
  Mat<Dim> rows = Mat<Dim>::Zero();
  for (int a = 0; a < Dim; ++a) {
    Vec<Dim> rest = matrix.row(a).transpose();
    for (int pass = 0; pass < 2; ++pass)  // the second pass removes rounding errors of the first
      for (int b = 0; b < a; ++b) {
        const double part = rotation.row(b).dot(rest);
        rows(a, b) += part;
        rest -= part * rotation.row(b).transpose();
      }
    rows(a, a) = rest.norm();
    rotation.row(a) = rest.transpose() / rows(a, a);
  }
  return rows;
}

/// Replaces the lattice vectors, which are the rows of a lower triangular matrix, by vectors of the same lattice with
/// small tilts. A tilt is an element below the diagonal. Afterwards, the magnitude of each tilt is at most half of the
/// diagonal element (side) in the same column.
template <int Dim>
void reduce_tilts(Mat<Dim>& rows) {
  for (int a = 1; a < Dim; ++a)
    for (int b = a - 1; b >= 0; --b) rows.row(a) -= sides_in_tilt(rows(a, b), rows(b, b)) * rows.row(b);
}

/// Returns a description of the dimension, boundary and walls of a packing in the notation of LAMMPS commands. The
/// description is a part of the title of a data file, because the format has no other place for it.
template <int Dim>
std::string space_in_words(const std::vector<Wall<Dim>>& walls) {
  std::string axes, boundary, open;
  for (const Wall<Dim>& wall : walls)
    if (wall.open) open += " " + wall_name(wall);
  for (int a = 0; a < Dim; ++a) {
    const bool ends = between_walls(walls, a);
    const bool walled =
        std::any_of(walls.begin(), walls.end(), [&](const Wall<Dim>& w) { return w.axis == a && !w.open; });
    if (walled) axes += fmt::format("{}{}", axes.empty() ? "" : " and ", "xyz"[a]);
    boundary += ends ? " f" : " p";
  }
  if (!open.empty()) open = "; open at" + open;
  if (Dim == 2) boundary += " p";
  if (walls.empty()) return fmt::format("; dimension {}, boundary{}", Dim, boundary);
  if (axes.empty()) return fmt::format("; dimension {}, boundary{}{}", Dim, boundary, open);
  return fmt::format("; dimension {}; walls at the faces across {}: boundary{}, fix wall/gran{}", Dim, axes,
                     boundary, open);
}

/// Returns identifiers for the atoms. LAMMPS requires identifiers of 1 or more. If all grains satisfy this, the atoms
/// get the identifiers of the grains; otherwise the atoms are numbered 1, 2, ...
template <int Dim>
std::vector<std::int64_t> atom_numbers(const Grains<Dim>& grains) {
  std::vector<std::int64_t> numbers = grains.id;
  if (!numbers.empty() && *std::min_element(numbers.begin(), numbers.end()) >= 1) return numbers;
  numbers.resize(grains.size());
  std::iota(numbers.begin(), numbers.end(), std::int64_t{1});
  return numbers;
}

template <int Dim>
std::string lammps_text(const State<Dim>& state) {
  const Packing<Dim> packing = with_walls_at_cell(state.packing);
  const Grains<Dim>& grains = packing.grains;
  Mat<Dim> rotation;
  Mat<Dim> rows = lower_triangular<Dim>(packing.cell.matrix, rotation);
  reduce_tilts<Dim>(rows);
  Eigen::Matrix3d box = Eigen::Matrix3d::Identity();
  box.topLeftCorner<Dim, Dim>() = rows;
  Cell<Dim> cell;
  cell.matrix = rows;
  std::string text = fmt::format(
      "floc: {} grains, atom_style sphere{}\n\n{} atoms\n1 atom types\n\n0 {} xlo xhi\n0 {} ylo yhi\n",
      grains.size(), space_in_words<Dim>(packing.walls), grains.size(), box(0, 0), box(1, 1));
  text += Dim == 3 ? fmt::format("0 {} zlo zhi\n", box(2, 2)) : std::string("-0.5 0.5 zlo zhi\n");
  if (!rows.isDiagonal(0.0)) text += fmt::format("{} {} {} xy xz yz\n", box(1, 0), box(2, 0), box(2, 1));
  text += "\nAtoms # sphere\n\n";
  const std::vector<std::int64_t> number = atom_numbers(grains);
  for (int i = 0; i < grains.size(); ++i) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head<Dim>() = packing.walls.empty() ? cell.wrapped(rotation * grains.position[i]) : grains.position[i];
    text += fmt::format("{} 1 {} {} {} {} {}\n", number[i], 2.0 * grains.radius[i],
                        grains.mass[i] / sphere_volume(grains.radius[i]), x[0], x[1], x[2]);
  }
  return text;
}

}  // namespace

std::string lammps_data_text(const AnyState& any) {
  return std::visit([](const auto& state) { return lammps_text(state); }, any);
}

}  // namespace floc
