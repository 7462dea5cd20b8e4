#pragma once

#include "process/command.h"

namespace floc {

// Each of the following functions adds one subcommand of `floc fit`. Each subcommand has its own source file.
Command add_fit_consolidation(CommandLine fit);
Command add_fit_compression(CommandLine fit);
Command add_fit_preconsolidation(CommandLine fit);
Command add_fit_elastic(CommandLine fit);
Command add_fit_moduli(CommandLine fit);
Command add_fit_cycle(CommandLine fit);
Command add_fit_strength(CommandLine fit);
Command add_fit_dynamic_compaction(CommandLine fit);
Command add_fit_force_distribution(CommandLine fit);

}  // namespace floc
