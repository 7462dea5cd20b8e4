#pragma once

#include <string>
#include <vector>

#include "floc/base/seed_range.h"
#include "floc/run_directory/directory_lock.h"

namespace floc {

/// Parses a range of seeds "A..B".
/// @throws InputError unless A and B are whole numbers with A <= B
SeedRange parse_seeds(const std::string& text);

/// Runs one sample per seed, each in its own process, with the directory DIR/seed-N and the log file DIR/seed-N.log,
/// where N is the seed. The signals SIGINT and SIGTERM are passed on to these processes, so that every sample writes
/// its checkpoint.
///
/// @param claim      claim on the directory DIR; no further sample is started after DIR has been renamed or replaced
/// @param directory  path of DIR
/// @param jobs       largest number of samples that run at the same time
/// @param arguments  arguments of `floc run` that all samples share, without directory and seed
/// @param append     whether to append to existing log files instead of replacing them
/// @return the worst of the exit codes of the samples
/// @throws IoError if DIR is renamed during the runs
int run_ensemble(const ClaimedDirectory& claim, const std::string& directory, const SeedRange& seeds, int jobs,
                 const std::vector<std::string>& arguments, bool append);

}  // namespace floc
