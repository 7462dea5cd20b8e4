#pragma once

#include <string>

#include "process/printing.h"

namespace floc {

/// Compares the directories of two runs step by step: state files byte by byte, and rows of path.csv value by value,
/// except for the wall times in the column `seconds`. Prints one row per step on stdout and a summary on stderr.
/// @param before, after  the two directories
/// @return kDone if the runs are equal, kVerificationFailed if they differ
/// @throws InputError if a directory does not contain a run
int compare_runs(const std::string& before, const std::string& after, const Printing& printing);

}  // namespace floc
