#pragma once

#include <string>
#include <vector>

#include "floc/base/seed_range.h"
#include "floc/run_directory/directory_lock.h"

namespace floc {

/// Parses a range of seeds. @throws InputError unless `text` is A..B with two whole numbers A <= B
SeedRange parse_seeds(const std::string& text);

/// Runs one sample per seed, each in a process of its own with the directory DIR/seed-N and the log DIR/seed-N.log.
/// SIGINT and SIGTERM are passed on, so that every sample writes its checkpoint.
///
/// @param claim      claim on DIR; no sample starts after DIR has been renamed or replaced
/// @param directory  DIR
/// @param jobs       number of processes at a time
/// @param arguments  arguments of `floc run` for each sample, without its directory and seed
/// @param append     appends to the logs instead of replacing them
/// @return the worst exit code of all
/// @throws IoError if DIR is renamed during the runs
int run_ensemble(const ClaimedDirectory& claim, const std::string& directory, const SeedRange& seeds, int jobs,
                 const std::vector<std::string>& arguments, bool append);

}  // namespace floc
