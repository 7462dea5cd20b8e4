#pragma once

#include <string>
#include <vector>

#include "fit_parameters.h"
#include "fit_tables.h"
#include "floc/fitting/dynamic_compaction.h"
#include "floc/fitting/force_distribution.h"
#include "floc/fitting/preconsolidation.h"
#include "floc/io/table.h"

/// Fits to tables, and what `--format json` prints of them.
namespace floc {

/// A reloading branch and its fit.
struct ReloadingFit {
  Reloading branch;
  PreconsolidationFit fit;
};
std::vector<ReloadingFit> preconsolidation_fits(const PathTable& path);
Json as_json(const PathTable& path, const ReloadingFit& reloading);

/// The table of `floc fit cycle`, without rows.
Table cycle_table();
/// Adds the rows of a path's cycles of pressure. @return how many
int add_cycles(const PathTable& path, Table& table);

/// What a smaller error would need: more "samples", another "law", or a clearer "plateau".
const char* limit_of(const CompactionErrorParts& parts);
/// A sample of dynamic compaction with void ratio e, p, sc and se.
/// @param place  of its row, for messages  @throws InputError unless all are positive
CompactedSample compacted_sample(const std::string& place, double e, double p, double sc, double se);
Json as_json(const std::string& name, const CompactionFit& fit, const CompactionReference& reference);

/// What `floc fit force-distribution` is asked.
struct ForceDistributionArguments {
  std::vector<std::string> inputs;
  std::string form = "all";
  double threshold = 0.0;
  bool has_threshold = false;
  ForceFitOptions options;
  std::string columns;
  std::string format;
};

/// Tails of both signs if there are tensions, the forms of compressive networks if there are none; or the form
/// asked for.
std::vector<ForceFit> fit_forms(const std::vector<double>& forces, const ForceDistributionArguments& arguments);
Json as_json(const std::string& name, const std::vector<double>& forces, const ForceFit& fit);

}  // namespace floc
