#include "floc/io/jambashbulk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

constexpr double kNormalStiffness = 1.0;

bool is_header(std::string_view line) {
  line = trimmed(line);
  return line.starts_with("N") && line.find("L1=") != std::string_view::npos;
}

/// Returns the numbers in a text, which are separated by commas, braces or white space.
std::vector<double> numbers(const std::string& place, std::string_view text) {
  std::vector<double> values;
  constexpr std::string_view kSeparators = ",{} \t\r";
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSeparators), text.size()));
    if (text.empty()) return values;
    const std::string_view token = text.substr(0, text.find_first_of(kSeparators));
    const auto value = parse_number<double>(token);
    if (!value)
      throw InputError(place, fmt::format("the line contains \"{}\", expected a finite number", token));
    values.push_back(*value);
    text.remove_prefix(token.size());
  }
}

/// Returns the end of a message about a wrong number of values. If `text` has commas between digits, this is a hint
/// about decimal commas, else an empty text.
const char* comma_hint(std::string_view text) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]));
  };
  for (std::size_t at = text.find(','); at != std::string_view::npos; at = text.find(',', at + 1))
    if (at > 0 && is_digit(at - 1) && is_digit(at + 1))
      return "; write numbers with a decimal point, not a comma";
  return "";
}

/// Returns the `count` numbers that follow "key =" in the header of a packing, up to the next key.
/// @throws InputError naming `place` if the key is missing, occurs twice, or is followed by more or fewer values
std::vector<double> header_numbers(const std::string& place, std::string_view header, const std::string& key,
                                   std::size_t count) {
  std::vector<double> found;
  for (std::size_t at = header.find(key); at != std::string_view::npos; at = header.find(key, at + 1)) {
    if (at > 0 && std::isalnum(static_cast<unsigned char>(header[at - 1]))) continue;
    const std::string_view rest = trimmed(header.substr(at + key.size()));
    if (!rest.starts_with('=')) continue;
    std::string_view value = rest.substr(1);
    const auto is_letter = [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) && c != 'e' && c != 'E';
    };
    const auto next_key = std::find_if(value.begin(), value.end(), is_letter);
    value = value.substr(0, static_cast<std::size_t>(next_key - value.begin()));
    if (!found.empty())
      throw InputError(place, fmt::format("{} is given twice in the header of the packing", key));
    found = numbers(place, value);
    if (found.size() != count)
      throw InputError(place, fmt::format("{} in the header of the packing has {} numbers, expected {}{}", key,
                                          found.size(), count, comma_hint(value)));
  }
  if (found.empty()) throw InputError(place, fmt::format("{} is missing in the header of the packing", key));
  return found;
}

/// Reads the lines of a file one by one, counts them, and skips comments (#) and empty lines.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), in_(read_text(path)) {}

  bool next() {
    while (std::getline(in_, line_)) {
      ++number_;
      const std::string_view text = trimmed(line_);
      if (!text.empty() && !text.starts_with('#')) return true;
    }
    return false;
  }
  const std::string& line() const { return line_; }
  std::string place() const { return fmt::format("{}:{}", path_, number_); }

 private:
  std::string path_;
  std::istringstream in_;
  std::string line_;
  int number_ = 0;
};

/// Advances `lines` to the header of packing number `index` (from 0).
void find_packing(const std::string& path, Lines& lines, int index) {
  int n_packings = 0;
  while (lines.next())
    if (is_header(lines.line()) && n_packings++ == index) return;
  if (n_packings == 0)
    throw InputError(path,
                     "the file contains no packing of jamBashbulk: it has no line \"N = ... ,L1= { ...\"");
  throw InputError(path,
                   fmt::format("index = {}, but the file contains packings 0 to {}", index, n_packings - 1));
}

