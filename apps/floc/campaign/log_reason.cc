#include "campaign/log_reason.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>
#include <vector>

#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "process/command.h"

namespace floc {
namespace {

/// Last line of every message about a command line that is not valid.
constexpr std::string_view kHint = "Run with --help for more information.";

/// Returns the lines of a log that are not blank, without the hint.
std::vector<std::string> messages_in(const std::string& log) {
  std::istringstream lines(read_file(log));
  std::vector<std::string> messages;
  for (std::string line; std::getline(lines, line);) {
    // Messages of progress end in \r, so that the next message overwrites them on a terminal. Only the text after the
    // last \r of a line is used.
    line.erase(0, line.find_last_of('\r') + 1);
    if (!trimmed(line).empty() && trimmed(line) != kHint) messages.emplace_back(trimmed(line));
  }
  return messages;
}

}  // namespace

std::string reason_in_log(const std::string& log) {
  const std::vector<std::string> messages = messages_in(log);
  return messages.empty() ? "" : messages.back();
}

std::string reason_of_no_fit(const std::string& log) {
  // "the law cannot be fitted: ...", "no modulus can be fitted: ...", "no parameters can be computed: ..."
  for (const std::string& message : messages_in(log))
    for (const char* words : {" be fitted: ", " be computed: "})
      if (message.find(words) != std::string::npos) return message;
  return reason_in_log(log);
}

std::string reason_of_failure(int code, const std::string& log) {
  constexpr int kSignals = 128;
  if (code > kSignals && code != kInterrupted) return fmt::format("ended by signal {}", code - kSignals);
  return reason_in_log(log);
}

}  // namespace floc
