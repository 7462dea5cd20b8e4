#include "process/run_states.h"

#include <fmt/format.h>

#include <filesystem>

#include "floc/base/error.h"
#include "floc/run_directory/one_run.h"
#include "floc/tables/fit_tables.h"

namespace floc {
namespace fs = std::filesystem;

std::string table_of_run(const std::string& directory) {
  if (!fs::is_directory(directory))
    throw InputError(directory, "this is not a directory: expected a directory that floc run wrote");
  const std::vector<std::string> tables = tables_of(directory);
  if (tables.size() != 1 || fs::path(tables.front()).parent_path() != fs::path(directory + "/").parent_path())
    throw InputError(
        directory,
        fmt::format(
            "this directory holds {} samples of a scene: expected the directory of one sample, such as {}",
            tables.size(), fs::path(tables.front()).parent_path().string()));
  return tables.front();
}

std::vector<std::string> states_of_run(const std::string& directory) {
  require_one_run(directory);
  std::vector<std::string> files;
  for (const auto& [step, file] : numbered_states(directory)) files.push_back(file);
  if (files.empty())
    throw InputError(directory,
                     "this directory holds no state-0000.h5: expected state files or a directory that floc run "
                     "wrote");
  return files;
}

std::vector<std::string> states_of_inputs(const std::vector<std::string>& inputs,
                                          const std::vector<int>& steps) {
  std::vector<std::string> files;
  bool has_directory = false;
  for (const std::string& input : inputs) {
    if (input == "-" || !fs::is_directory(input)) {
      files.push_back(input);
      continue;
    }
    has_directory = true;
    const std::vector<std::string> all = states_of_run(input);
    if (steps.empty()) files.insert(files.end(), all.begin(), all.end());
    for (const int step : steps) files.push_back(state_file(input, step));
  }
  if (!steps.empty() && !has_directory)
    throw InputError("--steps",
                     "this option chooses states of a directory that floc run wrote, but only files are given");
  return files;
}

std::vector<std::string> drawn_states(const std::vector<std::string>& inputs, const std::vector<int>& steps,
                                      int count) {
  if (!steps.empty()) return states_of_inputs(inputs, steps);
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    const bool is_directory = input != "-" && fs::is_directory(input);
    const auto those =
        states_of_inputs({input}, is_directory ? spread_steps(input, count) : std::vector<int>{});
    files.insert(files.end(), those.begin(), those.end());
  }
  return files;
}

std::vector<int> spread_steps(const std::string& directory, int count) {
  const int last = static_cast<int>(states_of_run(directory).size()) - 1;
  std::vector<int> steps;
  for (int k = 0; k < count; ++k)
    if (const int step = count == 1 ? last : last * k / (count - 1); steps.empty() || step != steps.back())
      steps.push_back(step);
  return steps;
}

}  // namespace floc