/// Reads the `n` grains that follow the header of a packing, and moves each grain into the periodic cell.
Grains<2> read_grains(const std::string& path, Lines& lines, const Cell<2>& cell, int n) {
  // Each row is x, y and radius of a grain. No memory is reserved for `n` rows, because the number of grains in the
  // header may be wrong.
  std::vector<Eigen::Vector3d> rows;
  while (static_cast<int>(rows.size()) < n && lines.next()) {
    if (lines.line().find('}') != std::string::npos || is_header(lines.line())) break;
    const std::vector<double> row = numbers(lines.place(), lines.line());
    if (row.empty()) continue;
    if (row.size() != 3)
      throw InputError(lines.place(), fmt::format("the line has {} numbers, expected x, y and the radius{}",
                                                  row.size(), comma_hint(lines.line())));
    if (!(row[2] > 0.0)) throw InputError(lines.place(), fmt::format("radius = {}, must be positive", row[2]));
    const Vec<2> x(row[0], row[1]);
    if (!(cell.reduced(x).cwiseAbs().maxCoeff() < 1e9))
      throw InputError(lines.place(),
                       fmt::format("the grain at ({}, {}) lies more than 1e9 cells away from the periodic cell",
                                   x[0], x[1]));
    const Vec<2> wrapped = cell.wrapped(x);
    rows.emplace_back(wrapped[0], wrapped[1], row[2]);
  }
  if (static_cast<int>(rows.size()) != n)
    throw InputError(path,
                     fmt::format("the packing has {} grains, but its header says N = {}", rows.size(), n));
  Grains<2> grains = Grains<2>::with_size(n);
  for (int i = 0; i < n; ++i) {
    grains.position[i] = rows[i].head<2>();
    grains.radius[i] = rows[i][2];
    grains.mass[i] = 4.0 * rows[i][2] * rows[i][2];
  }
  return grains;
}

void refuse_options(const std::string& path, const ImportOptions& options) {
  if (options.law || !options.cell.empty() || !options.contacts.empty() || !options.columns.empty() ||
      !options.contact_columns.empty())
    throw InputError(
        path,
        "the format jamBashbulk determines the law, the cell, the columns and the contacts: leave out "
        "--law, --cell, --columns, --contacts");
  if (options.dimension.value_or(2) != 2)
    throw InputError(path, "packings of jamBashbulk are two-dimensional: leave out --dimension");
  if (options.units != "reduced")
    throw InputError(path, "files of jamBashbulk are in reduced units: leave out --units");
}

}  // namespace

bool is_jambashbulk(const std::string& path) {
  Lines lines(path);
  return lines.next() && is_header(lines.line());
}

Imported read_jambashbulk(const std::string& path, const ImportOptions& options) {
  refuse_options(path, options);
  Lines lines(path);
  find_packing(path, lines, options.index.value_or(0));
  const std::string header = lines.line();
  const std::string place = lines.place();
  const double n = header_numbers(place, header, "N", 1)[0];
  if (n < 1 || n > 1e9 || n != static_cast<int>(n))
    throw InputError(
        place, fmt::format("N = {}, expected a number of grains, which is a whole number from 1 to 1e9", n));

  State<2> state;
  const auto l1 = header_numbers(place, header, "L1", 2);
  const auto l2 = header_numbers(place, header, "L2", 2);
  state.packing.cell.matrix << l1[0], l1[1], l2[0], l2[1];
  if (!(state.packing.cell.volume() > 0.0))
    throw InputError(place, "the lattice vectors L1 and L2 span no area");
  // Packings of jamBashbulk have no friction. Their repulsion is linear, with the stiffness K_N = 1 in the units of the
  // format. The user therefore gives no law.
  LawParameters law;
  law.normal = LinearRepulsion{kNormalStiffness};
  state.packing.law = law;
  state.target_stress.setConstant(header_numbers(place, header, "P0", 1)[0]);
  state.packing.grains = read_grains(path, lines, state.packing.cell, static_cast<int>(n));
  state.path.branch = "imported";
  state.provenance.source = path;
  Imported imported;
  imported.state = std::move(state);
  // P0 is the pressure at which jamBashbulk relaxed the packing. Because the target stress is known, complete_import()
  // uses the default tolerances of floc. For packings without a known target stress it uses larger tolerances.
  imported.target_stress_known = true;
  return imported;
}

}  // namespace floc
