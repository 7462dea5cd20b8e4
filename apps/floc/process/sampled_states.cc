#include "process/sampled_states.h"

#include <filesystem>
#include <map>

#include "floc/run_directory/run_directory.h"
#include "process/run_states.h"

namespace floc {

namespace fs = std::filesystem;

std::vector<std::string> states_of_directory(const std::string& directory) {
  if (fs::exists(state_file(directory, 0))) return states_of_run(directory);
  // The key is the length and the text of a name, so that seed-2 comes before seed-10.
  std::map<std::pair<std::size_t, std::string>, fs::path> samples;
  for (const auto& entry : fs::directory_iterator(directory))
    if (const std::string name = entry.path().filename(); name.starts_with("seed-") && entry.is_directory())
      samples[{name.size(), name}] = entry.path();
  if (samples.empty()) return states_of_run(directory);  // throws if there are no states
  std::vector<std::string> files;
  for (const auto& [name, sample] : samples) {
    const std::vector<std::string> of_sample = states_of_run(sample);
    files.insert(files.end(), of_sample.begin(), of_sample.end());
  }
  return files;
}

}  // namespace floc
