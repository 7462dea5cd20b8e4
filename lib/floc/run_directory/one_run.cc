#include "floc/run_directory/one_run.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/io/state_file.h"
#include "floc/scene/scene_changes.h"

namespace floc {
namespace fs = std::filesystem;
namespace {

/// Largest size (bytes) of a state file that is opened to check whether it belongs to a run.
constexpr std::uintmax_t kLargestOpened = 16 << 20;

/// Origin of a state: the dimension, seed and scene of its run, and the number of the state in the run.
struct Origin {
  int dimension;
  std::uint64_t seed;
  std::string scene;
  int step;
};

/// Returns the origin of the state in a file, or std::nullopt if the file is too large to be opened for a check.
std::optional<Origin> origin_of(const std::string& file) {
  if (fs::file_size(file) > kLargestOpened) return std::nullopt;
  return std::visit(
      []<int Dim>(const State<Dim>& s) {
        return Origin{Dim, s.provenance.seed, s.scene, s.path.step};
      },
      read_state(file));
}

void require_same_scene(const Origin& found, const Origin& expected, const std::string& file,
                        const std::string& reference) {
  // The scene of a state may differ if the run was resumed with a longer load path.
  const bool same = found.scene == expected.scene || (!found.scene.empty() && !expected.scene.empty() &&
                                                      continues_path(found.scene, expected.scene));
  if (found.dimension != expected.dimension || !same)
    throw InputError(
        file, fmt::format("this state was made from a different scene than {}: expected the states of one run",
                          reference));
}

/// Checks that the table path.csv of a run is complete. The last line of an incomplete table has no newline character.
void require_whole_table(const std::string& directory) {
  const std::string table = (fs::path(directory) / "path.csv").string();
  if (!fs::exists(table)) return;
  const std::string text = read_file(table);
  if (!text.empty() && text.back() != '\n')
    throw InputError(
        table, "the last row of this table is incomplete; floc run --resume restores it from the state file");
}

}  // namespace

std::string state_file(const std::string& directory, int step) {
  return (fs::path(directory) / fmt::format("state-{:04d}.h5", step)).string();
}

std::map<int, std::string> numbered_states(const std::string& directory) {
  std::map<int, std::string> states;
  if (!fs::is_directory(directory)) return states;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("state-") || !name.ends_with(".h5")) continue;
    const auto step = parse_number<int>(std::string_view(name).substr(6, name.size() - 9));
    if (step && entry.path() == state_file(directory, *step)) states[*step] = entry.path().string();
  }
  return states;
}

void require_one_run(const std::string& directory) {
  const std::map<int, std::string> states = numbered_states(directory);
  std::optional<Origin> first;
  std::string first_file;
  int expected = 0;
  for (const auto& [step, file] : states) {
    if (step != expected)
      throw InputError(
          state_file(directory, expected),
          fmt::format(
              "this state is missing, although {} exists: expected all states of a run, numbered from 0",
              fs::path(file).filename().string()));
    ++expected;
    const std::optional<Origin> origin = origin_of(file);
    if (!origin) continue;
    // This check finds a state file that was renamed or copied within the directory of its run.
    if (origin->step != step)
      throw InputError(file,
                       fmt::format("this file contains state {} of its run, but its name is that of state {}",
                                   origin->step, step));
    if (!first) {
      first = origin;
      first_file = file;
    }
    if (origin->dimension != first->dimension)
      throw InputError(
          file,
          fmt::format("this state has another dimension than the {}D state {}: expected the states of one run",
                      first->dimension, first_file));
    require_same_scene(*origin, *first, file, "the states before it in the directory");
    if (origin->seed != first->seed)
      throw InputError(file, fmt::format("this state was made with seed {}, but the states before it with seed "
                                         "{}: expected the states of one run",
                                         origin->seed, first->seed));
  }
}

void require_one_ensemble(const std::vector<std::string>& directories) {
  std::optional<Origin> first;
  for (const std::string& directory : directories) {
    require_one_run(directory);
    require_whole_table(directory);
    const std::string file = state_file(directory, 0);
    const std::optional<Origin> origin = fs::exists(file) ? origin_of(file) : std::nullopt;
    if (!origin) continue;
    if (!first) first = origin;
    require_same_scene(*origin, *first, file, "the samples before it in the ensemble");
  }
}

}  // namespace floc
