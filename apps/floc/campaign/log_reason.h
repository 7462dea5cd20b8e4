#pragma once

#include <string>

namespace floc {

/// Returns the message with which a floc command ended: the last line of its log that is not blank. The hint
/// "Run with --help for more information." is left out, because the reason stands on the line before it.
/// @param log  name of the file that received the stderr of the command
std::string reason_in_log(const std::string& log);

/// Returns why a floc command failed: the signal that ended it, or the message with which it ended.
/// @param code  exit code of the command, as exit_code_of() returns it
std::string reason_of_failure(int code, const std::string& log);

/// Returns why floc fit has no result for some sample: the first line of its log about a law that cannot be fitted, or
/// otherwise the message with which it ended.
std::string reason_of_no_fit(const std::string& log);

}  // namespace floc
