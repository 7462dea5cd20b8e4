#include "floc/io/lammps_dump.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/io/contact_file.h"
#include "floc/io/lammps_box.h"
#include "floc/io/listed_columns.h"

namespace floc {
namespace {

/// Lines of a dump, numbered from 1.
struct DumpLines {
  std::string path;
  std::vector<std::string> lines;

  explicit DumpLines(const std::string& file) : path(file) {
    std::string begun;  // a line of which the rest is in the next piece
    read_pieces(file, [&](std::string_view piece) {
      for (std::size_t end; (end = piece.find('\n')) != std::string_view::npos; piece.remove_prefix(end + 1)) {
        begun.append(piece.substr(0, end));
        lines.emplace_back(trimmed(begun));
        begun.clear();
      }
      begun.append(piece);
    });
    if (!begun.empty()) lines.emplace_back(trimmed(begun));
  }

  std::string place(std::size_t at) const { return fmt::format("{}:{}", path, at + 1); }

  /// The line, which has to be there. @param what  what is expected in it
  const std::string& line(std::size_t at, const std::string& what) const {
    if (at < lines.size()) return lines[at];
    throw InputError(path, fmt::format("ends at line {}, expected {}", lines.size(), what));
  }

  std::int64_t integer(std::size_t at, const std::string& what) const {
    if (const auto value = parse_number<std::int64_t>(line(at, what))) return *value;
    throw InputError(place(at), fmt::format("\"{}\", expected {}", lines[at], what));
  }
};

/// One frame: its time step, box and rows.
struct Frame {
  std::int64_t timestep = 0;
  LammpsBox box;
  std::string box_place;
  std::string flags;  ///< periodicity of x, y, z: "pp pp pp"
  CsvTable table;
};

/// Lines on which frames begin.
std::vector<std::size_t> frame_starts(const DumpLines& dump) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 0; at < dump.lines.size(); ++at)
    if (dump.lines[at] == "ITEM: TIMESTEP") starts.push_back(at);
  if (starts.empty())
    throw InputError(dump.path, "no frame of a LAMMPS dump in it: no line \"ITEM: TIMESTEP\"");
  return starts;
}

/// Reads the three lines of a box whose header begins at `at`: bounds of what it occupies, then its tilts.
void read_box(const DumpLines& dump, std::size_t at, Frame& frame) {
  std::vector<std::string> tokens = tokenize(dump.lines[at].substr(std::string("ITEM: BOX BOUNDS").size()));
  const bool tilted = !tokens.empty() && tokens[0] == "xy";
  if (tokens.size() != (tilted ? 6u : 3u) || (tilted && (tokens[1] != "xz" || tokens[2] != "yz")))
    throw InputError(
        dump.place(at),
        fmt::format("\"{}\", expected BOX BOUNDS [xy xz yz] and three periodicities as pp", dump.lines[at]));
  frame.flags = fmt::format("{}", fmt::join(tokens.end() - 3, tokens.end(), " "));
  frame.box_place = dump.place(at);
  std::array<std::vector<double>, 3> rows;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string what = tilted ? "lower bound, upper bound and tilt" : "lower and upper bound";
    for (const std::string& token : tokenize(dump.line(at + 1 + a, what))) {
      const auto value = parse_number<double>(token);
      if (!value)
        throw InputError(dump.place(at + 1 + a), fmt::format("\"{}\", expected a finite number", token));
      rows[a].push_back(*value);
    }
    if (rows[a].size() != (tilted ? 3u : 2u))
      throw InputError(dump.place(at + 1 + a),
                       fmt::format("has {} numbers, expected {}", rows[a].size(), what));
  }
  const double xy = tilted ? rows[0][2] : 0.0, xz = tilted ? rows[1][2] : 0.0, yz = tilted ? rows[2][2] : 0.0;
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

