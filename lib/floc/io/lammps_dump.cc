#include "floc/io/lammps_dump.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/packed_strings.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/base/read_text.h"
#include "floc/io/contact_file.h"
#include "floc/io/lammps_box.h"
#include "floc/io/listed_columns.h"
#include "floc/io/listed_space.h"
#include "floc/io/wall_columns.h"

namespace floc {
namespace {

constexpr std::string_view kFrameBegins = "ITEM: TIMESTEP";

/// Lines of one frame of a dump, followed by the first line of the next frame.
class FrameText {
 public:
  /// @param first  number (from 1) of the line of the file at which the frame begins
  FrameText(std::string path, int first) : path_(std::move(path)), first_(first) {}

  void add(std::string_view line) { lines_.push_back(line); }

  const std::string& path() const { return path_; }
  int number(std::size_t at) const { return first_ + static_cast<int>(at); }
  std::string place(std::size_t at) const { return fmt::format("{}:{}", path_, number(at)); }

  /// Returns line number `at` (counted from 0) of the frame. @param what  expected content of the line, for messages
  /// @throws InputError if the file ends before this line
  std::string_view line(std::size_t at, const std::string& what) const {
    if (at < lines_.size()) return lines_[at];
    throw InputError(path_,
                     fmt::format("the file ends at line {}, expected {}", number(lines_.size()) - 1, what));
  }

  std::string_view operator[](std::size_t at) const { return lines_[at]; }
  std::size_t n_lines() const { return lines_.size(); }

  std::int64_t integer(std::size_t at, const std::string& what) const {
    if (const auto value = parse_number<std::int64_t>(line(at, what))) return *value;
    throw InputError(place(at), fmt::format("the line is \"{}\", expected {}", (*this)[at], what));
  }

 private:
  std::string path_;
  int first_;
  PackedStrings lines_;
};

/// Reads the frames of a dump one by one, because the file may be larger than the memory. Keeps only the last of the
/// frames that the function `wanted` selects.
class FrameSearch {
 public:
  /// @param wanted  function that returns whether a frame is selected; the arguments of the function are the number of
  /// the frame (from 0) and the text of the time step
  FrameSearch(const std::string& path, std::function<bool(int, std::string_view)> wanted)
      : path_(path), wanted_(std::move(wanted)) {
    std::string begun;  // beginning of a line whose end is in the next piece of the file
    bool first = true;
    read_pieces(path, [&](std::string_view piece) {
      if (std::exchange(first, false)) {
        require_text(path, piece);
        piece = without_byte_order_mark(piece);
      }
      for (std::size_t end; (end = piece.find('\n')) != std::string_view::npos; piece.remove_prefix(end + 1)) {
        begun.append(piece.substr(0, end));
        pass(trimmed(begun));
        begun.clear();
      }
      begun.append(piece);
    });
    if (!begun.empty()) pass(trimmed(begun));
    if (begins_) pass_timestep("");
    if (timesteps_.empty())
      throw InputError(path, "the file contains no frame of a LAMMPS dump: it has no line \"ITEM: TIMESTEP\"");
  }

  int n_frames() const { return static_cast<int>(timesteps_.size()); }
  const std::vector<std::string>& timesteps() const { return timesteps_; }
  /// Returns the last selected frame, or nothing if no frame was selected.
  const std::optional<FrameText>& found() const { return found_; }

 private:
  void pass(std::string_view line) {
    ++n_lines_;
    if (begins_) pass_timestep(line);
    if (keeps_) found_->add(line);
    if (line != kFrameBegins) return;
    begins_ = true;
    keeps_ = false;
  }

  /// Processes the second line of a frame, which contains the time step.
  void pass_timestep(std::string_view line) {
    begins_ = false;
    timesteps_.emplace_back(line);
    keeps_ = wanted_(n_frames() - 1, line);
    if (!keeps_) return;
    found_.emplace(path_, n_lines_ - 1);
    found_->add(kFrameBegins);
  }

