#include "floc/io/yade_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/contact/law_parameters.h"
#include "floc/io/contact_file.h"
#include "floc/io/law_text.h"
#include "floc/io/listed_columns.h"
#include "floc/io/listed_space.h"
#include "floc/io/table_text.h"

namespace floc {
namespace {

/// Table in a text file of YADE (spheres or interactions), and the data in the comments of the file: the periodic cell,
/// walls and gravity.
struct YadeTable {
  CsvTable table;
  ListedSpace space;
  /// Reads a comment line. @return whether the comment gives the cell, a wall or gravity
  bool take_space(const std::string& place, const std::vector<std::string>& tokens);
};

/// Returns the words of a comment line. For "#format x_y_z_r", they are the names of the columns: x, y, z and r.
std::vector<std::string> comment_tokens(std::string line) {
  line.erase(0, line.find_first_not_of("# \t"));
  if (line.starts_with("format ")) {
    line.erase(0, 7);
    std::replace(line.begin(), line.end(), '_', ' ');
  }
  return tokenize(line);
}

bool contains(const std::vector<std::string>& tokens, const std::string& token) {
  return std::find(tokens.begin(), tokens.end(), token) != tokens.end();
}

/// Reads the numbers at the end of a comment.
/// @param what  meaning of the numbers, for messages
std::vector<double> comment_numbers(const std::string& place, const std::string& what,
                                    const std::vector<std::string>& tokens, std::size_t first,
                                    std::size_t count) {
  if (tokens.size() != first + count)
    throw InputError(place, fmt::format("{} has {} numbers, expected {}", what,
                                        tokens.size() - std::min(first, tokens.size()), count));
  std::vector<double> numbers;
  for (std::size_t k = first; k < tokens.size(); ++k) {
    const auto value = parse_number<double>(tokens[k]);
    if (!value)
      throw InputError(place, fmt::format("{} contains \"{}\", expected a finite number{}", what, tokens[k],
                                          decimal_comma_hint(tokens[k])));
    numbers.push_back(*value);
  }
  return numbers;
}

std::vector<std::vector<double>> parse_cell(const std::string& place, const std::vector<std::string>& tokens) {
  const std::vector<double> numbers = comment_numbers(place, "the cell", tokens, 1, 9);
  std::vector<std::vector<double>> cell;
  for (std::size_t a = 0; a < 9; a += 3) cell.emplace_back(&numbers[a], &numbers[a] + 3);
  return cell;
}

/// Reads a comment "wall x- POSITION".
void parse_wall(const std::string& place, const std::vector<std::string>& tokens, ListedSpace& space) {
  const std::optional<WallSide> wall = tokens.size() > 1 ? wall_side(tokens[1]) : std::nullopt;
  if (!wall)
    throw InputError(place, fmt::format("the wall is \"{}\", expected one of x-, x+, y-, y+, z- and z+",
                                        tokens.size() > 1 ? tokens[1] : ""));
  ListedEnds& ends = ends_along(wall->axis, space);
  if (wall->side < 0 ? ends.low : ends.high)
    throw InputError(place, fmt::format("the wall {} is given twice", wall->name()));
  add_wall(*wall, comment_numbers(place, "the wall", tokens, 2, 1)[0], space);
}

bool YadeTable::take_space(const std::string& place, const std::vector<std::string>& tokens) {
  if (tokens.empty()) return false;
  if (tokens[0] == "cell") {
    if (!space.cell.empty()) throw InputError(place, "the cell is given twice, first at " + space.place);
    space.place = place;
    space.cell = parse_cell(place, tokens);
  } else if (tokens[0] == "wall") {
    parse_wall(place, tokens, space);
  } else if (tokens[0] == "gravity") {
    const std::vector<double> gravity = comment_numbers(place, "gravity", tokens, 1, 3);
    space.gravity = Eigen::Vector3d(gravity[0], gravity[1], gravity[2]);
  } else {
    return false;
  }
  return true;
}

/// Reads a text file of YADE.
/// @param mark  name of a column. A comment line that contains this name contains the names of all columns
/// @param columns  names of the columns if no comment line names them; empty if the file must have such a comment line
YadeTable read_table(const std::string& path, const std::string& mark, std::vector<std::string> columns) {
  YadeTable result;
  std::istringstream in(read_text(path));
  bool begun = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string text(trimmed(line));
    if (text.empty()) continue;
    if (text.starts_with('#')) {
      const std::vector<std::string> tokens = comment_tokens(text);
      if (result.take_space(fmt::format("{}:{}", path, number), tokens)) continue;
      if (!begun && contains(tokens, mark)) {
        // Only a comment before the first row of the table can give the names of the columns.
        columns = tokens;
      }
      continue;
    }
    if (columns.empty())
      throw InputError(
          fmt::format("{}:{}", path, number),
          fmt::format(
              "no comment line before this line gives the names of the columns: expected \"# ... {} ...\"",
              mark));
    if (!begun) result.table = CsvTable(path, columns);
    begun = true;
    result.table.add_row(number, tokenize(text));
  }
  if (!begun) result.table = CsvTable(path, columns);
  return result;
}

/// Reads contacts from a table of interactions of YADE. YADE lists the forces on the second body; their signs are
/// reversed here, because floc expects the forces on the first body.
std::vector<ListedContact> read_interactions(const CsvTable& table, int dimension) {
  std::map<std::string, std::string> names;
  if (table.has("ks")) names["kt"] = "ks";
  const char axes[] = {'x', 'y', 'z'};
  for (int a = 0; a < dimension; ++a) {
    const std::string index = std::to_string(a + 1);
    if (table.has("cellx")) names["image" + index] = std::string("cell") + axes[a];
    names["force" + index] = std::string("fn") + axes[a];
    names["shear_force" + index] = std::string("fs") + axes[a];
  }
  std::vector<ListedContact> contacts = read_contacts(NamedColumns(table, names), dimension);
  for (ListedContact& c : contacts) *c.force *= -1.0, *c.shear_force *= -1.0;
  return contacts;
}

/// Returns a contact law with linear repulsion and Coulomb friction. The normal and tangential stiffness of the law are
/// the means of the columns kn and ks; the coefficient of friction is tan_phi.
/// @throws InputError if one of these columns is missing, or if tan_phi is not the same in all rows
Law law_of(const CsvTable& table, const std::string& path) {
  if (!table.has("kn") || !table.has("ks") || !table.has("tan_phi") || table.n_rows() == 0)
    throw InputError(
        path, "the list of interactions does not have all of the columns kn, ks and tan_phi: give --law");
  const auto mean = [&](const std::string& name) {
    double sum = 0.0;
    for (int row = 0; row < table.n_rows(); ++row) sum += table.number(row, table.column(name));
    return sum / table.n_rows();
  };
  const int friction = table.column("tan_phi");
  for (int row = 1; row < table.n_rows(); ++row)
    if (table.number(row, friction) != table.number(0, friction))
      throw InputError(table.place(row), fmt::format("tan_phi = {}, but tan_phi = {} in the first interaction: "
                                                     "a contact law has one friction coefficient; give --law",
                                                     table.text(row, friction), table.text(0, friction)));
  LawParameters law;
  law.normal = LinearRepulsion{mean("kn")};
  law.friction = CoulombFriction{table.number(0, friction), mean("ks")};
  if (const std::vector<std::string> faults = law.validate(); !faults.empty())
    throw InputError(path, faults.front());
  return law;
}

void check_no_contact_columns(const ImportOptions& options) {
  if (!options.contact_columns.empty())
    throw InputError(
        "--contact-columns",
        "the file of interactions of YADE contains the names of its columns; leave this option out");
}

/// Whether a file begins with a number. If so, no line with the names of the columns precedes the data.
bool begins_with_number(const std::string& path) {
  const std::string text = beginning_of_table(path);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] >= '0' && text[first] <= '9';
}

