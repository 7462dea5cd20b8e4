#pragma once

#include "process/command.h"

namespace floc {

// One file a fit; each adds itself below `floc fit`.
Command add_fit_consolidation(CommandLine fit);
Command add_fit_preconsolidation(CommandLine fit);
Command add_fit_elastic(CommandLine fit);
Command add_fit_cycle(CommandLine fit);
Command add_fit_dynamic_compaction(CommandLine fit);
Command add_fit_force_distribution(CommandLine fit);

}  // namespace floc