  std::string path_;
  std::function<bool(int, std::string_view)> wanted_;
  std::vector<std::string> timesteps_;
  std::optional<FrameText> found_;
  int n_lines_ = 0;
  bool begins_ = false;  ///< whether the previous line was the first line of a frame
  bool keeps_ = false;   ///< whether the current frame is selected, so that its lines are kept
};

/// One frame of a dump: the time step, the box, and the table of grains or contacts.
struct DumpFrame {
  std::int64_t timestep = 0;
  LammpsBox box;
  std::string box_place;
  /// Boundary styles of x, y and z ("pp": periodic); a malformed file may give fewer or more than three.
  std::vector<std::string> flags;
  std::string header;  ///< header line of the box, which contains `flags`
  CsvTable table;

  [[noreturn]] void refuse_header() const {
    throw InputError(
        box_place,
        fmt::format("the line is \"{}\", expected BOX BOUNDS [xy xz yz] and three boundary styles such as pp",
                    header));
  }
};

/// Reads the numbers of a line of the box. @param what  contents of the line, for messages
std::vector<double> box_numbers(const FrameText& dump, std::size_t at, const std::string& what,
                                std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& token : tokenize(dump.line(at, what))) {
    const auto value = parse_number<double>(token);
    if (!value)
      throw InputError(dump.place(at),
                       fmt::format("a bound or tilt of the box is \"{}\", expected a finite number{}", token,
                                   decimal_comma_hint(token)));
    numbers.push_back(*value);
  }
  if (numbers.size() != count)
    throw InputError(dump.place(at), fmt::format("the line has {} numbers, expected {}", numbers.size(), what));
  return numbers;
}

/// Reads a general triclinic box, "ITEM: BOX BOUNDS abc origin": three lines, each with a lattice vector and one
/// component of the corner of the box.
void read_general_box(const FrameText& dump, std::size_t at, const std::vector<std::string>& tokens,
                      DumpFrame& frame) {
  frame.box_place = dump.place(at);
  frame.header = dump[at];
  frame.flags.assign(tokens.begin() + 2, tokens.end());
  for (int a = 0; a < 3; ++a) {
    const std::vector<double> row = box_numbers(dump, at + 1 + static_cast<std::size_t>(a),
                                                "a lattice vector and a component of the origin", 4);
    frame.box.set_general(a, {row[0], row[1], row[2]});
    frame.box.low[a] = row[3];
  }
}

/// Reads the box of a frame. Line `at` of the frame is the header of the box. Each of the three lines below the header
/// contains the lower and the upper bound of the box along one axis and, for a triclinic box, a tilt.
void read_box(const FrameText& dump, std::size_t at, DumpFrame& frame) {
  std::vector<std::string> tokens = tokenize(dump[at].substr(std::string("ITEM: BOX BOUNDS").size()));
  if (tokens.size() >= 2 && tokens[0] == "abc" && tokens[1] == "origin")
    return read_general_box(dump, at, tokens, frame);
  const bool tilted = !tokens.empty() && tokens[0] == "xy";
  frame.box_place = dump.place(at);
  frame.header = dump[at];
  frame.flags.assign(tokens.begin() + (tilted ? std::min<std::ptrdiff_t>(3, std::ssize(tokens)) : 0),
                     tokens.end());
  if (tilted && (tokens.size() < 3 || tokens[1] != "xz" || tokens[2] != "yz")) frame.refuse_header();
  std::array<std::vector<double>, 3> rows;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string what = tilted ? "lower bound, upper bound and tilt" : "lower and upper bound";
    rows[a] = box_numbers(dump, at + 1 + a, what, tilted ? 3 : 2);
  }
  const double xy = tilted ? rows[0][2] : 0.0, xz = tilted ? rows[1][2] : 0.0, yz = tilted ? rows[2][2] : 0.0;
  // The listed bounds enclose the whole tilted box. Subtracting the tilts gives the bounds of the sides (LAMMPS manual,
  // Howto triclinic).
  rows[0][0] -= std::min({0.0, xy, xz, xy + xz});
  rows[0][1] -= std::max({0.0, xy, xz, xy + xz});
  rows[1][0] -= std::min(0.0, yz);
  rows[1][1] -= std::max(0.0, yz);
  for (std::size_t a = 0; a < 3; ++a) {
    frame.box.low[a] = rows[a][0];
    frame.box.side[a] = rows[a][1] - rows[a][0];
  }
  frame.box.xy = xy, frame.box.xz = xz, frame.box.yz = yz;
}

