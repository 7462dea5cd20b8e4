#include "floc/io/wall_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/listed_columns.h"

namespace floc {
namespace {

/// One command of a script. A command may extend over several lines; each of its lines except the last ends with "&".
struct ScriptCommand {
  std::string place;
  std::vector<std::string> words;

  const std::string& word(std::size_t k) const {
    static const std::string kNone;
    return k < words.size() ? words[k] : kNone;
  }
  /// Returns the index of a word of the command. If the command does not contain the word, returns the number of its
  /// words.
  std::size_t find(const std::string& word) const {
    return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
  }
  bool has(const std::string& word) const { return find(word) < words.size(); }
  /// Whether a command of the form "region ID style ..." or "lattice style scale ..." has a keyword after its first
  /// three words.
  bool has_option(const std::string& word) const {
    return words.size() > 3 && std::find(words.begin() + 3, words.end(), word) != words.end();
  }
};

/// Settings of a script that give the unit of lengths in regions.
struct LatticeSettings {
  ScriptCommand lattice;  ///< last command `lattice`; it has no words if the script has no such command
  bool has_lj_units = true;
  int dimension = 3;
};

/// The command that defines a region, and the settings at this command.
struct Region {
  ScriptCommand command;
  LatticeSettings settings;
};

/// Unit cell of a style of the command `lattice`: number of points, and sides in lattice constants.
struct UnitCell {
  const char* style;
  double n_points;
  std::array<double, 3> sides;
};
constexpr double kRoot3 = 1.7320508075688772, kRoot83 = 1.632993161855452;  // sqrt(3), sqrt(8/3)
constexpr std::array<UnitCell, 8> kUnitCells = {{{"sc", 1.0, {1.0, 1.0, 1.0}},
                                                 {"bcc", 2.0, {1.0, 1.0, 1.0}},
                                                 {"fcc", 4.0, {1.0, 1.0, 1.0}},
                                                 {"hcp", 4.0, {1.0, kRoot3, kRoot83}},
                                                 {"diamond", 8.0, {1.0, 1.0, 1.0}},
                                                 {"sq", 1.0, {1.0, 1.0, 1.0}},
                                                 {"sq2", 2.0, {1.0, 1.0, 1.0}},
                                                 {"hex", 2.0, {1.0, kRoot3, 1.0}}}};

[[noreturn]] void refuse_command(const ScriptCommand& command, const std::string& fault) {
  throw InputError(command.place, fault +
                                      "; to give the positions of walls without the script, write them after "
                                      "--walls, for example --walls z=0:");
}

/// Commands of a script that concern walls. The names of variables are replaced by their values.
class WallScript {
 public:
  explicit WallScript(std::string path) : path_(std::move(path)) {
    std::istringstream in(read_text(path_));
    ScriptCommand command;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      line.erase(std::min(line.find('#'), line.size()));
      if (command.words.empty()) command.place = fmt::format("{}:{}", path_, number);
      std::vector<std::string> words = tokenize(line);
      const bool goes_on = !words.empty() && words.back() == "&";
      if (goes_on) words.pop_back();
      command.words.insert(command.words.end(), words.begin(), words.end());
      if (goes_on) continue;
      take(std::move(command));
      command = {};
    }
    take(std::move(command));
  }

  ListedWalls walls() const {
    ListedWalls walls;
    for (const auto& [id, fix] : fixes_) {
      if (fix.word(3).starts_with("wall/gran")) add_walls(fix, walls.planes);
      if (fix.word(3) == "gravity")  // LAMMPS adds the accelerations of several commands
        walls.gravity = walls.gravity.value_or(Eigen::Vector3d::Zero()) + gravity_of(fix);
      if (fix.word(3).starts_with("wall/gran") || fix.word(3) == "gravity")
        add_doubt_of_group(fix, walls.doubts);
    }
    walls.doubts.insert(walls.doubts.end(), doubts_.begin(), doubts_.end());
    if (walls.planes.empty())
      throw InputError(path_, fmt::format("the script has no wall: expected a command \"fix ID group wall/gran "
                                          "...\"{}{}",
                                          doubts_.empty() ? "" : "; ", fmt::join(doubts_, "; ")));
    return walls;
  }

 private:
  void take(ScriptCommand command) {
    for (std::string& word : command.words) word = substituted(word);
    const std::string& name = command.word(0);
    if (name == "variable") take_variable(command);
    if (name == "next")  // the variables get other values, which are not followed
      for (std::size_t k = 1; k < command.words.size(); ++k) variables_.erase(command.word(k));
    if (name == "units") settings_.has_lj_units = command.word(1) == "lj";
    if (name == "dimension") settings_.dimension = command.word(1) == "2" ? 2 : 3;
    if (name == "lattice") settings_.lattice = command;
    if (name == "region") regions_[command.word(1)] = {command, settings_};
    if (name == "fix") fixes_[command.word(1)] = command;
    if (name == "unfix") fixes_.erase(command.word(1));
    if (name == "clear") {  // variables keep their values
      regions_.clear();
      fixes_.clear();
      settings_ = {};
    }
    if (name == "if") take_condition(command);
  }

