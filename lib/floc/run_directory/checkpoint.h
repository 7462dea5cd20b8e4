#pragma once

#include <string>

#include "floc/loading/run.h"

namespace floc {

/// A run's point as text (JSON; numbers round-trip), and back.
std::string progress_text(const RunPoint& point);

/// @param place  file the text came from, for messages
/// @throws InputError if the text is not that of a checkpoint
RunPoint parse_progress(const std::string& text, const std::string& place);

}  // namespace floc
