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

/// Returns the numbers of a text, separated by commas, braces and white space.
std::vector<double> numbers(const std::string& place, std::string_view text) {
  std::vector<double> values;
  constexpr std::string_view kSeparators = ",{} \t\r";
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSeparators), text.size()));
    if (text.empty()) return values;
    const std::string_view token = text.substr(0, text.find_first_of(kSeparators));
    const auto value = parse_number<double>(token);
    if (!value) throw InputError(place, fmt::format("\"{}\", expected a finite number", token));
    values.push_back(*value);
    text.remove_prefix(token.size());
  }
}

/// Returns a hint for the message about a wrong count of numbers, if commas between digits may be the reason.
const char* comma_hint(std::string_view text) {
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at]));
  };
  for (std::size_t at = text.find(','); at != std::string_view::npos; at = text.find(',', at + 1))
    if (at > 0 && is_digit(at - 1) && is_digit(at + 1))
      return "; numbers are written with a decimal point, not a comma";
  return "";
}

/// Returns the `count` numbers after "key =" in a header, up to the next key.
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
    if (!found.empty()) throw InputError(place, fmt::format("{} is given twice", key));
    found = numbers(place, value);
    if (found.size() != count)
      throw InputError(
          place, fmt::format("{} has {} numbers, expected {}{}", key, found.size(), count, comma_hint(value)));
  }
  if (found.empty()) throw InputError(place, fmt::format("{} is missing", key));
  return found;
}

/// Lines of a file, numbered, without comments.
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

/// Advances to the header of packing `index`.
void find_packing(const std::string& path, Lines& lines, int index) {
  int n_packings = 0;
  while (lines.next())
    if (is_header(lines.line()) && n_packings++ == index) return;
  if (n_packings == 0)
    throw InputError(path, "holds no packing of jamBashbulk: no line \"N = ... ,L1= { ...\"");
  throw InputError(path, fmt::format("index = {}, but it holds packings 0 to {}", index, n_packings - 1));
}

/// Reads the listed grains and moves each into the cell.
Grains<2> read_grains(const std::string& path, Lines& lines, const Cell<2>& cell, int n) {
  // Columns x, y and radius. The numbers are counted before memory is reserved for the number of grains in the
  // header.
  std::vector<Eigen::Vector3d> rows;
  while (static_cast<int>(rows.size()) < n && lines.next()) {
    if (lines.line().find('}') != std::string::npos || is_header(lines.line())) break;
    const std::vector<double> row = numbers(lines.place(), lines.line());
    if (row.empty()) continue;
    if (row.size() != 3)
      throw InputError(lines.place(), fmt::format("has {} numbers, expected x, y and the radius{}", row.size(),
                                                  comma_hint(lines.line())));
    if (!(row[2] > 0.0)) throw InputError(lines.place(), fmt::format("radius = {}, must be positive", row[2]));
    const Vec<2> x(row[0], row[1]);
    if (!(cell.reduced(x).cwiseAbs().maxCoeff() < 1e9))
      throw InputError(
          lines.place(),
          fmt::format("a grain at ({}, {}) lies more than 1e9 cells away from the cell", x[0], x[1]));
    const Vec<2> wrapped = cell.wrapped(x);
    rows.emplace_back(wrapped[0], wrapped[1], row[2]);
  }
  if (static_cast<int>(rows.size()) != n)
    throw InputError(path, fmt::format("has {} grains, but its header says N = {}", rows.size(), n));
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
    throw InputError(path,
                     "a file of jamBashbulk holds law, cell and columns itself: leave out --law, --cell, "
                     "--columns, --contacts");
  if (options.dimension.value_or(2) != 2) throw InputError(path, "jamBashbulk is two-dimensional");
  if (options.units != "reduced") throw InputError(path, "jamBashbulk is in reduced units");
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
    throw InputError(place, fmt::format("N = {}, expected a number of grains", n));

  State<2> state;
  const auto l1 = header_numbers(place, header, "L1", 2);
  const auto l2 = header_numbers(place, header, "L2", 2);
  state.packing.cell.matrix << l1[0], l1[1], l2[0], l2[1];
  if (!(state.packing.cell.volume() > 0.0)) throw InputError(place, "L1 and L2 span no area");
  // The format is frictionless and linear with K_N = 1 in its own units, so the law need not be given.
  LawParameters law;
  law.normal = LinearRepulsion{kNormalStiffness};
  state.packing.law = law;
  state.target_stress.setConstant(header_numbers(place, header, "P0", 1)[0]);
  state.packing.grains = read_grains(path, lines, state.packing.cell, static_cast<int>(n));
  state.path.branch = "imported";
  state.provenance.source = path;
  Imported imported;
  imported.state = std::move(state);
  // P0 is the pressure that the packing was relaxed to, so its equilibrium is held to floc's own tolerance.
  imported.target_stress_known = true;
  return imported;
}

}  // namespace floc
