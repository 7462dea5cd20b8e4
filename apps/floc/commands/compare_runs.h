#pragma once

#include <string>

#include "process/printing.h"

namespace floc {

/// Compares two runs step by step: the state files byte by byte, and the rows of their tables path.csv value by value,
/// except for the wall times in the column `seconds`. Prints one row per step on stdout and a summary on stderr.
/// @param before, after  directories of the two runs
/// @return kDone if the runs are equal, kVerificationFailed if they differ
/// @throws InputError if a directory does not contain a run
int compare_runs(const std::string& before, const std::string& after, const Printing& printing);

}  // namespace floc
