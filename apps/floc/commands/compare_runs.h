#pragma once

#include <string>

#include "process/printing.h"

namespace floc {

/// Compares two directories of floc run step by step: state files byte by byte, rows of path.csv value by value,
/// but for `seconds`, which no run has twice. Prints a row a step on stdout and what it came to on stderr.
/// @return kDone if they are equal, kVerificationFailed if they differ
/// @throws InputError if one is no directory of a run
int compare_runs(const std::string& before, const std::string& after, const Printing& printing);

}  // namespace floc
