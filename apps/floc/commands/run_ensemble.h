#pragma once

#include <string>
#include <vector>

#include "floc/base/seed_range.h"
#include "floc/run_directory/directory_lock.h"

namespace floc {

/// Parses a range of seeds "A..B".
/// @throws InputError if A or B is not a whole number, if A > B, or if the range contains more than a million seeds
SeedRange parse_seeds(const std::string& text);

/// Runs an ensemble with one sample per seed, each in its own process. The sample with the seed N has the directory
/// DIR/seed-N and the log file DIR/seed-N.log, where DIR is the directory of the ensemble. The signals SIGINT and
/// SIGTERM are passed on to the processes of the samples, so that every sample writes its checkpoint.
///
/// @param claim      lock of the directory DIR; after DIR has been renamed or replaced, no more samples are started
/// @param directory  path of DIR
/// @param jobs       largest number of samples that run at the same time
/// @param arguments  arguments of `floc run` that all samples share, without directory and seed
/// @param append     whether messages are appended to existing log files; otherwise these files are replaced
/// @return the worst of the exit codes of the samples
/// @throws IoError if DIR is renamed during the runs
int run_ensemble(const ClaimedDirectory& claim, const std::string& directory, const SeedRange& seeds, int jobs,
                 const std::vector<std::string>& arguments, bool append);

}  // namespace floc
