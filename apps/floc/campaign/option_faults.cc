#include "campaign/option_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "campaign/log_reason.h"
#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "process/child_process.h"
#include "process/command.h"
#include "process/scratch_directory.h"

namespace floc {
namespace {

/// Name of a file that cannot exist, because /dev/null is not a directory.
constexpr const char* kNoFile = "/dev/null/state-0000.h5";

/// Returns the reason for which a floc command refuses its options; empty if it accepts them.
/// @param words  words of the command, with kNoFile as the name of the file to read
std::string refusal_of(const std::vector<std::string>& words) {
  const ScratchDirectory scratch;  // options such as -o FILE may write files there
  const std::string log = scratch.path() + "/log";
  const int code = wait_for(start_floc(words, {scratch.path(), "/dev/null", log, false}));
  // A command that accepts its options ends with an error, because its file does not exist.
  if (code == kDone) return "the command prints its help, and no table";
  constexpr std::string_view kProgram = "floc: ";
  // Some values of options are checked by the command after its command line is parsed. Its message then begins with
  // the name of the option; otherwise, it begins with kNoFile.
  const std::string all = read_file(log);
  const bool names_option = all.starts_with(std::string(kProgram) + "--");
  if (code != kUsage && !names_option) return "";
  std::string reason = names_option ? all.substr(0, all.find('\n')) : reason_in_log(log);
  if (reason.starts_with(kProgram)) reason.erase(0, kProgram.size());
  return reason;
}

/// Returns the words of a text, which blanks separate.
std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

std::string message_about(const std::string& place, const std::vector<std::string>& options,
                          const std::string& command, const std::string& refusal) {
  return fmt::format("{}: options = [\"{}\"]: floc {} does not accept these options: {}", place,
                     fmt::join(options, "\", \""), command, refusal);
}

}  // namespace

std::vector<std::string> option_faults(const Campaign& campaign) {
  std::vector<std::string> faults;
  for (const Collection& one : campaign.collections) {
    if (one.options.empty()) continue;
    std::vector<std::string> words = {one.table, kNoFile};
    if (one.table == "compare") words.emplace_back(kNoFile);
    // The Snakefile has the command of a collection as one text, so that an option with blanks is several words.
    for (const std::string& option : one.options) append(words, words_in(option));
    append(words, {"--format", "csv"});
    if (const std::string refusal = refusal_of(words); !refusal.empty())
      faults.push_back(message_about(one.place, one.options, one.table, refusal));
  }
  for (const CampaignFit& fit : campaign.fits) {
    if (fit.options.empty()) continue;
    std::vector<std::string> words = {"fit", fit.law};
    append(words, fit.options);
    append(words, {"--format", "csv", kNoFile});
    if (const std::string refusal = refusal_of(words); !refusal.empty())
      faults.push_back(message_about(fit.place, fit.options, "fit " + fit.law, refusal));
  }
  return faults;
}

}  // namespace floc
