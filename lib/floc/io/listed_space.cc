#include "floc/io/listed_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

const char* const kOption = "--walls";

/// Reads the position of a wall. Returns nothing if `text` is empty: the end of the axis is then open.
std::optional<double> position_of(const std::string& entry, std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return std::nullopt;
  if (const auto value = parse_number<double>(text)) return *value;
  throw InputError(
      kOption,
      fmt::format("\"{}\" contains \"{}\", expected a finite number: the position of a wall", entry, text));
}

/// Returns the lower (side -1) or upper (side 1) face of the box across an axis.
double face_of(const std::string& entry, const ListedSpace& space, int axis, int side) {
  if (space.cell.empty())
    throw InputError(
        kOption,
        fmt::format(
            "\"{}\" denotes a face of the box, but no box is given: give positions, such as {}=0:10, or --cell",
            entry, "xyz"[axis]));
  const auto a = static_cast<std::size_t>(axis);
  return space.origin[axis] + (side > 0 ? space.cell[a][a] : 0.0);
}

ListedEnds ends_of(const std::string& entry, const ListedSpace& space, int n_axes) {
  const std::size_t axis = entry.empty() ? std::string::npos : std::string("xyz").find(entry[0]);
  // This comparison finds three faults: an empty entry, a first letter other than x, y and z, and z in two dimensions.
  // In the first two cases `axis` is npos, which is larger than any number of axes.
  if (axis >= static_cast<std::size_t>(n_axes))
    throw InputError(kOption,
                     fmt::format("\"{}\" does not begin with an axis of the packing: expected x{}, for "
                                 "example x, x-, x+ or x=0:10",
                                 entry, n_axes == 3 ? ", y or z" : " or y"));
  ListedEnds ends;
  ends.axis = static_cast<int>(axis);
  const std::string rest(trimmed(entry.substr(1)));
  const std::size_t colon = rest.find(':');
  // After an equals sign the colon is required, because the position in "x=5" could be that of either end.
  if (rest.starts_with('=') && colon != std::string::npos) {
    ends.low = position_of(entry, rest.substr(1, colon - 1));
    ends.high = position_of(entry, rest.substr(colon + 1));
  } else if (rest.empty() || rest == "-" || rest == "+") {
    if (rest != "+") ends.low = face_of(entry, space, ends.axis, -1);
    if (rest != "-") ends.high = face_of(entry, space, ends.axis, 1);
  } else {
    throw InputError(kOption, fmt::format("\"{}\" is not a pair of walls: expected, for example, {}, {}-, {}+ "
                                          "or {}=0:10",
                                          entry, entry[0], entry[0], entry[0], entry[0]));
  }
  // Two walls at the same position are also refused: the cell between them would have no volume.
  if (ends.low && ends.high && !(*ends.low < *ends.high))
    throw InputError(kOption,
                     fmt::format("\"{}\": the lower wall is at {}, expected a position below that of the "
                                 "upper wall, {}",
                                 entry, *ends.low, *ends.high));
  return ends;
}

/// Whether an entry of the option `--walls` describes an axis, such as "x", "x-", "x+" or "x=...".
bool has_form_of_axis(std::string_view entry) {
  return entry.size() <= 1 || (std::string_view("xyz").find(entry[0]) != std::string_view::npos &&
                               std::string_view("-+=").find(entry[1]) != std::string_view::npos);
}

}  // namespace

WallOption split_walls(const std::string& text) {
  WallOption option;
  std::istringstream in(text);
  bool first = true;
  for (std::string entry; std::getline(in, entry, ',');) {
    const std::string name(trimmed(entry));
    if (!has_form_of_axis(name) && (name.find('.') != std::string::npos || std::filesystem::exists(name))) {
      option.files.push_back(name);
    } else {
      option.axes += (first ? "" : ",") + entry;
      first = false;
    }
  }
  return option;
}

std::optional<WallSide> wall_side(const std::string& name) {
  if (name.size() != 2 || (name[1] != '-' && name[1] != '+')) return std::nullopt;
  const std::size_t axis = std::string("xyz").find(name[0]);
  if (axis == std::string::npos) return std::nullopt;
  return WallSide{static_cast<int>(axis), name[1] == '-' ? -1 : 1};
}

ListedEnds& ends_along(int axis, ListedSpace& space) {
  for (ListedEnds& ends : space.ends)
    if (ends.axis == axis) return ends;
  return space.ends.emplace_back(ListedEnds{axis, {}, {}});
}

void add_wall(const WallSide& wall, double position, ListedSpace& space) {
  ListedEnds& ends = ends_along(wall.axis, space);
  (wall.side < 0 ? ends.low : ends.high) = position;
}

void add_wall_at_face(const WallSide& wall, ListedSpace& space) {
  const auto a = static_cast<std::size_t>(wall.axis);
  add_wall(wall, space.origin[wall.axis] + (wall.side < 0 ? 0.0 : space.cell[a][a]), space);
}

std::vector<ListedEnds> parse_walls(const std::string& text, const ListedSpace& space, int n_axes) {
  std::vector<ListedEnds> all;
  std::istringstream in(text);
  for (std::string entry; std::getline(in, entry, ',');) {
    const ListedEnds ends = ends_of(std::string(trimmed(entry)), space, n_axes);
    if (std::any_of(all.begin(), all.end(), [&](const ListedEnds& e) { return e.axis == ends.axis; }))
      throw InputError(kOption,
                       fmt::format("the axis {} is given twice: expected one entry, such as {} or {}=0:10",
                                   "xyz"[ends.axis], "xyz"[ends.axis], "xyz"[ends.axis]));
    all.push_back(ends);
  }
  return all;
}

}  // namespace floc