  /// Stores the value of a variable. A variable of the style index that exists already keeps its value.
  void take_variable(const ScriptCommand& command) {
    const std::string &name = command.word(1), &style = command.word(2);
    const bool is_index = style == "index";
    if (style == "delete") variables_.erase(name);
    if (is_index && variables_.contains(name)) return;
    if (command.words.size() == 4 || (is_index && command.words.size() > 4)) variables_[name] = command.word(3);
  }

  /// Records that a command `if`, which is not followed, may add or remove a wall.
  void take_condition(const ScriptCommand& command) {
    const std::string text = fmt::format("{}", fmt::join(command.words, " "));
    if (text.find("wall/gran") != std::string::npos || text.find("unfix ") != std::string::npos)
      doubts_.push_back(
          fmt::format("{}: the command if is not followed, but it may add or remove a wall: check the walls "
                      "that were found, "
                      "or write their positions after --walls",
                      command.place));
  }

  /// If a word is ${name} or v_name, returns the value of the variable `name`, else the word itself.
  std::string substituted(const std::string& word) const {
    std::string name;
    if (word.starts_with("${") && word.ends_with("}")) name = word.substr(2, word.size() - 3);
    if (word.starts_with("v_")) name = word.substr(2);
    const auto found = variables_.find(name);
    return found == variables_.end() ? word : found->second;
  }

  /// Says that a command `fix` acts on a group of grains, because floc applies it to all grains.
  static void add_doubt_of_group(const ScriptCommand& fix, std::vector<std::string>& doubts) {
    if (fix.word(2) == "all") return;
    doubts.push_back(fmt::format(
        "{}: the fix {} of style {} acts on the group {}, expected all: floc applies it to all grains, so "
        "that the packing is another one if a grain is not in this group",
        fix.place, fix.word(1), fix.word(3), fix.word(2)));
  }

  double number(const ScriptCommand& command, std::size_t k, const std::string& what) const {
    if (const auto value = parse_number<double>(command.word(k))) return *value;
    refuse_command(command, fmt::format("{} is \"{}\", expected a number", what, command.word(k)));
  }

  /// Adds a wall at the position in word `k` of a command. The words NULL and INF mean that there is no wall.
  /// @param unit  unit of the position (length)
  void add_plane(const ScriptCommand& command, std::size_t k, int axis, std::optional<int> side,
                 std::vector<WallPlane>& planes, double unit = 1.0) const {
    const std::string& word = command.word(k);
    if (word == "NULL" || word == "INF") return;
    planes.push_back({command.place, axis,
                      unit * number(command, k, fmt::format("the position of the wall across {}", "xyz"[axis])),
                      side, std::nullopt});
  }

  void add_walls(const ScriptCommand& fix, std::vector<WallPlane>& planes) const {
    if (fix.has("wiggle")) refuse_command(fix, "the wall moves (wiggle)");
    if (fix.word(3).starts_with("wall/gran/region")) return add_region(fix, planes);
    if (fix.has("meshes")) return add_meshes(fix, planes);
    const bool one = fix.has("primitive");
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t k = fix.find(std::string(1, "xyz"[axis]) + "plane");
      if (k >= fix.words.size()) continue;
      add_plane(fix, k + 1, axis, one ? std::nullopt : std::optional(-1), planes);
      if (!one) add_plane(fix, k + 2, axis, 1, planes);
      return;
    }
    refuse_command(fix, "the wall is not a plane: expected xplane, yplane or zplane");
  }

  void add_region(const ScriptCommand& fix, std::vector<WallPlane>& planes) const {
    const auto found = std::find_if(fix.words.begin() + 4, fix.words.end(),
                                    [&](const std::string& word) { return regions_.contains(word); });
    if (found == fix.words.end())
      refuse_command(fix, "the script does not define the region of this wall before this command");
    const ScriptCommand& region = regions_.at(*found).command;
    if (region.word(2) != "block" || region.has_option("out"))
      refuse_command(region, fmt::format("the region {} is not a block with the grains inside", *found));
    for (const char* motion : {"move", "rotate"})
      if (region.has_option(motion)) refuse_command(region, fmt::format("the wall moves ({})", motion));
    const std::array<bool, 6> is_open = open_faces(region);
    const std::array<double, 3> unit = lattice_spacings(regions_.at(*found));
    for (std::size_t face = 0; face < is_open.size(); ++face)
      if (!is_open[face])
        add_plane(region, 3 + face, static_cast<int>(face / 2), face % 2 == 0 ? -1 : 1, planes, unit[face / 2]);
  }

  /// Returns for each face of a block, in the order xlo, xhi, ylo, yhi, zlo, zhi, whether it is open.
  std::array<bool, 6> open_faces(const ScriptCommand& region) const {
    std::array<bool, 6> is_open{};
    for (std::size_t k = 3; k < region.words.size(); ++k) {
      if (region.word(k) != "open") continue;
      const auto face = parse_number<int>(region.word(k + 1));
      if (!face || *face < 1 || *face > 6)
        refuse_command(
            region, fmt::format("the open face is \"{}\", expected a number from 1 to 6", region.word(k + 1)));
      is_open[static_cast<std::size_t>(*face - 1)] = true;
    }
    return is_open;
  }

