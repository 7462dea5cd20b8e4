#pragma once

#include <string>

#include "process/printing.h"

namespace floc {

/// Compares two directories of floc run step by step: state files byte by byte, and rows of path.csv value by value,
/// except for the wall times in the column `seconds`. Prints one row per step on stdout and a summary on stderr.
/// @return kDone if they are equal, kVerificationFailed if they differ
/// @throws InputError if one is no directory of a run
int compare_runs(const std::string& before, const std::string& after, const Printing& printing);

}  // namespace floc