/// Checks that a table ends after the number of rows that its frame states.
/// @param at  line of the frame after the last of these rows  @param n  number of rows
/// @throws InputError if another row follows, instead of the next frame or the end of the file
void require_no_more_rows(const FrameText& dump, std::size_t at, std::int64_t n) {
  for (; at < dump.n_lines(); ++at) {
    if (trimmed(dump[at]).empty()) continue;
    if (dump[at].starts_with("ITEM:")) return;
    throw InputError(
        dump.place(at),
        fmt::format("the line is \"{}\", expected the next frame (ITEM: TIMESTEP) or the end of the file "
                    "after the {} rows that the frame states",
                    dump[at].substr(0, 80), n));
  }
}

/// Reads one frame of a dump: the time step, the box, and the table of grains or contacts.
/// @param items  word before the names of the columns: "ATOMS" for grains, "ENTRIES" for contacts
DumpFrame read_frame(const FrameText& dump, const std::string& items) {
  DumpFrame frame;
  frame.timestep = dump.integer(1, "the time step");
  std::int64_t n = -1;
  std::size_t at = 2;
  // The table is the last part of a frame. The number of rows and the box are before the table, in any order. The items
  // TIME and UNITS, which LAMMPS writes on request, are skipped.
  for (;;) {
    const std::string_view line = dump.line(at, "ITEM: " + items);
    const bool counts = line.starts_with("ITEM: NUMBER OF "), bounds = line.starts_with("ITEM: BOX BOUNDS");
    if ((counts && n >= 0) || (bounds && !frame.box_place.empty()))
      throw InputError(dump.place(at), fmt::format("the line \"{}\" occurs twice in one frame", line));
    if (counts) {
      n = dump.integer(at + 1, "the number of rows that follow");
      at += 2;
    } else if (bounds) {
      read_box(dump, at, frame);
      at += 4;
    } else if (line.starts_with("ITEM: " + items)) {
      break;
    } else if (line == "ITEM: TIME" || line == "ITEM: UNITS") {
      at += 2;
    } else {
      throw InputError(dump.place(at), fmt::format("the line is \"{}\", expected ITEM: {}", line, items));
    }
  }
  if (n < 0 || frame.box_place.empty())
    throw InputError(
        dump.place(at),
        "the frame gives no number of rows (ITEM: NUMBER OF ...) or no box (ITEM: BOX BOUNDS ...)");
  frame.table = CsvTable(dump.path(), tokenize(dump[at].substr(6 + items.size())));
  for (std::size_t row = at + 1; row <= at + static_cast<std::size_t>(n); ++row) {
    const std::string what = fmt::format("row {} of {}", row - at, n);
    const std::string_view line = dump.line(row, what);
    // If there is a line "ITEM:" here, the next frame begins, and the table has too few rows.
    if (line.starts_with("ITEM:"))
      throw InputError(dump.place(row), fmt::format("the line is \"{}\", expected {}", line, what));
    frame.table.add_row(dump.number(row), tokenize(line));
  }
  require_no_more_rows(dump, at + 1 + static_cast<std::size_t>(n), n);
  return frame;
}

/// Reads the grains of one frame of a dump. The number of the frame is `options.index` (from 0); without this option,
/// the last frame is read.
/// @param remarks  output: a sentence is added that names the frame that was read
DumpFrame read_grain_frame(const std::string& path, const ImportOptions& options,
                           std::vector<std::string>& remarks) {
  const FrameSearch search(
      path, [&](int index, std::string_view) { return !options.index || index == *options.index; });
  const int n = search.n_frames();
  if (!search.found())
    throw InputError(path,
                     fmt::format("index = {}, but the file contains frames 0 to {}", *options.index, n - 1));
  DumpFrame frame = read_frame(*search.found(), "ATOMS");
  remarks.push_back(fmt::format("frame {} of the frames 0 to {} is read, time step {}",
                                options.index.value_or(n - 1), n - 1, frame.timestep));
  return frame;
}

