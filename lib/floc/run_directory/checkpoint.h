#pragma once

#include <string>

#include "floc/loading/run.h"

namespace floc {

/// Returns the progress of a run as JSON text. Every number is written so that parse_progress() reads back exactly the
/// same value.
std::string progress_text(const RunPoint& point);

/// Reads the progress of a run from the text that progress_text() returned.
/// @param place  file that the text comes from, for messages
/// @throws InputError if the text was not written by this version of floc for a checkpoint
RunPoint parse_progress(const std::string& text, const std::string& place);

}  // namespace floc
