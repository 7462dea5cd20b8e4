#include "floc/io/wall_script.h"

#include <fmt/format.h>

#include <algorithm>
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
};

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
      if (fix.word(3) == "gravity") walls.gravity = gravity_of(fix);
    }
    if (walls.planes.empty())
      throw InputError(path_, "the script has no wall: expected a command \"fix ID group wall/gran ...\"");
    return walls;
  }

 private:
  void take(ScriptCommand command) {
    for (std::string& word : command.words) word = substituted(word);
    const std::string& name = command.word(0);
    if (name == "variable" && command.words.size() == 4) variables_[command.word(1)] = command.word(3);
    if (name == "region") regions_[command.word(1)] = command;
    if (name == "fix") fixes_[command.word(1)] = command;
    if (name == "unfix") fixes_.erase(command.word(1));
  }

  /// If a word is ${name} or v_name, returns the value of the variable `name`, else the word itself.
  std::string substituted(const std::string& word) const {
    std::string name;
    if (word.starts_with("${") && word.ends_with("}")) name = word.substr(2, word.size() - 3);
    if (word.starts_with("v_")) name = word.substr(2);
    const auto found = variables_.find(name);
    return found == variables_.end() ? word : found->second;
  }

  double number(const ScriptCommand& command, std::size_t k, const std::string& what) const {
    if (const auto value = parse_number<double>(command.word(k))) return *value;
    refuse_command(command, fmt::format("{} is \"{}\", expected a number", what, command.word(k)));
  }

  /// Adds a wall at the position in word `k` of a command. The words NULL and INF mean that there is no wall.
  void add_plane(const ScriptCommand& command, std::size_t k, int axis, std::optional<int> side,
                 std::vector<WallPlane>& planes) const {
    const std::string& word = command.word(k);
    if (word == "NULL" || word == "INF") return;
    planes.push_back({command.place, axis,
                      number(command, k, fmt::format("the position of the wall across {}", "xyz"[axis])), side,
                      std::nullopt});
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
    const ScriptCommand& region = regions_.at(*found);
    if (region.word(2) != "block" || region.has("out"))
      refuse_command(region, fmt::format("the region {} is not a block with the grains inside", *found));
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1})
        add_plane(region, 3 + static_cast<std::size_t>(2 * axis + (side > 0)), axis, side, planes);
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
  std::map<std::string, ScriptCommand> regions_, fixes_;
};

}  // namespace

ListedWalls walls_of_script(const std::string& path) {
  return WallScript(path).walls();
}

}  // namespace floc
