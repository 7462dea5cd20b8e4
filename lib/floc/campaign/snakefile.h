#pragma once

#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"

namespace floc {

/// Returns the Snakefile of a campaign: one rule per run, one rule per table of results, and one rule for the html
/// page. All rules call only `program`.
/// @param program  path of the floc executable; the option `--config floc=PATH` of snakemake replaces it
std::string snakefile_of(const Campaign& campaign, const std::vector<CasePlan>& plans,
                         const std::string& program);

/// Returns the name of the file, in the directory of a run, that contains the table of a collection, such as
/// "1-moduli.csv".
/// @param number  index of the collection in `campaign.collections`; the number in the file name is larger by 1
std::string collected_file(const Campaign& campaign, int number);

}  // namespace floc
