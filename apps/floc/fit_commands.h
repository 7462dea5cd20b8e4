#pragma once

#include "command.h"

namespace floc {

// One file a fit; each adds itself below `floc fit`.
Command add_fit_consolidation(CLI::App& fit);
Command add_fit_preconsolidation(CLI::App& fit);
Command add_fit_elastic(CLI::App& fit);
Command add_fit_dynamic_compaction(CLI::App& fit);
Command add_fit_force_distribution(CLI::App& fit);

}  // namespace floc