  /// Returns the units of the lengths in a region along x, y and z. Unless the region has "units box", its lengths are
  /// in spacings of the lattice, which are 1 without a command `lattice`.
  std::array<double, 3> lattice_spacings(const Region& region) const {
    const ScriptCommand &command = region.command, &lattice = region.settings.lattice;
    if (command.word(command.find("units") + 1) == "box" || lattice.words.empty()) return {1.0, 1.0, 1.0};
    const double scale = number(lattice, 2, "the scale of the lattice");
    if (lattice.word(1) == "none") return {scale, scale, scale};
    const auto cell = std::find_if(kUnitCells.begin(), kUnitCells.end(),
                                   [&](const UnitCell& c) { return c.style == lattice.word(1); });
    if (cell == kUnitCells.end() || lattice.has_option("orient") || lattice.has_option("spacing"))
      refuse_command(lattice, fmt::format("the lengths of the region {} are in spacings of this lattice, which "
                                          "floc does not read: expected a lattice none, sc, bcc, fcc, hcp, "
                                          "diamond, sq, sq2 or hex without the keywords orient and spacing, or "
                                          "the keyword \"units box\" in the region",
                                          command.word(1)));
    // In units "lj" the scale is the number of points per volume, or per area in two dimensions.
    const double volume = cell->sides[0] * cell->sides[1] * cell->sides[2];
    const double constant = region.settings.has_lj_units
                                ? std::pow(cell->n_points / (volume * scale), 1.0 / region.settings.dimension)
                                : scale;
    return {constant * cell->sides[0], constant * cell->sides[1], constant * cell->sides[2]};
  }

  void add_meshes(const ScriptCommand& fix, std::vector<WallPlane>& planes) const {
    for (std::size_t k = fix.find("meshes") + 1; k < fix.words.size(); ++k) {
      const auto found = fixes_.find(fix.word(k));
      if (found == fixes_.end() || !found->second.word(3).starts_with("mesh/surface")) {
        if (k == fix.find("meshes") + 1)
          refuse_command(fix, fmt::format("the script has no fix mesh/surface with the name {}", fix.word(k)));
        return;  // the list of meshes has ended
      }
      add_mesh(found->second, planes);
    }
  }

  void add_mesh(const ScriptCommand& mesh, std::vector<WallPlane>& planes) const {
    for (const auto& [id, fix] : fixes_)
      if (fix.word(3).starts_with("move/mesh") && fix.word(fix.find("mesh") + 1) == mesh.word(1))
        refuse_command(
            fix,
            fmt::format(
                "the mesh {} moves: write it to an STL file (dump mesh/stl), and give this file after --walls",
                mesh.word(1)));
    if (mesh.word(3).ends_with("servo"))
      refuse_command(
          mesh,
          fmt::format(
              "the mesh {} moves: write it to an STL file (dump mesh/stl), and give this file after --walls",
              mesh.word(1)));
    if (mesh.has("rotate")) refuse_command(mesh, "the script rotates the mesh (rotate)");
    const std::size_t file = mesh.find("file") + 1;
    if (file >= mesh.words.size()) refuse_command(mesh, "the mesh has no file");
    const std::size_t scale = mesh.find("scale") + 1, move = mesh.find("move") + 1;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    if (mesh.has("move"))
      for (std::size_t a = 0; a < 3; ++a)
        shift[static_cast<Eigen::Index>(a)] = number(mesh, move + a, "a component of move");
    // The names of files are relative to the folder in which the other program ran. floc assumes that this is the
    // folder of the script.
    const std::filesystem::path beside = std::filesystem::path(path_).parent_path() / mesh.word(file);
    const std::vector<WallPlane> of_mesh =
        planes_of_mesh(beside.string(), mesh.has("scale") ? number(mesh, scale, "scale") : 1.0, shift);
    planes.insert(planes.end(), of_mesh.begin(), of_mesh.end());
  }

  Eigen::Vector3d gravity_of(const ScriptCommand& fix) const {
    if (fix.word(5) != "vector")
      throw InputError(fix.place, fmt::format("the style of gravity is \"{}\", expected vector; to give the "
                                              "components of gravity without the script, use --gravity",
                                              fix.word(5)));
    Eigen::Vector3d along;
    for (std::size_t a = 0; a < 3; ++a)
      along[static_cast<Eigen::Index>(a)] = number(fix, 6 + a, "a component of gravity");
    if (along.isZero(0.0))
      throw InputError(fix.place,
                       "the direction of gravity is (0, 0, 0), expected the direction in which grains fall");
    return number(fix, 4, "the magnitude of gravity") * along.normalized();
  }

  std::string path_;
  std::map<std::string, std::string> variables_;
  LatticeSettings settings_;
  std::map<std::string, Region> regions_;
  std::map<std::string, ScriptCommand> fixes_;
  std::vector<std::string> doubts_;  ///< sentences for the user, see ListedWalls
};

}  // namespace

ListedWalls walls_of_script(const std::string& path) {
  return WallScript(path).walls();
}

}  // namespace floc
