#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"

namespace floc {

/// Returns the Snakefile of a campaign: a rule per run, one per derived table, and one for the page. It calls only
/// `program`.
/// @param program  path of floc; `snakemake --config floc=PATH` replaces it
std::string snakefile_of(const Campaign& campaign, const std::vector<CasePlan>& plans,
                         const std::string& program);

/// Returns the name of the table that a collection makes in the directory of a run, such as "1-moduli.csv". @param
/// number  number of the collection, from 0
std::string collected_file(const Campaign& campaign, int number);

}  // namespace floc
