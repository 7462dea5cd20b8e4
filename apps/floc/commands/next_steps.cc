#include "commands/next_steps.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/tables/consolidation_fits.h"

namespace floc {
namespace {

/// Returns whether `floc fit consolidation` can fit the consolidation law to each of the given tables path.csv. If
/// there are several tables, it must also be possible to fit the law to their mean.
bool can_be_fitted(const std::vector<std::string>& tables) {
  try {
    const ConsolidationFitOptions asked;
    const ConsolidationOptions options = consolidation_options(asked);
    std::vector<ConsolidationSample> samples;
    for (const std::string& table : tables)
      samples.push_back(consolidation_sample(read_path(table, {}), asked));
    samples = with_pooled(std::move(samples), options.hold_P0);
    return std::all_of(samples.begin(), samples.end(), [&](const ConsolidationSample& sample) {
      return fit_of(sample, asked, options).found();
    });
  } catch (const InputError&) {  // the pressure does not rise in one of the tables
    return false;
  }
}

/// Returns whether a table path.csv contains a state that was recorded before it had reached equilibrium, because the
/// run was stopped. `floc verify` and `floc moduli` would reject this state.
bool has_stopped(const std::string& table) {
  const CsvTable rows = CsvTable::read(table);
  const int ending = rows.column("ending");
  for (int r = 0; r < rows.n_rows(); ++r)
    if (rows.text(r, ending) == "stopped") return true;
  return false;
}

/// Returns whether a table path.csv belongs to a run of rigid grains, whose states have no elastic moduli.
bool is_rigid(const std::string& table) {
  return CsvTable::read(table).has("force_freedom");
}

/// Returns a text as one word of a shell command. Quotation marks and escapes are added if the text needs them.
std::string one_word(const std::string& text) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-=:,@%";
  if (text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string next_steps(const std::string& directory, const std::string& files) {
  const std::vector<std::string> tables = tables_of(directory);
  const std::string word = one_word(directory);
  const bool balanced = std::none_of(tables.begin(), tables.end(), has_stopped);
  const bool rigid = std::any_of(tables.begin(), tables.end(), is_rigid);
  const char* first = !balanced ? "network" : rigid ? "forces" : "moduli";
  std::string text = fmt::format("  floc {} {}/{}\n", first, word, files);
  if (can_be_fitted(tables)) text += fmt::format("  floc fit consolidation {}\n", word);
  if (balanced) text += fmt::format("  floc verify {}/{}\n", word, files);
  return text;
}

}  // namespace floc