/// Reads the frame that begins at line `at`. @param items  "ATOMS" or "ENTRIES"
Frame read_frame(const DumpLines& dump, std::size_t at, const std::string& items) {
  Frame frame;
  frame.timestep = dump.integer(at + 1, "the time step");
  std::int64_t n = -1;
  for (at += 2;;) {
    const std::string& line = dump.line(at, "ITEM: " + items);
    if (line.starts_with("ITEM: NUMBER OF ")) {
      n = dump.integer(at + 1, "how many rows follow");
      at += 2;
    } else if (line.starts_with("ITEM: BOX BOUNDS")) {
      read_box(dump, at, frame);
      at += 4;
    } else if (line.starts_with("ITEM: " + items)) {
      break;
    } else if (line == "ITEM: TIME" || line == "ITEM: UNITS") {
      at += 2;
    } else {
      throw InputError(dump.place(at), fmt::format("\"{}\", expected ITEM: {}", line, items));
    }
  }
  if (n < 0 || frame.box_place.empty())
    throw InputError(dump.place(at), "the frame does not say its number of rows and its box");
  frame.table = CsvTable(dump.path, tokenize(dump.lines[at].substr(6 + items.size())));
  for (std::size_t row = at + 1; row <= at + static_cast<std::size_t>(n); ++row) {
    const std::string what = fmt::format("row {} of {}", row - at, n);
    if (dump.line(row, what).starts_with("ITEM:"))
      throw InputError(dump.place(row), fmt::format("\"{}\", expected {}", dump.lines[row], what));
    frame.table.add_row(static_cast<int>(row + 1), tokenize(dump.lines[row]));
  }
  return frame;
}

Frame read_grain_frame(const std::string& path, const ImportOptions& options,
                       std::vector<std::string>& remarks) {
  const DumpLines dump(path);
  const std::vector<std::size_t> starts = frame_starts(dump);
  const int n = static_cast<int>(starts.size());
  const int index = options.index.value_or(n - 1);
  if (index >= n) throw InputError(path, fmt::format("index = {}, but it holds frames 0 to {}", index, n - 1));
  Frame frame = read_frame(dump, starts[static_cast<std::size_t>(index)], "ATOMS");
  remarks.push_back(fmt::format("frame {} of 0 to {}, time step {}", index, n - 1, frame.timestep));
  return frame;
}

/// The frame of a `dump local` with a given time step, or without one any; of several the last.
CsvTable read_contact_frame(const std::string& path, std::optional<std::int64_t> timestep) {
  const DumpLines dump(path);
  const std::vector<std::size_t> starts = frame_starts(dump);
  std::vector<std::int64_t> timesteps;
  for (auto start = starts.rbegin(); start != starts.rend(); ++start) {
    timesteps.push_back(dump.integer(*start + 1, "the time step"));
    if (!timestep || timesteps.back() == *timestep) return read_frame(dump, *start, "ENTRIES").table;
  }
  throw InputError(path, fmt::format("has no frame of time step {}, that of the grains; it has {}", *timestep,
                                     fmt::join(timesteps.rbegin(), timesteps.rend(), ", ")));
}

/// Names of the columns of positions: x, or what this dump has in its place. @return whether they are scaled
bool find_positions(const CsvTable& table, std::map<std::string, std::string>& names) {
  for (const char* suffix : {"", "u", "s", "su"}) {
    if (names.contains("x") || !table.has(std::string("x") + suffix)) continue;
    for (const std::string axis : {"x", "y", "z"})
      if (table.has(axis + suffix) && !names.contains(axis)) names[axis] = axis + suffix;
    return suffix[0] == 's';
  }
  return false;
}

std::vector<ListedGrain> grains_of(const Frame& frame, const ImportOptions& options) {
  std::map<std::string, std::string> names = options.columns;
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

/// Lattice vectors of the frame's box.
std::vector<std::vector<double>> cell_of(const Frame& frame, int dimension) {
  const std::vector<std::string> flags = tokenize(frame.flags);
  for (int a = 0; a < dimension; ++a)
    if (flags[a] != "pp")
      throw InputError(frame.box_place,
                       fmt::format("the box is not periodic (\"{}\", expected pp in every direction): packings "
                                   "between walls are not read; --cell puts grains that touch no wall into a "
                                   "periodic cell",
                                   frame.flags));
  return frame.box.lattice(frame.box_place, dimension);
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
  check_grain_columns("--columns", options.columns);
  ListedPacking listed;
  listed.place = path;
  listed.law = required_law(path, options);
  listed.units = options.units;
  listed.drop_tensile = options.drop_tensile;
  std::vector<std::string> remarks;
  Frame frame = read_grain_frame(path, options, remarks);
  listed.grains = grains_of(frame, options);
  frame.table = {};  // which takes more room than all that follows from it
  const int dimension = dimension_of(listed.grains, options);
  listed.cell_place = options.cell.empty() ? frame.box_place : "--cell";
  listed.cell = options.cell.empty() ? cell_of(frame, dimension) : options.cell;
  listed.contacts = read_contact_file(options, dimension, frame.timestep);
  Imported imported = assemble(listed);
  imported.remarks = std::move(remarks);
  return imported;
}

}  // namespace floc
