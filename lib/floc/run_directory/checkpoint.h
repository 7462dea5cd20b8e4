#pragma once

#include <string>

#include "floc/loading/run.h"

namespace floc {

/// Returns the progress of a run as text (JSON; numbers round-trip), which parse_progress() reads.
std::string progress_text(const RunPoint& point);

/// Reads the progress of a run. @param place  file that the text comes from, for messages
/// @throws InputError if the text is not that of a checkpoint
RunPoint parse_progress(const std::string& text, const std::string& place);

}  // namespace floc