/// Returns the words of the first line of a file if this line is a comment, else an empty list.
std::vector<std::string> first_comment(const std::string& path) {
  if (!begins_with(path, "#")) return {};
  std::istringstream in(beginning_of_table(path));
  std::string line;
  std::getline(in, line);
  return comment_tokens(std::string(trimmed(line)));
}

}  // namespace

bool is_yade_interactions(const std::string& path) {
  const std::vector<std::string> tokens = first_comment(path);
  return contains(tokens, "id1") && contains(tokens, "id2") && contains(tokens, "fnx");
}

std::vector<ListedContact> read_yade_contacts(const ImportOptions& options, int dimension) {
  check_no_contact_columns(options);
  return read_interactions(read_table(options.contacts, "id1", {}).table, dimension);
}

bool is_yade_text(const std::string& path) {
  const std::vector<std::string> tokens = first_comment(path);
  if (tokens.empty()) return false;
  return (tokens[0] == "cell" && tokens.size() == 10) || (tokens[0] == "wall" && tokens.size() == 3) ||
         (contains(tokens, "x") && contains(tokens, "y") && contains(tokens, "z") && contains(tokens, "r"));
}

Imported read_yade_text(const std::string& path, const ImportOptions& options) {
  if (options.index.value_or(0) != 0)
    throw InputError(
        path,
        fmt::format("index = {}, but the file contains only one packing, whose index is 0: leave out --index",
                    *options.index));
  check_grain_columns("--columns", options.columns);
  if (options.contacts.empty()) check_no_contact_columns(options);
  const YadeTable spheres = read_table(path, "x", {"x", "y", "z", "r"});
  const bool says_law = !options.law && !options.contacts.empty() &&
                        (is_yade_interactions(options.contacts) || begins_with_number(options.contacts));
  ImportOptions completed = options;
  if (says_law) completed.law = law_of(read_table(options.contacts, "id1", {}).table, options.contacts);
  ListedPacking listed = listed_packing(path, completed);
  listed.grains = read_grains(NamedColumns(spheres.table, options.columns));
  listed.space = spheres.space;
  if (listed.space.place.empty()) listed.space.place = path;
  // YADE has a cell only if the packing is periodic. A packing without a cell ends at walls or, where there is no wall,
  // in free space.
  if (!listed.space.cell.empty()) listed.space.periodic = {true, true, true};
  if (listed.space.cell.empty() && !listed.space.ends.empty()) {
    listed.space.periodic = {false, false, false};
    listed.space.boundary = "the file gives walls and no cell";
  }
  if (says_law)
    listed.remarks.push_back("the contact law has the mean stiffnesses of the listed contacts: " +
                             law_text(listed.law));
  Imported imported = assemble(std::move(listed), options);
  imported.law_of_contacts = says_law;
  return imported;
}

}  // namespace floc
