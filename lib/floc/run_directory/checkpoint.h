#pragma once

#include <string>

#include "floc/loading/run.h"

namespace floc {

/// Returns the point that a run has reached (step, time and so on) as JSON text for a checkpoint. parse_progress()
/// restores every number exactly.
std::string progress_text(const RunPoint& point);

/// Reads the point that a run has reached from the text that progress_text() returned.
/// @param place  name of the file that contains the text, for messages
/// @throws InputError if the text was not written by this version of floc for a checkpoint
RunPoint parse_progress(const std::string& text, const std::string& place);

}  // namespace floc
