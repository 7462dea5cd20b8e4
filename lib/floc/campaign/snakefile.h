#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"

namespace floc {

/// A Snakefile of a campaign: a rule per run, one per derived table, one for the page. It calls only `program`.
/// @param program  path of floc; `snakemake --config floc=PATH` takes another
std::string snakefile_of(const Campaign& campaign, const std::vector<CasePlan>& plans,
                         const std::string& program);

/// File of the table that a collection makes in the directory of a run, "1-moduli.csv". @param number  from 0
std::string collected_file(const Campaign& campaign, int number);

}  // namespace floc