/// Returns the table of contacts in the last frame of a `dump local` or, if a time step is given, in the last frame
/// with this time step.
CsvTable read_contact_frame(const std::string& path, std::optional<std::int64_t> timestep) {
  const FrameSearch search(path, [&](int, std::string_view line) {
    return !timestep || parse_number<std::int64_t>(line) == timestep;
  });
  if (search.found()) return read_frame(*search.found(), "ENTRIES").table;
  throw InputError(path, fmt::format("the dump of contacts has no frame with time step {}, the time step of "
                                     "the grains; the time steps in the dump are {}",
                                     *timestep, fmt::join(search.timesteps(), ", ")));
}

/// Finds the columns of the positions and adds them to `names` under the keys x, y and z. The column of x is the first
/// of x, xu, xs and xsu that the dump contains; the columns of y and z have the same suffix. If `names` already has the
/// key x, nothing is added.
/// @return whether the positions are scaled, that is, expressed in units of the lattice vectors
bool find_positions(const CsvTable& table, std::map<std::string, std::string>& names) {
  for (const char* suffix : {"", "u", "s", "su"}) {
    if (names.contains("x") || !table.has(std::string("x") + suffix)) continue;
    for (const std::string axis : {"x", "y", "z"})
      if (table.has(axis + suffix) && !names.contains(axis)) names[axis] = axis + suffix;
    return suffix[0] == 's';
  }
  return false;
}

std::vector<ListedGrain> grains_of(const DumpFrame& frame, std::map<std::string, std::string> names) {
  const bool scaled = find_positions(frame.table, names);
  const NamedColumns columns(frame.table, names);
  if (!columns.has("radius") && !columns.has("diameter"))
    throw InputError(frame.table.place(),
                     fmt::format("the dump has no column radius or diameter; its columns are {}",
                                 fmt::join(frame.table.columns(), ", ")));
  std::vector<ListedGrain> grains = read_grains(columns);
  if (scaled)
    for (ListedGrain& grain : grains)
      grain.position = frame.box.low + frame.box.matrix().transpose() * grain.position;
  return grains;
}

/// Returns the cell and the periodicity of a frame; both are empty if the user gives the cell (`options.cell`).
ListedSpace space_of(const DumpFrame& frame, const std::vector<ListedGrain>& grains,
                     const ImportOptions& options) {
  ListedSpace space;
  space.place = frame.box_place;
  if (!options.cell.empty()) return space;
  if (frame.flags.size() != 3) frame.refuse_header();
  space.cell = frame.box.vectors();
  for (const std::string& flag : frame.flags) space.periodic.push_back(flag == "pp");
  space.origin = frame.box.low;
  space.positive_sides = !frame.box.general;
  space.boundary = fmt::format("the boundary of the box is \"{}\"", fmt::join(frame.flags, " "));
  space.mid_plane = frame.box.has_mid_plane(grains.empty() ? 0.0 : grains.front().position[2]);
  return space;
}

}  // namespace

bool is_lammps_dump(const std::string& path) {
  return begins_with(path, "ITEM: ");
}

std::vector<ListedContact> read_dump_contacts(const ImportOptions& options, int dimension,
                                              std::optional<std::int64_t> timestep) {
  const CsvTable table = read_contact_frame(options.contacts, timestep);
  return read_contacts(NamedColumns(table, options.contact_columns), dimension);
}

Imported read_lammps_dump(const std::string& path, const ImportOptions& options) {
  const DumpColumns columns(options.columns);
  check_grain_columns("--columns", columns.grains);
  ListedPacking listed = listed_packing(path, options);
  DumpFrame frame = read_grain_frame(path, options, listed.remarks);
  listed.grains = grains_of(frame, columns.grains);
  listed.wall_contacts = wall_contacts_of(frame.table, columns.walls, listed.grains);
  frame.table = {};  // releases the memory of the table, which is large
  listed.space = space_of(frame, listed.grains, options);
  listed.timestep = frame.timestep;
  return assemble(std::move(listed), options);
}

}  // namespace floc
