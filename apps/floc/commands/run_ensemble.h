#pragma once

#include <string>
#include <vector>

#include "floc/base/seed_range.h"
#include "floc/run_directory/directory_lock.h"

namespace floc {

/// @throws InputError unless `text` is A..B with A <= B, two whole numbers
SeedRange parse_seeds(const std::string& text);

/// Runs one sample a seed, each a process of its own with the directory DIR/seed-N; what it says goes to
/// DIR/seed-N.log. SIGINT and SIGTERM are passed on, so that every sample writes its checkpoint.
///
/// @param claim      on DIR, which no sample is begun in once it leads elsewhere
/// @param directory  DIR
/// @param jobs       processes at a time
/// @param arguments  of `floc run` for each sample, without its directory and seed
/// @param append     to the logs, instead of writing them anew
/// @return the worst exit code of all
/// @throws IoError if the directory is renamed meanwhile
int run_ensemble(const ClaimedDirectory& claim, const std::string& directory, const SeedRange& seeds, int jobs,
                 const std::vector<std::string>& arguments, bool append);

}  // namespace floc
