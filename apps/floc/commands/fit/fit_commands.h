#pragma once

#include "process/command.h"

namespace floc {

// Each adds one fit as a subcommand of `floc fit`; each fit has a file of its own.
Command add_fit_consolidation(CommandLine fit);
Command add_fit_preconsolidation(CommandLine fit);
Command add_fit_elastic(CommandLine fit);
Command add_fit_cycle(CommandLine fit);
Command add_fit_dynamic_compaction(CommandLine fit);
Command add_fit_force_distribution(CommandLine fit);

}  // namespace floc
